//! A folder that is written.

use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use lissom_io::write::{create_folder, write_whole};

use super::folder_lock::FolderLock;
use super::manifest::{Manifest, PartEntry};
use super::part::part_bytes;
use super::part_columns::{FAILURE, LOG, Values, columns};
use super::table::FleetTable;
use crate::existing_rows::ExistingRows;
use crate::fleet_error::FleetError;
use crate::row::{Failure, FleetRow};
use crate::settings::FleetSettings;
use crate::version::VERSION;

/// Shortest time between two writings of the manifest: work of this time is done again if the program is killed.
const MANIFEST_EVERY: Duration = Duration::from_millis(500);
/// Ends of the names of parts.
const PART: (&str, &str) = ("part-", ".parquet");

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
    /// Opens a folder, or makes it. Also gives the names of logs that have rows.
    pub(crate) fn open(
        path: &Path,
        settings: &FleetSettings,
        existing: &ExistingRows,
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
        let numbers = manifest.parts.iter().filter_map(|part| number(&part.file));
        let next_part = numbers.max().map_or(1, |last| last + 1);
        let (written, is_behind) = (Instant::now(), lacks_part);
        let mut folder =
            Self { path: path.to_owned(), manifest, next_part, written, is_behind, _lock: lock };
        if let ExistingRows::KeepBut(failures) = existing {
            folder.take_out(failures)?;
        }
        remove_others(path, &folder.manifest)?;
        let table = FleetTable::new(path.to_owned(), folder.manifest.clone());
        let done = match table.column(LOG)? {
            Some(Values::Text(names)) => names.into_iter().flatten().collect(),
            _ => HashSet::new(),
        };
        Ok((folder, done))
    }

    /// Takes out the rows with these failures: parts that have some are replaced by parts without them.
    fn take_out(&mut self, failures: &[Failure]) -> Result<(), FleetError> {
        let is_taken = |failure: &Option<String>| {
            failure.as_deref().and_then(Failure::of).is_some_and(|f| failures.contains(&f))
        };
        let mut parts = Vec::new();
        for part in self.manifest.parts.clone() {
            let one = Manifest { parts: vec![part.clone()], ..self.manifest.clone() };
            let table = FleetTable::new(self.path.clone(), one);
            let Some(Values::Text(all)) = table.column(FAILURE)? else {
                parts.push(part);
                continue;
            };
            let kept: Vec<bool> = all.iter().map(|failure| !is_taken(failure)).collect();
            let rows = kept.iter().filter(|kept| **kept).count();
            if rows == part.rows {
                parts.push(part);
                continue;
            }
            let mut columns = Vec::new();
            for name in table.names()? {
                if let Some(values) = table.column(&name)? {
                    columns.push((name, values.only(&kept)));
                }
            }
            if rows > 0 {
                let failed = part.failed - (part.rows - rows);
                let file = self.write_part(&columns)?;
                parts.push(PartEntry { file, rows, failed, ..part });
            }
        }
        self.manifest.parts = parts;
        self.is_behind = true;
        self.finish()
    }

    /// Writes the next part; gives its file.
    fn write_part(&mut self, columns: &[(String, Values)]) -> Result<String, FleetError> {
        let file = format!("{}{:06}{}", PART.0, self.next_part, PART.1);
        let path = self.path.join(&file);
        let bytes = part_bytes(columns)
            .map_err(|e| FleetError::Damaged { path: path.clone(), problem: e.to_string() })?;
        write_whole(&path, |out| out.write_all(&bytes))?;
        self.next_part += 1;
        Ok(file)
    }

    /// Adds rows: a part, and the manifest now or at the next time.
    pub(crate) fn add(&mut self, rows: &[FleetRow]) -> Result<(), FleetError> {
        if rows.is_empty() {
            return Ok(());
        }
        let file = self.write_part(&columns(rows))?;
        let failed = rows.iter().filter(|row| row.failure().is_some()).count();
        let seconds = rows.iter().map(|row| row.seconds).sum();
        self.manifest.parts.push(PartEntry { file, rows: rows.len(), failed, seconds });
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

/// The number in the name of a part.
fn number(file: &str) -> Option<u64> {
    file.strip_prefix(PART.0)?.strip_suffix(PART.1)?.parse().ok()
}
