//! The wheel of the Python package: built, installed into a clean environment, and tested there.

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use crate::{
    python_environment::PythonEnvironment,
    step::{Failure, folder, run},
};

/// Builds the wheel, installs it, and runs the tests of the package.
pub(crate) fn test(root: &Path) -> Result<(), Failure> {
    let package = root.join("crates/lissom-py");
    let python = PythonEnvironment::new(root, "python", &package.join("tests/requirements.txt"))?;
    let wheel = build(root, &python, &package)?;
    let mut install = python.pip_install();
    install.args(["--force-reinstall", "--no-deps"]);
    run("wheel installed", install.arg(&wheel))?;
    let mut tests = Command::new(&python.program);
    tests.args(["-m", "pytest", "-q", "-p", "no:cacheprovider"]).arg(&package);
    run("tests of the Python package", &mut tests)
}

/// Builds the wheel for this machine; gives its file.
fn build(root: &Path, python: &PythonEnvironment, package: &Path) -> Result<PathBuf, Failure> {
    let wheels = folder(root, "wheels")?;
    let failed = |source| Failure::File { path: wheels.display().to_string(), source };
    let is_wheel = |path: &PathBuf| path.extension().is_some_and(|e| e == "whl");
    let all = || -> Result<Vec<PathBuf>, Failure> {
        let entries = fs::read_dir(&wheels).map_err(failed)?;
        Ok(entries.flatten().map(|entry| entry.path()).filter(is_wheel).collect())
    };
    for former in all()? {
        fs::remove_file(former).map_err(failed)?;
    }
    let mut build = Command::new(&python.program);
    build.args(["-m", "maturin", "build", "--release", "--locked", "--compatibility", "linux"]);
    build.current_dir(package).arg("--out").arg(&wheels);
    run("wheel", &mut build)?;
    let made = all()?.into_iter().next();
    let wheel = made.ok_or_else(|| failed(std::io::ErrorKind::NotFound.into()))?;
    let bytes = fs::metadata(&wheel).map_err(failed)?.len();
    println!("    {} ({:.1} MB)", wheel.display(), bytes as f64 / 1e6);
    Ok(wheel)
}
