//! The experiments of the virtual rig with independent simulators: `evidence/independent/compare.py` in a Python
//! environment under `target`, with the versions that `requirements.txt` pins. Then exports loaded by the programs that they
//! are for (`exports.py`), log files of other libraries read, and MuJoCo's own identification of the same logs
//! (`sysid.py`).

use std::{
    env,
    path::{Path, PathBuf},
    process::Command,
};

use crate::{
    python_environment::PythonEnvironment,
    step::{Failure, cargo, folder, run, target_folder},
};

/// A Python environment with the versions that `requirements.txt` pins.
struct Python {
    program: PathBuf,
    scripts: PathBuf,
}

impl Python {
    /// Builds the environment if it is missing.
    fn new(root: &Path) -> Result<Self, Failure> {
        let scripts = root.join("evidence/independent");
        let environment =
            PythonEnvironment::new(root, "external", &scripts.join("requirements.txt"))?;
        Ok(Self { program: environment.program, scripts })
    }

    fn script(&self, name: &str) -> Command {
        let mut command = Command::new(&self.program);
        command.arg(self.scripts.join(name));
        command
    }
}

/// Lets lissom write its experiments, compares the motions of MuJoCo and scipy with them, identifies a
/// campaign simulated by MuJoCo, and lets MuJoCo's own identification and lissom identify the same logs.
pub(crate) fn compare(root: &Path) -> Result<(), Failure> {
    let python = Python::new(root)?;
    let folder = folder(root, "external")?;
    let example = ["run", "--release", "--package", "lissom-core", "--example", "external", "--"];
    run("experiments of the virtual rig", cargo(root, &example).arg(&folder))?;
    let mut compare = python.script("compare.py");
    run("MuJoCo and scipy compared with lissom", compare.arg(&folder))?;
    let campaign = |what: &str| {
        let mut command = python.script("mujoco_campaign.py");
        command.arg(what).arg(&folder);
        command
    };
    run("campaign simulated by MuJoCo", &mut campaign("write"))?;
    for integrator in ["implicitfast", "RK4"] {
        let own = folder.join("mujoco").join(integrator);
        let identify = ["run", "--release", "--package", "lissom-cli", "--", "identify"];
        let mut command = cargo(root, &identify);
        command.arg(own.join("campaign.toml")).arg("--json").arg(own.join("result.json"));
        run("identification of that campaign", &mut command)?;
    }
    run("its estimates compared with the truth", &mut campaign("judge"))?;
    let build = ["build", "--release", "--package", "lissom-cli"];
    run("build of the command", &mut cargo(root, &build))?;
    loaded_elsewhere(root, &python, &folder)?;
    let mut identify = python.script("sysid.py");
    identify.arg("compare").arg(&folder).arg(command_path(root));
    run("MuJoCo's own identification compared with lissom", &mut identify)
}

/// Lets other programs load what lissom exports, and lissom read the log files that other libraries write.
fn loaded_elsewhere(root: &Path, python: &Python, folder: &Path) -> Result<(), Failure> {
    let (demo, exports, logs) = (folder.join("demo"), folder.join("exports"), folder.join("logs"));
    let command = command_path(root);
    run("demo", Command::new(&command).arg("demo").arg("--out").arg(&demo))?;
    let mut load = python.script("exports.py");
    load.arg(&command).arg(demo.join("result.json")).arg(&exports);
    run("exports loaded by other programs", &mut load)?;
    let mut write = Command::new(&python.program);
    write.arg(root.join("crates/lissom-formats/tests/external/write.py")).arg(&logs);
    run("log files of other libraries", &mut write)?;
    let test = ["test", "--package", "lissom-formats", "--features", "full", "--test", "external"];
    run("these log files read", cargo(root, &test).env("LISSOM_EXTERNAL", &logs))
}

/// Measures how near the comparisons come to their thresholds: a copy of the sources records it for 30 simulated
/// campaigns of a seed, for the campaigns of the given files, and for the tests. Writes the table
/// `target/margins/table.md`.
pub(crate) fn margins(root: &Path, seed: &str, campaigns: &[String]) -> Result<(), Failure> {
    let python = Python::new(root)?;
    let folder = folder(root, "margins")?;
    let (copy, build) = (folder.join("source"), folder.join("build"));
    let script = |what: &str| {
        let mut command = python.script("margins.py");
        command.arg(what);
        command
    };
    run("copy of the sources that records comparisons", script("instrument").arg(root).arg(&copy))?;
    let mut programs =
        cargo(&copy, &["build", "--release", "-p", "lissom-cli", "-p", "lissom-study"]);
    run("build of the copy", programs.arg("--target-dir").arg(&build))?;
    run(
        "identification of campaigns",
        script("run").arg(&copy).arg(&build).arg(seed).args(campaigns),
    )?;
    let mut tests =
        cargo(&copy, &["test", "--no-fail-fast", "-p", "lissom-core", "-p", "lissom-cli"]);
    tests.arg("--target-dir").arg(&build).env("LISSOM_MARGINS", copy.join("tests"));
    run("tests", &mut tests)?;
    run("table", script("table").arg(&copy).arg(folder.join("table.md")))
}

/// The path of the command's release build.
fn command_path(root: &Path) -> PathBuf {
    target_folder(root).join("release").join(format!("lissom{}", env::consts::EXE_SUFFIX))
}

/// Simulates flexible arms in Python, identifies them, and compares the estimates with the truth.
pub(crate) fn arms(
    root: &Path,
    [count, seed]: [&str; 2],
    further: &[String],
) -> Result<(), Failure> {
    let python = Python::new(root)?;
    let folder = folder(root, "arms")?;
    let build = ["build", "--release", "--package", "lissom-cli"];
    run("build of the command", &mut cargo(root, &build))?;
    let mut study = python.script("outside_arms.py");
    study.arg(&folder).args([count, seed]).arg(command_path(root)).args(further);
    run("simulation and identification", &mut study)
}

/// Simulates random campaigns in Python; the study identifies them and compares the estimates with the truth.
pub(crate) fn truth(root: &Path, campaigns: &str) -> Result<(), Failure> {
    let python = Python::new(root)?;
    let folder = folder(root, "truth")?;
    let study = |what: &str| {
        let mut command = cargo(root, &["run", "--release", "--package", "lissom-study", "--"]);
        command.args(["--campaigns", campaigns, what]).arg(&folder);
        command
    };
    run("definitions of the campaigns", &mut study("--export"))?;
    run("simulation", python.script("truth.py").arg(&folder))?;
    run("identification", study("--external").arg("--out").arg(&folder))
}
