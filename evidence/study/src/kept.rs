//! Writes campaigns to a file as they are identified, so that a stopped study can be continued.

use std::fs::{File, OpenOptions};
use std::io::{self, BufReader, Seek, Write};
use std::path::Path;
use std::sync::{Mutex, PoisonError};

use serde::{Deserialize, Serialize};

use crate::law::Law;
use crate::study::{Scored, Study};

/// The reason why campaigns cannot be written or read.
pub type KeptError = Box<dyn std::error::Error + Send + Sync>;

/// A file of identified campaigns of any study: a sequence of CBOR values. CBOR can store NaN, JSON
/// cannot.
#[derive(Debug)]
pub struct Kept {
    file: Mutex<File>,
    found: Vec<Record>,
}

/// One campaign and its study. The version of the code is not stored: a study that is resumed after a
/// change of the estimators mixes results of both.
#[derive(Debug, Serialize, Deserialize)]
struct Record {
    law: Law,
    seed: u64,
    quick: bool,
    index: usize,
    scored: Option<Scored>,
}

impl Kept {
    /// An empty file at `path`.
    ///
    /// # Errors
    /// If it cannot be created.
    pub fn create(path: &Path) -> Result<Self, KeptError> {
        Ok(Self { file: Mutex::new(File::create(path)?), found: Vec::new() })
    }

    /// The file at `path` with its campaigns, or an empty one. If the last value is incomplete, it is
    /// removed.
    ///
    /// # Errors
    /// If it cannot be read or written, or is not a file of campaigns.
    pub fn resume(path: &Path) -> Result<Self, KeptError> {
        let mut file =
            OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path)?;
        let mut found = Vec::new();
        let mut sound = 0;
        let mut reader = BufReader::new(&file);
        loop {
            match ciborium::from_reader::<Record, _>(&mut reader) {
                Ok(record) => found.push(record),
                Err(ciborium::de::Error::Io(e)) if e.kind() == io::ErrorKind::UnexpectedEof => {
                    break;
                }
                Err(error) => {
                    let path = path.display();
                    return Err(format!(
                        "{path}, byte {sound}: {error}. The file is not from a study. Without --resume it is replaced"
                    )
                    .into());
                }
            }
            sound = reader.stream_position()?;
        }
        drop(reader);
        file.set_len(sound)?;
        file.seek(io::SeekFrom::Start(sound))?;
        Ok(Self { file: Mutex::new(file), found })
    }

    /// A campaign of this study, if the resumed file has it; the inner `None` means that all draws failed.
    pub fn known(&self, study: &Study, index: usize) -> Option<Option<Scored>> {
        let same = |r: &&Record| {
            (r.law, r.seed, r.quick, r.index) == (study.law, study.seed, study.quick, index)
        };
        self.found.iter().find(same).map(|r| r.scored.clone())
    }

    /// Appends a campaign to the file.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn keep(
        &self,
        study: &Study,
        index: usize,
        scored: Option<&Scored>,
    ) -> Result<(), KeptError> {
        let Study { law, seed, quick, .. } = *study;
        let record = Record { law, seed, quick, index, scored: scored.cloned() };
        let mut bytes = Vec::new();
        ciborium::into_writer(&record, &mut bytes)?;
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        file.write_all(&bytes)?;
        Ok(())
    }
}
