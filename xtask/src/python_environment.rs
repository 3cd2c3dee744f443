//! Python environments under `target`, each with the versions that a list pins.

use std::{
    path::{Path, PathBuf},
    process::Command,
};

use crate::step::{Failure, ask, folder, run};

/// A Python environment.
pub(crate) struct PythonEnvironment {
    pub(crate) program: PathBuf,
}

impl PythonEnvironment {
    /// The environment `target/NAME/venv`, built if it is missing, with the versions of a list.
    pub(crate) fn new(root: &Path, name: &str, requirements: &Path) -> Result<Self, Failure> {
        let environment = folder(root, name)?.join("venv");
        let bin = environment.join(if cfg!(windows) { "Scripts" } else { "bin" });
        let program = bin.join("python");
        if ask(Command::new(&program).arg("--version")).is_err() {
            let system = if cfg!(windows) { "python" } else { "python3" };
            let (found, _) = ask(Command::new(system).arg("--version")).unwrap_or_default();
            if !found {
                return Err(Failure::Missing { tool: "Python", install: "Python 3.11 or newer" });
            }
            let mut made = Command::new(system);
            run("python: environment", made.args(["-m", "venv"]).arg(&environment))?;
        }
        let python = Self { program };
        let mut install = python.pip_install();
        run("pip: pinned versions", install.arg("--requirement").arg(requirements))?;
        Ok(python)
    }

    /// `pip install`, to be completed.
    pub(crate) fn pip_install(&self) -> Command {
        let mut install = Command::new(&self.program);
        install.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check"]);
        install
    }
}
