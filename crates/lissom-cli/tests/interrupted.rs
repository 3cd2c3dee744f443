//! A search that is ended early: the best result so far is printed and written, with an exit code of its own.

#![expect(clippy::unwrap_used, reason = "tests")]

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use assert_cmd::Command;
use lissom_testmodels::{RigidJoint, two_sines};

/// A log and its campaign file.
fn campaign(folder: &Path) {
    let log = RigidJoint::default().follow(8000, two_sines);
    let mut text = String::from("t,i,q\n");
    for ((t, i), q) in log.time_s.iter().zip(&log.held).zip(&log.angle) {
        writeln!(text, "{t},{i},{q}").unwrap();
    }
    fs::write(folder.join("log.csv"), text).unwrap();
    let file = "[signals]\ntime = { column = \"t\", unit = \"s\" }\n\
                current = { column = \"i\", unit = \"A\", hold = \"sampled\" }\n\
                motor = { column = \"q\", unit = \"rad\" }\n[[runs]]\nfile = \"log.csv\"\n";
    fs::write(folder.join("campaign.toml"), file).unwrap();
}

fn identify(folder: &Path, options: &[&str]) -> (i32, String) {
    let mut command = Command::cargo_bin("lissom").unwrap();
    let output = command.current_dir(folder).args(["identify", "campaign.toml"]).args(options);
    let output = output.output().unwrap();
    let text =
        String::from_utf8(output.stdout).unwrap() + &String::from_utf8(output.stderr).unwrap();
    (output.status.code().unwrap(), text)
}

#[test]
fn a_time_limit_takes_the_best_so_far() {
    let folder = tempfile::tempdir().unwrap();
    campaign(folder.path());
    let options = ["--time-limit", "1 us", "--json", "result.json"];
    let (code, text) = identify(folder.path(), &options);
    assert_eq!(code, 4, "{text}");
    assert!(text.contains("was stopped after"), "{text}");
    assert!(text.contains("Coulomb friction"), "{text}");
    let result = fs::read_to_string(folder.path().join("result.json")).unwrap();
    assert!(result.contains("coulomb"), "{result}");
}

#[test]
fn efforts() {
    let folder = tempfile::tempdir().unwrap();
    campaign(folder.path());
    let (code, quick) = identify(folder.path(), &["--quick"]);
    assert_eq!(code, 0, "{quick}");
    assert_eq!(identify(folder.path(), &["--effort", "quick"]), (0, quick));
    let (code, text) = identify(folder.path(), &["--effort", "quick", "--quick"]);
    assert!(code == 2 && text.contains("cannot be used with"), "{text}");
    let (code, text) = identify(folder.path(), &["--effort", "high"]);
    assert!(code == 2 && text.contains("thorough"), "{text}");
    let (code, text) = identify(folder.path(), &["--time-limit", "1e300 s"]);
    assert_eq!(code, 0, "{text}");
    let (code, text) = identify(folder.path(), &["--time-limit", "-1 s"]);
    assert!(code == 2 && text.contains("--time-limit"), "{text}");
}
