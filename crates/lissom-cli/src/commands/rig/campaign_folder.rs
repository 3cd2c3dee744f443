//! The folder of a virtual campaign, so that an interrupted campaign can continue.
//!
//! The entry of a run is written before its log. A log gets its name when it is complete. `campaign.toml` and
//! `rig.json` are written last. So every file in the folder is complete, and an interrupted campaign continues with the
//! missing logs.

use std::fmt::{self, Write as _};
use std::path::{Path, PathBuf};
use std::time::Duration;

use lissom::rig::Rig;
use lissom_io::write;
use lissom_io::{PlanFile, RigFile, RigRunEntry};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::shared::failure::Failure;

/// Folder for the entries of runs of an unfinished campaign.
const PARTS: &str = "rig-parts";
/// File that identifies the campaign of a folder.
const INPUT: &str = "input.json";
/// File of a finished campaign.
pub(crate) const DONE: &str = "rig.json";
/// Age above which a partly written file belongs to no running process.
const LEFT_OVER: Duration = Duration::from_secs(30);

pub(crate) struct Folder {
    path: PathBuf,
    fingerprint: String,
    /// `rig.json` of a finished campaign.
    finished: Option<RigFile>,
}

/// Which campaign a folder belongs to: the content of `input.json`, and a key of `rig.json`.
#[derive(Debug, Serialize, Deserialize)]
struct CampaignInput {
    fingerprint: Option<String>,
}

impl Folder {
    /// Creates the folder, or continues the campaign in it if it is the same one.
    pub(crate) fn open(path: &Path, rig: &Rig, plan: &PlanFile) -> Result<Self, Failure> {
        let folder = Self {
            path: path.to_owned(),
            fingerprint: fingerprint(rig, plan),
            finished: read_json(&path.join(DONE)),
        };
        let other =
            |what: &str| Failure::OtherCampaign { folder: path.to_owned(), what: what.to_owned() };
        let parts = folder.path(PARTS).join(INPUT);
        let same =
            |found: &CampaignInput| found.fingerprint.as_deref() == Some(&folder.fingerprint);
        match read_json(&folder.path(DONE)).or_else(|| read_json(&parts)) {
            Some(found) if same(&found) => {}
            // A campaign that failed before its first log.
            Some(_) if !folder.path(DONE).exists() && !folder.has_logs() => {
                let _ = std::fs::remove_dir_all(folder.path(PARTS));
            }
            Some(_) => return Err(other("another campaign")),
            None => {
                let own = plan.runs.iter().map(|run| format!("{}.csv", run.name));
                let fixed = ["campaign.toml", "arm.toml", "plan.toml", DONE].map(str::to_owned);
                if let Some(file) = own.chain(fixed).find(|file| folder.path(file).exists()) {
                    return Err(other(&format!("{file}, which is not from a virtual campaign")));
                }
            }
        }
        write::create_folder(&folder.path(PARTS))?;
        let input = CampaignInput { fingerprint: Some(folder.fingerprint.clone()) };
        write::write_json(&folder.path(PARTS).join(INPUT), &input)?;
        Ok(folder)
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    fn has_logs(&self) -> bool {
        let Ok(entries) = std::fs::read_dir(&self.path) else { return false };
        let csv =
            |name: std::ffi::OsString| Path::new(&name).extension().is_some_and(|e| e == "csv");
        entries.flatten().any(|entry| csv(entry.file_name()))
    }

    /// The entry of a run whose log exists and is complete.
    pub(crate) fn done(&self, name: &str) -> Option<RigRunEntry> {
        let log = format!("{name}.csv");
        let own = |entry: &RigRunEntry| entry.file == log;
        let entry = read_json(&self.part(name)).filter(own).or_else(|| {
            // A finished campaign has all entries in one file.
            self.finished.as_ref()?.runs.iter().find(|run| own(run)).cloned()
        })?;
        // A header and a row for each sample, each with its line end.
        let text = std::fs::read_to_string(self.path(&log)).ok()?;
        let rows = text.lines().count();
        let whole = entry.samples.checked_add(1)? == rows && text.ends_with('\n');
        whole.then_some(entry)
    }

    /// Writes the entry and the log of a run.
    pub(crate) fn store(
        &self,
        name: &str,
        entry: &RigRunEntry,
        columns: &[(&str, &[f64])],
    ) -> Result<(), Failure> {
        write::write_json(&self.part(name), entry)?;
        write::write_csv(&self.path(&format!("{name}.csv")), columns)?;
        Ok(())
    }

    /// Writes `rig.json` and removes temporary files.
    pub(crate) fn finish(&self, whole: &RigFile) -> Result<(), Failure> {
        let whole = RigFile { fingerprint: Some(self.fingerprint.clone()), ..whole.clone() };
        write::write_json(&self.path(DONE), &whole)?;
        // Files that remain there do no harm.
        let _ = std::fs::remove_dir_all(self.path(PARTS));
        self.clear_up();
        Ok(())
    }

    /// Removes partly written logs of killed processes. Recent ones may belong to a running process.
    fn clear_up(&self) {
        let Ok(entries) = std::fs::read_dir(&self.path) else { return };
        for entry in entries.flatten() {
            let name = entry.file_name();
            let name = name.to_string_lossy();
            let left = name.starts_with('.') && name.ends_with(".part") && name.contains(".csv.");
            let age =
                entry.metadata().and_then(|m| m.modified()).ok().and_then(|t| t.elapsed().ok());
            if left && age.is_some_and(|age| age > LEFT_OVER) {
                let _ = std::fs::remove_file(entry.path());
            }
        }
    }

    fn part(&self, name: &str) -> PathBuf {
        self.path(PARTS).join(format!("run.{name}.json"))
    }
}

fn read_json<File: DeserializeOwned>(path: &Path) -> Option<File> {
    serde_json::from_str(&std::fs::read_to_string(path).ok()?).ok()
}

/// A hash of everything that the logs depend on.
fn fingerprint(rig: &Rig, plan: &PlanFile) -> String {
    let mut hash = Fnv(0xcbf2_9ce4_8422_2325);
    // Writing to a hash does not fail. The debug form has every number to the last bit.
    let _ = write!(hash, "{} {rig:?} {plan:?}", env!("CARGO_PKG_VERSION"));
    format!("{:016x}", hash.0)
}

/// FNV-1a, the same on every machine and in every version.
struct Fnv(u64);

impl fmt::Write for Fnv {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for byte in text.bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
        Ok(())
    }
}
