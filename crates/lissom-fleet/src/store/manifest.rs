//! The manifest: what was asked, and the parts that count.

use std::collections::HashSet;
use std::fs::File;
use std::path::Path;

use lissom_io::write::write_json;
use serde::{Deserialize, Serialize};

use crate::checksum::Checksum;
use crate::fleet_error::FleetError;
use crate::settings::FleetSettings;

/// Name of the manifest's file.
pub const MANIFEST: &str = "manifest.json";
/// Form of the folder.
const FORMAT: u32 = 2;

/// What was asked of a fleet, and the parts that count.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// Form of the folder.
    pub format: u32,
    /// What was done with every log.
    pub settings: FleetSettings,
    /// The parts that count, in the order in which they were written. Other files in the folder do not.
    pub parts: Vec<PartEntry>,
}

/// A part.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PartEntry {
    /// Its file.
    pub file: String,
    /// Number of its rows.
    pub rows: usize,
    /// Number of rows without a result.
    pub failed: usize,
    /// Time of its logs \[s\].
    pub seconds: f64,
    /// SHA-256 of its bytes, in hexadecimal digits.
    pub sha256: String,
}

impl Manifest {
    /// A manifest without parts.
    pub(super) fn new(settings: FleetSettings) -> Self {
        Self { format: FORMAT, settings, parts: Vec::new() }
    }

    /// Reads the manifest of a folder; none if there is none.
    pub(super) fn read(folder: &Path) -> Result<Option<Self>, FleetError> {
        let path = folder.join(MANIFEST);
        let text = match std::fs::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(source) => return Err(FleetError::Read { path, source }),
        };
        let damaged = |problem: String| FleetError::Damaged { path: path.clone(), problem };
        let found: Self = serde_json::from_str(&text).map_err(|e| damaged(e.to_string()))?;
        if found.format != FORMAT {
            return Err(damaged(format!("its format is {}, and not {FORMAT}", found.format)));
        }
        let mut files = HashSet::new();
        if let Some(part) = found.parts.iter().find(|part| !files.insert(part.file.as_str())) {
            return Err(damaged(format!("{} is listed twice", part.file)));
        }
        // A part is a file of this folder.
        match found.parts.iter().find(|part| Path::new(&part.file).components().count() != 1) {
            Some(part) => Err(damaged(format!("{} is no file of this folder", part.file))),
            None => Ok(Some(found)),
        }
    }

    /// Checks that the bytes of all parts are those that were written.
    ///
    /// # Errors
    /// [`FleetError::Read`] or [`FleetError::Damaged`] if those of one are not.
    pub(super) fn check_parts(&self, folder: &Path) -> Result<(), FleetError> {
        for part in &self.parts {
            let path = folder.join(&part.file);
            let mut found = Checksum::default();
            File::open(&path)
                .and_then(|file| found.add(file))
                .map_err(|source| FleetError::Part { path: path.clone(), source })?;
            if found.text() != part.sha256 {
                let problem = "its bytes are not those that were written".to_owned();
                return Err(FleetError::Damaged { path, problem });
            }
        }
        Ok(())
    }

    /// Replaces the manifest of a folder: all of it, or nothing.
    pub(super) fn write(&self, folder: &Path) -> Result<(), FleetError> {
        Ok(write_json(&folder.join(MANIFEST), self)?)
    }
}
