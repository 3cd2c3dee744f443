//! The manifest: what was asked, and the parts that count.

use std::collections::HashSet;
use std::path::Path;

use lissom_io::write::write_json;
use serde::{Deserialize, Serialize};

use crate::fleet_error::FleetError;
use crate::settings::FleetSettings;

/// Name of the manifest's file.
pub const MANIFEST: &str = "manifest.json";
/// Form of the folder.
const FORMAT: u32 = 1;

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

    /// Replaces the manifest of a folder: all of it, or nothing.
    pub(super) fn write(&self, folder: &Path) -> Result<(), FleetError> {
        Ok(write_json(&folder.join(MANIFEST), self)?)
    }
}
