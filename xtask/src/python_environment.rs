//! Python environments under `target`, each with the versions that a list pins.

use std::{
    env,
    ffi::OsString,
    fs,
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
        let python = Self::existing(root, name)?;
        let mut install = python.pip_install();
        run("pip: pinned versions", install.arg("--requirement").arg(requirements))?;
        Ok(python)
    }

    /// The environment `target/NAME/venv`, built anew and without packages.
    pub(crate) fn clean(root: &Path, name: &str) -> Result<Self, Failure> {
        let environment = folder(root, name)?.join("venv");
        if environment.exists() {
            fs::remove_dir_all(&environment).map_err(|source| Failure::File {
                path: environment.display().to_string(),
                source,
            })?;
        }
        Self::existing(root, name)
    }

    /// The environment `target/NAME/venv`, built if it is missing.
    fn existing(root: &Path, name: &str) -> Result<Self, Failure> {
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
        Ok(Self { program })
    }

    /// The paths of programs, those of this environment first.
    pub(crate) fn path(&self) -> OsString {
        let own = self.program.parent().map(Path::to_owned);
        let others = env::var_os("PATH").unwrap_or_default();
        let all = own.into_iter().chain(env::split_paths(&others));
        env::join_paths(all).unwrap_or(others)
    }

    /// `pip install`, to be completed.
    pub(crate) fn pip_install(&self) -> Command {
        let mut install = Command::new(&self.program);
        install.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check"]);
        install
    }
}
