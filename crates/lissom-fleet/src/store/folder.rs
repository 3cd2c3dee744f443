//! A folder that is written.

use std::collections::{HashMap, HashSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use lissom_io::write::{create_folder, write_whole};

use super::folder_lock::FolderLock;
use super::manifest::{Manifest, PartEntry};
use super::part::part_bytes;
use super::part_columns::{FAILURE, LOG, MACHINE, TIME, Values, columns};
use super::table::FleetTable;
use crate::checksum::Checksum;
use crate::existing_rows::ExistingRows;
use crate::fleet_error::FleetError;
use crate::fleet_log::FleetLog;
use crate::row::{Failure, FleetRow};
use crate::settings::FleetSettings;
use crate::version::VERSION;

/// Shortest time between two writings of the manifest: work of this time is done again if the program is killed.
const MANIFEST_EVERY: Duration = Duration::from_millis(500);
/// Ends of the names of parts.
const PART: (&str, &str) = ("part-", ".parquet");

/// Columns by name.
type Columns = Vec<(String, Values)>;

/// A folder that is written by one run at a time.
#[derive(Debug)]
pub(crate) struct FleetFolder {
    path: PathBuf,
    manifest: Manifest,
    next_part: u64,
    written: Instant,
    is_behind: bool,
    _lock: FolderLock,
}

impl FleetFolder {
    /// Opens a folder, or makes it. Rows of `logs` take their machines and times. Also gives the names of logs that have rows.
    pub(crate) fn open(
        path: &Path,
        settings: &FleetSettings,
        existing: &ExistingRows,
        logs: &[FleetLog],
    ) -> Result<(Self, HashSet<String>), FleetError> {
        create_folder(path)?;
        let lock = FolderLock::new(path)?;
        let mut manifest = match Manifest::read(path)? {
            Some(_) if *existing == ExistingRows::Refuse => {
                return Err(FleetError::NotEmpty { folder: path.to_owned() });
            }
            Some(found) => {
                same(path, &found.settings, settings)?;
                found
            }
            None if has_parts(path)? => {
                return Err(FleetError::NoManifest { folder: path.to_owned() });
            }
            None => {
                let manifest = Manifest::new(settings.clone());
                manifest.write(path)?;
                manifest
            }
        };
        // A part that the user has deleted: its logs are done again.
        let listed = manifest.parts.len();
        manifest.parts.retain(|part| path.join(&part.file).exists());
        let lacks_part = manifest.parts.len() < listed;
        manifest.check_parts(path)?;
        let numbers = manifest.parts.iter().filter_map(|part| number(&part.file));
        let next_part = numbers.max().map_or(1, |last| last + 1);
        let (written, is_behind) = (Instant::now(), lacks_part);
        let mut folder =
            Self { path: path.to_owned(), manifest, next_part, written, is_behind, _lock: lock };
        if let ExistingRows::KeepBut(failures) = existing {
            folder.take_out(failures)?;
        }
        folder.take_places(logs)?;
        remove_others(path, &folder.manifest)?;
        let table = FleetTable::new(path.to_owned(), folder.manifest.clone());
        let done = match table.column(LOG)? {
            Some(Values::Text(names)) => names.into_iter().flatten().collect(),
            _ => HashSet::new(),
        };
        Ok((folder, done))
    }

    /// Takes out the rows with these failures.
    fn take_out(&mut self, failures: &[Failure]) -> Result<(), FleetError> {
        let is_taken = |failure: &Option<String>| {
            failure.as_deref().and_then(Failure::of).is_some_and(|f| failures.contains(&f))
        };
        self.replace_parts(|table| {
            let Some(Values::Text(all)) = table.column(FAILURE)? else { return Ok(None) };
            let kept: Vec<bool> = all.iter().map(|failure| !is_taken(failure)).collect();
            if kept.iter().all(|kept| *kept) {
                return Ok(None);
            }
            let columns = table.columns()?.into_iter();
            Ok(Some(columns.map(|(name, values)| (name, values.only(&kept))).collect()))
        })
    }

    /// Gives rows the machines and times of their logs, where those are known: a pattern or table may have been corrected.
    fn take_places(&mut self, logs: &[FleetLog]) -> Result<(), FleetError> {
        let placed = logs.iter().filter(|log| log.machine.is_some() || log.time_us.is_some());
        let known: HashMap<&str, &FleetLog> = placed.map(|log| (log.log.as_str(), log)).collect();
        if known.is_empty() {
            return Ok(());
        }
        self.replace_parts(|table| {
            let (
                Some(Values::Text(names)),
                Some(Values::Text(mut machines)),
                Some(Values::Time(mut times)),
            ) = (table.column(LOG)?, table.column(MACHINE)?, table.column(TIME)?)
            else {
                return Ok(None);
            };
            let mut differs = false;
            for ((name, machine), time) in names.iter().zip(&mut machines).zip(&mut times) {
                let Some(log) = name.as_deref().and_then(|name| known.get(name)) else { continue };
                if log.machine.is_some() && log.machine != *machine {
                    (*machine, differs) = (log.machine.clone(), true);
                }
                if log.time_us.is_some() && log.time_us != *time {
                    (*time, differs) = (log.time_us, true);
                }
            }
            if !differs {
                return Ok(None);
            }
            let mut columns = table.columns()?;
            for (name, values) in &mut columns {
                match name.as_str() {
                    MACHINE => *values = Values::Text(std::mem::take(&mut machines)),
                    TIME => *values = Values::Time(std::mem::take(&mut times)),
                    _ => {}
                }
            }
            Ok(Some(columns))
        })
    }

    /// Replaces parts by parts with other columns, if `new` gives some. Parts without rows are left out.
    fn replace_parts(
        &mut self,
        new: impl Fn(&FleetTable) -> Result<Option<Columns>, FleetError>,
    ) -> Result<(), FleetError> {
        let mut parts = Vec::new();
        for part in self.manifest.parts.clone() {
            let one = Manifest { parts: vec![part.clone()], ..self.manifest.clone() };
            let Some(columns) = new(&FleetTable::new(self.path.clone(), one))? else {
                parts.push(part);
                continue;
            };
            self.is_behind = true;
            let rows = columns.first().map_or(0, |(_, values)| values.len());
            if rows > 0 {
                let failed = part.failed - (part.rows - rows);
                let (file, sha256) = self.write_part(&columns)?;
                parts.push(PartEntry { file, rows, failed, sha256, ..part });
            }
        }
        self.manifest.parts = parts;
        self.finish()
    }

    /// Writes the next part; gives its file and the SHA-256 of its bytes.
    fn write_part(&mut self, columns: &[(String, Values)]) -> Result<(String, String), FleetError> {
        let file = format!("{}{:06}{}", PART.0, self.next_part, PART.1);
        let path = self.path.join(&file);
        let bytes = part_bytes(columns)
            .map_err(|e| FleetError::Damaged { path: path.clone(), problem: e.to_string() })?;
        write_whole(&path, |out| out.write_all(&bytes))?;
        self.next_part += 1;
        let mut checksum = Checksum::default();
        checksum.add(&bytes[..]).map_err(|source| FleetError::Part { path, source })?;
        Ok((file, checksum.text()))
    }

    /// Adds rows: a part, and the manifest now or at the next time.
    pub(crate) fn add(&mut self, rows: &[FleetRow]) -> Result<(), FleetError> {
        if rows.is_empty() {
            return Ok(());
        }
        let (file, sha256) = self.write_part(&columns(rows))?;
        let failed = rows.iter().filter(|row| row.failure().is_some()).count();
        let seconds = rows.iter().map(|row| row.seconds).sum();
        self.manifest.parts.push(PartEntry { file, rows: rows.len(), failed, seconds, sha256 });
        self.is_behind = true;
        self.finish_if_due()
    }

    /// Writes the manifest, if it is behind for long enough.
    pub(crate) fn finish_if_due(&mut self) -> Result<(), FleetError> {
        if self.written.elapsed() >= MANIFEST_EVERY { self.finish() } else { Ok(()) }
    }

    /// Writes the manifest, if it is behind.
    pub(crate) fn finish(&mut self) -> Result<(), FleetError> {
        if self.is_behind {
            self.manifest.write(&self.path)?;
            (self.written, self.is_behind) = (Instant::now(), false);
        }
        Ok(())
    }
}

/// Checks that results were made in the same way. The time limit and retries may differ.
fn same(folder: &Path, then: &FleetSettings, now: &FleetSettings) -> Result<(), FleetError> {
    let differs = [
        ("version of lissom", then.version != VERSION),
        ("campaign", then.campaign != now.campaign),
        ("choice of files or folders as logs", then.by_folder != now.by_folder),
        ("effort", then.effort != now.effort),
        ("refinement", then.refinement != now.refinement),
        ("choice of whole results", then.keep_results != now.keep_results),
    ];
    match differs.into_iter().find(|(_, differs)| *differs) {
        Some((what, _)) => Err(FleetError::OtherSettings { folder: folder.to_owned(), what }),
        None => Ok(()),
    }
}

/// Removes what a killed run left: parts that the manifest does not list, and files that were not complete.
fn remove_others(folder: &Path, manifest: &Manifest) -> Result<(), FleetError> {
    let failed = |source| FleetError::Read { path: folder.to_owned(), source };
    let kept: HashSet<&str> = manifest.parts.iter().map(|part| part.file.as_str()).collect();
    for entry in fs::read_dir(folder).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        let name = entry.file_name().to_string_lossy().into_owned();
        let is_part = number(&name).is_some() && !kept.contains(name.as_str());
        let is_incomplete =
            name.starts_with('.') && Path::new(&name).extension().is_some_and(|end| end == "part");
        if is_part || is_incomplete {
            lissom_io::write::remove(&entry.path())?;
        }
    }
    Ok(())
}

/// Whether a folder has parts.
fn has_parts(folder: &Path) -> Result<bool, FleetError> {
    let failed = |source| FleetError::Read { path: folder.to_owned(), source };
    let mut entries = fs::read_dir(folder).map_err(failed)?;
    Ok(entries.any(|entry| entry.is_ok_and(|e| number(&e.file_name().to_string_lossy()).is_some())))
}

/// The number in the name of a part.
fn number(file: &str) -> Option<u64> {
    file.strip_prefix(PART.0)?.strip_suffix(PART.1)?.parse().ok()
}
