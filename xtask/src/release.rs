//! Parts of a release: the packaged crates, and a static binary with its licences.

use std::{fs, path::Path, process::Command};

use crate::step::{Failure, ask, cargo, run, target_folder};

/// The target whose binaries need no system library.
const STATIC_TARGET: &str = "x86_64-unknown-linux-musl";

/// The published crates, each after those that it depends on.
const CRATES: [&str; 10] = [
    "lissom-text",
    "lissom-core",
    "lissom-formats",
    "lissom-report",
    "lissom-io",
    "lissom",
    "lissom-fleet",
    "lissom-views",
    "lissom-studio",
    "lissom-cli",
];

/// Packages the crates as for publishing.
pub(crate) fn package(root: &Path) -> Result<(), Failure> {
    let mut command = cargo(root, &["package", "--no-verify", "--allow-dirty", "--quiet"]);
    for name in CRATES {
        command.args(["--package", name]);
    }
    run("cargo package", &mut command)
}

/// Builds the static binary into `target/release-static` and lists the licences of all packages in it.
pub(crate) fn static_binary(root: &Path) -> Result<(), Failure> {
    let mut command = cargo(root, &["build", "--release", "--package", "lissom-cli", "--target"]);
    run("static binary", command.arg(STATIC_TARGET).env("CARGO_PROFILE_RELEASE_STRIP", "true"))?;
    let target = target_folder(root);
    let out = target.join("release-static");
    let failed = |path: &Path| {
        let path = path.display().to_string();
        move |source| Failure::File { path, source }
    };
    fs::create_dir_all(&out).map_err(failed(&out))?;
    let built = target.join(STATIC_TARGET).join("release/lissom");
    let binary = out.join("lissom");
    fs::copy(&built, &binary).map_err(failed(&built))?;

    let tree = ["tree", "--package", "lissom-cli", "--edges", "normal", "--prefix", "none"];
    let mut licences = cargo(root, &tree);
    licences.args(["--format", "{p} {l}", "--target", STATIC_TARGET]);
    let output = licences
        .output()
        .map_err(|source| Failure::Start { command: "cargo tree".to_owned(), source })?;
    let text = String::from_utf8_lossy(&output.stdout);
    let mut lines: Vec<String> =
        text.lines().filter(|l| !l.is_empty()).map(|l| l.replace(" (*)", "")).collect();
    for line in &mut lines {
        // Removes the folder after a package of the workspace.
        if let (Some(from), Some(to)) = (line.find(" (/"), line.find(") ")) {
            line.replace_range(from..=to, "");
        }
    }
    lines.sort();
    lines.dedup();
    let listed = out.join("LICENCES.txt");
    fs::write(&listed, lines.join("\n") + "\n").map_err(failed(&listed))?;

    let (works, output) = ask(Command::new(&binary).arg("--version"))?;
    if !works {
        return Err(Failure::Install { tool: "the static binary", output });
    }
    let bytes = fs::metadata(&binary).map_err(failed(&binary))?.len();
    println!(
        "\n{}: {:.1} MB, {} packages in it",
        binary.display(),
        bytes as f64 / 1e6,
        lines.len()
    );
    println!("licences: {}", listed.display());
    Ok(())
}
