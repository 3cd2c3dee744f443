//! The wheel of the Python package: built as it would be published, installed into clean environments, and tested there.

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use crate::{
    python_environment::PythonEnvironment,
    step::{Failure, cargo, folder, run, target_folder},
};

/// The oldest Linux that the wheel runs on: glibc 2.28 (2018). A wheel that needs more is refused.
const OLDEST_LINUX: &str = "manylinux_2_28";
/// Largest size of the wheel \[bytes\]: a limit by convention, so that an installation takes seconds.
const WHEEL_MOST: u64 = 20_000_000;
/// Tries the wheel where only numpy is installed.
const CLEAN: &str = "\
import subprocess, sys, lissom
arm = {'beam': {'rigid': True}, 'drive': {'inertia': '2e-3 kg*m^2', 'coulomb': '0.02 N*m', 'viscous': '5e-3 N*m*s/rad',
       'torque_constant': '0.2 N*m/A'}, 'rig': {'sample_time': '2 ms', 'motor_sensor': {'counts_per_turn': 16384},
       'controller': {'proportional': '4 A/rad', 'derivative': '0.15 A*s/rad'}}}
runs = {'runs': [{'sine': {'frequency': f, 'amplitude': '0.5 rad'}, 'periods': 12} for f in ('0.5 Hz', '1.5 Hz')]}
logs = lissom.simulate(arm, runs)
signals = {'time': 't:s', 'motor': 'theta_m:rad', 'current': lissom.Signal('i', 'A', hold='sampled')}
result = lissom.identify(lissom.Campaign(logs, torque_constant='0.2 N*m/A', **signals), effort='quick')
assert abs(result['friction.coulomb'] - 0.02) < 1e-3, result
command = sys.executable.replace('python.exe', 'Scripts/lissom.exe') if sys.platform == 'win32' else sys.prefix + '/bin/lissom'
print(subprocess.run([command, '--version'], check=True, capture_output=True, text=True).stdout.strip())
subprocess.run([command, 'help', 'studio'], check=True, capture_output=True)
assert not {'pandas', 'matplotlib', 'control'} & set(sys.modules)
";

/// How a wheel is built.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Build {
    /// With the development profile, for this machine only: the dependencies are those of the tests.
    Tested,
    /// As it would be published.
    Published,
}

/// Builds the wheel, tries it in an environment with numpy only, and runs the tests of the package with it; makes the source
/// distribution and checks that a wheel can be built of it.
pub(crate) fn test(root: &Path, as_built: Build) -> Result<(), Failure> {
    let package = root.join("crates/lissom-py");
    let python = PythonEnvironment::new(root, "python", &package.join("tests/requirements.txt"))?;
    let wheel = build(root, &python, &package, as_built)?;

    let clean = PythonEnvironment::clean(root, "python-clean")?;
    run("wheel in an environment with numpy only", clean.pip_install().arg(&wheel))?;
    run("a first result there", Command::new(&clean.program).args(["-c", CLEAN]))?;

    let mut install = python.pip_install();
    install.args(["--force-reinstall", "--no-deps"]);
    run("wheel installed", install.arg(&wheel))?;
    let mut tests = Command::new(&python.program);
    tests.args(["-m", "pytest", "-q", "-p", "no:cacheprovider"]).arg(&package);
    run("tests of the Python package", &mut tests)?;
    source_distribution(root, &python, &package)
}

/// Builds the wheel for this machine; gives its file.
fn build(
    root: &Path,
    python: &PythonEnvironment,
    package: &Path,
    as_built: Build,
) -> Result<PathBuf, Failure> {
    let wheels = folder(root, "wheels")?;
    let mut build = Command::new(&python.program);
    build.args(["-m", "maturin", "build", "--locked"]);
    if as_built == Build::Published {
        build.arg("--release");
    } else {
        build.args(["--profile", "dev"]);
    }
    if cfg!(target_os = "linux") && as_built == Build::Published {
        // The linker of zig takes the symbols of the oldest glibc. It is a package of this environment.
        build.args(["--zig", "--compatibility", OLDEST_LINUX]).env("PATH", python.path());
    }
    build.current_dir(package).arg("--out").arg(&wheels);
    let wheel = made(&wheels, ".whl", "wheel", &mut build)?;
    let bytes = size(&wheel)?;
    if bytes > WHEEL_MOST && as_built == Build::Published {
        return Err(Failure::Large { path: wheel.display().to_string(), bytes, most: WHEEL_MOST });
    }
    Ok(wheel)
}

/// Makes the source distribution, and checks that cargo finds in it all that the wheel is built of.
fn source_distribution(
    root: &Path,
    python: &PythonEnvironment,
    package: &Path,
) -> Result<(), Failure> {
    let out = folder(root, "sdist")?;
    let mut sdist = Command::new(&python.program);
    sdist.args(["-m", "maturin", "sdist"]).current_dir(package).arg("--out").arg(&out);
    let archive = made(&out, ".tar.gz", "source distribution", &mut sdist)?;
    let unpacked = folder(root, "sdist/unpacked")?;
    let failed = |source| Failure::File { path: unpacked.display().to_string(), source };
    fs::remove_dir_all(&unpacked).and_then(|()| fs::create_dir(&unpacked)).map_err(failed)?;
    let mut unpack = Command::new("tar");
    run("unpacked", unpack.arg("-xzf").arg(&archive).arg("-C").arg(&unpacked))?;
    let mut entries = fs::read_dir(&unpacked).map_err(failed)?.flatten();
    let top = entries.next().ok_or_else(|| failed(std::io::ErrorKind::NotFound.into()))?.path();
    let mut check = cargo(&top, &["check", "--locked", "--package", "lissom-py"]);
    // The dependencies are those of this workspace, which are built already.
    run("source distribution checked", check.env("CARGO_TARGET_DIR", target_folder(root)))
}

/// Runs a step that makes the only file with this ending in a folder; gives it.
fn made(
    folder: &Path,
    ending: &str,
    title: &str,
    command: &mut Command,
) -> Result<PathBuf, Failure> {
    let failed = |source| Failure::File { path: folder.display().to_string(), source };
    let all = || -> Result<Vec<PathBuf>, Failure> {
        let entries = fs::read_dir(folder).map_err(failed)?.flatten();
        let named = |path: &PathBuf| path.to_string_lossy().ends_with(ending);
        Ok(entries.map(|entry| entry.path()).filter(named).collect())
    };
    for former in all()? {
        fs::remove_file(former).map_err(failed)?;
    }
    run(title, command)?;
    let file = all()?.into_iter().next();
    let file = file.ok_or_else(|| failed(std::io::ErrorKind::NotFound.into()))?;
    println!("    {} ({:.1} MB)", file.display(), size(&file)? as f64 / 1e6);
    Ok(file)
}

fn size(file: &Path) -> Result<u64, Failure> {
    let found = fs::metadata(file);
    found
        .map(|found| found.len())
        .map_err(|source| Failure::File { path: file.display().to_string(), source })
}
