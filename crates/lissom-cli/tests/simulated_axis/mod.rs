//! A simulated log of a rigid axis, and the command in its folder.

use std::path::Path;
use std::process::Command;

use tempfile::TempDir;

/// The axis that is simulated.
const AXIS: &str = r#"
[beam]
rigid = true
[drive]
inertia = "0.012 kg*m^2"
viscous = "0.05 N*m*s/rad"
torque_constant = "0.5 N*m/A"
coulomb = "0.25 N*m"
[rig]
sample_time = "2 ms"
controller = { proportional = "30 A/rad", derivative = "1 A*s/rad" }
"#;
const PLAN: &str = r#"
[[runs]]
name = "log"
multisine = { frequency = "0.2 Hz", to = "2 Hz", amplitude = "1 rad" }
record = "20 s"
"#;

/// Runs the command: exit code, standard output, standard error.
pub(crate) fn lissom(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let mut command = Command::new(assert_cmd::cargo::cargo_bin!("lissom"));
    let output = command.args(arguments).current_dir(folder).env("NO_COLOR", "1").output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

/// A folder with `axis.toml`, and a log `made/log.csv` with its `made/campaign.toml`.
pub(crate) fn simulated_axis() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("axis.toml"), AXIS).unwrap();
    std::fs::write(folder.path().join("plan.toml"), PLAN).unwrap();
    let made = ["rig", "axis.toml", "--campaign", "plan.toml", "--out", "made"];
    let (code, _, error) = lissom(folder.path(), &made);
    assert_eq!(code, Some(0), "{error}");
    folder
}
