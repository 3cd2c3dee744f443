//! Every command in README.md and in the book runs, page by page from top to bottom, each page in an empty folder of
//! its own, and prints what the page shows. docs/README.md has the rules; with `LISSOM_DOCUMENTS=overwrite` the pages
//! take over what is printed now.
#![expect(clippy::unwrap_used, clippy::print_stdout, reason = "a test fails by panicking")]

mod output;
mod page;

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use output::{matches, refreshed};
use page::{Page, Step};

/// Commands that pages show and that this test does not run, by how they begin, and why.
const SHOWN_ALONE: &[(&str, &str)] = &[
    ("cargo xtask", "a recipe of this workspace; it takes minutes, or runs this very test"),
    ("cargo install", "puts a program on the machine"),
    ("cargo bench", "measures times, minutes long"),
    ("cargo run --release -p lissom-cli --example", "draws figures; a test of its own runs it"),
    ("cargo run --release -p lissom --example", "`cargo xtask ci` runs the examples"),
    ("cargo test", "the tests themselves"),
    ("pip install", "puts a package on the machine"),
    ("python", "needs packages of Python"),
    ("LISSOM_DATA", "needs the measured logs"),
    ("LISSOM_DOCUMENTS", "the tests themselves"),
    ("lissom completions", "writes into the folder of the user's shell"),
];

/// Pages with commands of the feature `fleet`.
const FLEET_PAGES: [&str; 2] = ["docs/src/how-to/fleets.md", "docs/src/reference/command.md"];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// README.md and every page of the book, from the folder of the workspace.
fn pages() -> Vec<String> {
    let summary = std::fs::read_to_string(root().join("docs/src/SUMMARY.md")).unwrap();
    let links = summary.split("](").skip(1).map(|rest| rest.split(')').next().unwrap());
    let book = links.map(|page| format!("docs/src/{page}"));
    std::iter::once("README.md".to_owned()).chain(book).collect()
}

/// What differs on a page; with `overwrite` the page takes over what was printed.
fn differences(name: &str, overwrite: bool) -> Vec<String> {
    let path = root().join(name);
    let text = std::fs::read_to_string(&path).unwrap();
    let page = Page::of(&text);
    let folder = tempfile::tempdir().unwrap();
    let mut wrong = Vec::new();
    let mut changed = Vec::new();
    for step in &page.steps {
        match step {
            Step::Write { file, text } => {
                let file = folder.path().join(file);
                std::fs::create_dir_all(file.parent().unwrap()).unwrap();
                std::fs::write(file, text).unwrap();
            }
            Step::Run { line, command, lines, exit } => {
                let Some(arguments) = arguments(command) else {
                    wrong.push(format!("{name}:{line}: not a command of lissom: {command}"));
                    continue;
                };
                let output = Command::new(assert_cmd::cargo::cargo_bin!("lissom"))
                    .current_dir(folder.path())
                    .args(arguments)
                    .output()
                    .unwrap();
                if output.status.code() != Some(*exit) {
                    let said = String::from_utf8_lossy(&output.stderr);
                    let found = output.status;
                    wrong.push(format!("{name}:{line}: {command}: {found}, not {exit}: {said}"));
                }
                let printed = String::from_utf8(output.stdout).unwrap();
                let shown: Vec<&str> = page.lines[lines.clone()].to_vec();
                if !shown.is_empty() && !matches(&shown, &printed) {
                    wrong.push(format!("{name}:{line}: {command} prints\n{printed}"));
                    changed.push((lines.clone(), refreshed(&shown, &printed)));
                }
            }
            Step::Show { line, command } => {
                if !SHOWN_ALONE.iter().any(|(start, _)| command.starts_with(start)) {
                    wrong.push(format!("{name}:{line}: neither run nor exempt: {command}"));
                }
            }
        }
    }
    if overwrite && !changed.is_empty() {
        std::fs::write(&path, page.with(&changed)).unwrap();
    }
    wrong
}

/// The arguments of a command line of lissom.
fn arguments(command: &str) -> Option<Vec<String>> {
    let words = shlex::split(command)?;
    let start: &[&str] = match words.first().map(String::as_str) {
        Some("lissom") => &["lissom"],
        _ => &["cargo", "run", "--release", "--"],
    };
    let (head, rest) = words.split_at_checked(start.len())?;
    (head == start).then(|| rest.to_vec())
}

#[test]
fn every_command_in_the_documents_does_what_they_show() {
    let overwrite = std::env::var("LISSOM_DOCUMENTS").is_ok_and(|v| v == "overwrite");
    // `lissom fleet` needs a feature.
    let shown = |page: &String| cfg!(feature = "fleet") || !FLEET_PAGES.contains(&page.as_str());
    let pages: Vec<String> = pages().into_iter().filter(shown).collect();
    let (next, wrong) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    let one_after_another = || {
        while let Some(page) = pages.get(next.fetch_add(1, Ordering::Relaxed)) {
            let start = std::time::Instant::now();
            wrong.lock().unwrap().extend(differences(page, overwrite));
            println!("{page}: {:.1} s", start.elapsed().as_secs_f64());
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(one_after_another);
        }
    });
    let wrong = wrong.into_inner().unwrap();
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}
