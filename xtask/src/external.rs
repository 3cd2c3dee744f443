//! The rig's experiments by other people's simulators: `xtask/external/compare.py` in a virtual
//! environment of its own under `target`, with the versions that `requirements.txt` pins.

use std::{fs, path::Path, process::Command};

use crate::step::{Failure, ask, cargo, run};

/// Builds the environment where it is missing, lets lissom write its experiments, and compares.
pub(crate) fn compare(root: &Path) -> Result<(), Failure> {
    let scripts = root.join("xtask/external");
    let folder = root.join("target/external");
    fs::create_dir_all(&folder)
        .map_err(|source| Failure::File { path: folder.display().to_string(), source })?;
    let environment = folder.join("venv");
    let bin = environment.join(if cfg!(windows) { "Scripts" } else { "bin" });
    let python = || Command::new(bin.join("python"));
    if ask(python().arg("--version")).is_err() {
        let system = if cfg!(windows) { "python" } else { "python3" };
        let (found, _) = ask(Command::new(system).arg("--version")).unwrap_or_default();
        if !found {
            return Err(Failure::Missing { tool: "Python", install: "Python 3.11 or newer" });
        }
        let mut made = Command::new(system);
        run("python: environment", made.args(["-m", "venv"]).arg(&environment))?;
    }
    let mut install = python();
    install.args([
        "-m",
        "pip",
        "install",
        "--quiet",
        "--disable-pip-version-check",
        "--requirement",
    ]);
    run("pip: pinned versions", install.arg(scripts.join("requirements.txt")))?;
    let example = ["run", "--release", "--package", "lissom", "--example", "external", "--"];
    run("lissom's experiments", cargo(root, &example).arg(&folder))?;
    run("MuJoCo and scipy beside lissom", python().arg(scripts.join("compare.py")).arg(&folder))
}
