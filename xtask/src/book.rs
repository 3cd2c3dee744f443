//! Builds the book with mdBook and checks every link of its pages.

use std::{
    collections::{HashMap, HashSet},
    fs,
    path::{Component, Path, PathBuf},
};

use crate::step::{Failure, ask, cargo, run};

/// The version that the book is built with.
const MDBOOK: &str = "0.5.4";

/// Builds `docs/book` and checks its links, and those of the pages outside the book.
pub(crate) fn build(root: &Path) -> Result<(), Failure> {
    let mdbook = installed(root)?;
    let docs = root.join("docs");
    run("mdbook build", std::process::Command::new(mdbook).args(["build"]).arg(&docs))?;
    let book = docs.join("book");
    let mut broken = broken_in_html(&book)?;
    for page in ["README.md", "ARCHITECTURE.md", "CHANGELOG.md", "docs/README.md"] {
        broken.extend(broken_in_markdown(root, page)?);
    }
    println!(
        "\n--- links: {}",
        if broken.is_empty() { "all are valid" } else { "some are broken" }
    );
    if broken.is_empty() { Ok(()) } else { Err(Failure::Links { broken }) }
}

/// mdBook of version [`MDBOOK`]: the one on the path, or one installed under `target`.
fn installed(root: &Path) -> Result<PathBuf, Failure> {
    let tools = root.join("target/tools");
    let own = tools.join("bin/mdbook");
    for place in [PathBuf::from("mdbook"), own.clone()] {
        let mut command = std::process::Command::new(&place);
        let found = command.arg("--version").output().ok();
        if found.is_some_and(|o| String::from_utf8_lossy(&o.stdout).contains(MDBOOK)) {
            return Ok(place);
        }
    }
    // Unoptimised and without its server: half a minute, and the book takes a second either way.
    let arguments =
        ["install", "mdbook", "--locked", "--debug", "--no-default-features", "--version"];
    let mut install = cargo(root, &arguments);
    install.arg(MDBOOK).arg("--root").arg(&tools).env("CARGO_PROFILE_DEV_DEBUG", "0");
    install.env_remove("CARGO_TARGET_DIR");
    let (done, output) = ask(&mut install)?;
    if done { Ok(own) } else { Err(Failure::Install { tool: "mdbook", output }) }
}

/// Broken links of the built pages: those without a file, or without a heading.
fn broken_in_html(book: &Path) -> Result<Vec<String>, Failure> {
    let mut pages = Vec::new();
    collect(book, &mut pages)?;
    let mut anchors: HashMap<PathBuf, HashSet<String>> = HashMap::new();
    let mut texts = Vec::new();
    for path in pages {
        let text = read(&path)?;
        let ids = attributes(&text, "id").map(str::to_owned).collect();
        anchors.insert(normal(&path), ids);
        texts.push((path, text));
    }
    let mut broken = Vec::new();
    for (path, text) in &texts {
        // The page that joins all pages repeats links that are relative to the single pages.
        if path.ends_with("print.html") || path.ends_with("404.html") || path.ends_with("toc.html")
        {
            continue;
        }
        for link in attributes(text, "href").chain(attributes(text, "src")) {
            if link.contains(':') || link.is_empty() {
                continue;
            }
            let (file, fragment) = link.split_once('#').unwrap_or((link, ""));
            let folder = path.parent().unwrap_or(book);
            let target = if file.is_empty() { normal(path) } else { normal(&folder.join(file)) };
            let known = anchors.get(&target);
            let there = match known {
                Some(ids) => fragment.is_empty() || ids.contains(fragment),
                None => target.exists(),
            };
            if !there {
                broken
                    .push(format!("{}: {link}", path.strip_prefix(book).unwrap_or(path).display()));
            }
        }
    }
    broken.sort();
    broken.dedup();
    Ok(broken)
}

/// Relative links of a page outside the book for which there is no file.
fn broken_in_markdown(root: &Path, page: &str) -> Result<Vec<String>, Failure> {
    let path = root.join(page);
    let text = read(&path)?;
    let folder = path.parent().unwrap_or(root);
    let links = text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    let local = links.filter(|link| !link.contains(':') && !link.starts_with('#'));
    let missing =
        local.filter(|link| !folder.join(link.split('#').next().unwrap_or(link)).exists());
    Ok(missing.map(|link| format!("{page}: {link}")).collect())
}

/// The values of an attribute in HTML that mdBook wrote.
fn attributes<'t>(text: &'t str, name: &str) -> impl Iterator<Item = &'t str> {
    let start = format!(" {name}=\"");
    let places: Vec<usize> = text.match_indices(&start).map(|(at, _)| at + start.len()).collect();
    places.into_iter().filter_map(|at| text[at..].split('"').next())
}

fn collect(folder: &Path, pages: &mut Vec<PathBuf>) -> Result<(), Failure> {
    let failed = |source| Failure::File { path: folder.display().to_string(), source };
    for entry in fs::read_dir(folder).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        if path.is_dir() {
            collect(&path, pages)?;
        } else if path.extension().is_some_and(|e| e == "html") {
            pages.push(path);
        }
    }
    Ok(())
}

fn read(path: &Path) -> Result<String, Failure> {
    fs::read_to_string(path)
        .map_err(|source| Failure::File { path: path.display().to_string(), source })
}

/// A path without `.` and `..`.
fn normal(path: &Path) -> PathBuf {
    let mut normal = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => {
                normal.pop();
            }
            Component::CurDir => {}
            other => normal.push(other),
        }
    }
    normal
}
