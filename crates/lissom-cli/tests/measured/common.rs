//! Where the measured logs are, and the record of which tests read them.

use std::{
    env,
    fs::OpenOptions,
    io::Write,
    panic::Location,
    path::{Path, PathBuf},
    thread,
};

/// Names the folder that holds the measured logs, one folder for each machine.
const DATA: &str = "LISSOM_DATA";

/// Names a file that gets one line for each test that asks for measured logs: `cargo xtask test`
/// sets it and counts the lines. Without it nothing is recorded.
const LOG: &str = "LISSOM_MEASURED_LOG";

/// The folder `name` of measured logs, or `None` where `LISSOM_DATA` is not set. A test that gets
/// `None` returns: it counts as skipped, and standard error says so.
///
/// ```ignore
/// let Some(folder) = common::data("emps") else { return };
/// ```
///
/// # Panics
/// Where `LISSOM_DATA` is set and has no such folder: who sets it wants these tests to run.
#[track_caller]
pub(crate) fn data(name: &str) -> Option<PathBuf> {
    let test = test_name(Location::caller());
    let Some(root) = env::var_os(DATA).filter(|root| !root.is_empty()) else {
        let line = format!("measured: skipped {test} ({DATA} is not set)\n");
        // Past the capture of `eprintln!`, so that a plain `cargo test` shows it too.
        let _ = std::io::stderr().write_all(line.as_bytes());
        record(&line);
        return None;
    };
    let folder = Path::new(&root).join(name);
    assert!(folder.is_dir(), "{DATA} is set, and {} is not a folder", folder.display());
    record(&format!("measured: ran {test}\n"));
    Some(folder)
}

/// The test's own name, which is its thread's; with a single test thread, where it is asked for.
fn test_name(caller: &Location<'_>) -> String {
    match thread::current().name() {
        Some(name) if name != "main" => name.to_owned(),
        _ => format!("{}:{}", caller.file(), caller.line()),
    }
}

/// Appends one line, whole: tests run side by side.
fn record(line: &str) {
    let Some(path) = env::var_os(LOG) else { return };
    let written = OpenOptions::new()
        .create(true)
        .append(true)
        .open(&path)
        .and_then(|mut file| file.write_all(line.as_bytes()));
    if let Err(error) = written {
        panic!("cannot record the test in {}: {error}", path.display());
    }
}

/// Writes `campaign` into a folder of its own, with `{data}` and `{file}` filled in.
fn place(campaign: &str, data: &Path, file: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("campaign.toml");
    let data = data.canonicalize().unwrap();
    let text = campaign.replace("{data}", data.to_str().unwrap()).replace("{file}", file);
    std::fs::write(&path, text).unwrap();
    (folder, path)
}

/// What the command's `identify` gives as JSON; it must end with `code`.
pub(crate) fn identify(campaign: &str, data: &Path, file: &str, code: i32) -> serde_json::Value {
    let (_folder, path) = place(campaign, data, file);
    let output = assert_cmd::Command::cargo_bin("lissom")
        .unwrap()
        .args(["identify", path.to_str().unwrap(), "--json"])
        .output()
        .unwrap();
    let talk = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{talk}");
    serde_json::from_slice(&output.stdout).unwrap()
}

/// What `validate` gives as JSON, of a result that is written out first; it must end with `code`.
pub(crate) fn validate(
    result: &serde_json::Value,
    campaign: &str,
    data: &Path,
    file: &str,
    (code, more): (i32, &[&str]),
) -> serde_json::Value {
    let (folder, path) = place(campaign, data, file);
    let found = folder.path().join("result.json");
    std::fs::write(&found, result.to_string()).unwrap();
    let output = assert_cmd::Command::cargo_bin("lissom")
        .unwrap()
        .args(["validate", found.to_str().unwrap(), path.to_str().unwrap(), "--json"])
        .args(more)
        .output()
        .unwrap();
    let talk = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{talk}");
    serde_json::from_slice(&output.stdout).unwrap()
}

/// The campaign as the library reads it.
pub(crate) fn read(campaign: &str, data: &Path, file: &str) -> lissom_io::CampaignFile {
    let (_folder, path) = place(campaign, data, file);
    lissom_io::read_campaign(&path).unwrap()
}

/// Whether a result has a finding of this code.
pub(crate) fn has_finding(result: &serde_json::Value, code: &str) -> bool {
    result["findings"].as_array().unwrap().iter().any(|f| f["code"] == code)
}
