//! Logs that no campaign.toml describes: what a log shows and what the user says make one.

use std::path::{Path, PathBuf};

use lissom_core::identify::{HoldEvidence, hold_shown};
use lissom_core::record::Hold;
use lissom_io::inspect::{CampaignDraft, Description, DraftError, Inspection, inspect_with};
use lissom_io::log::{LastFile, LogPath};
use lissom_io::{CampaignFile, CampaignReader, Error};

/// Name of the description in messages.
const NAME: &str = "description of the log";

/// Logs, as they are described.
#[derive(Debug, Clone)]
pub struct DescribedLogs {
    /// The first log.
    pub log: Inspection,
    /// The campaign made of it.
    pub draft: CampaignDraft,
    folder: PathBuf,
}

impl DescribedLogs {
    /// Looks at the first log, and makes a campaign of all. Roles are guessed where they are unambiguous; units are those of
    /// the log or of what is said, never a guess. Whether a command is held is found from the motion if nothing says it.
    ///
    /// # Errors
    /// [`Error::Log`] if a log cannot be read, [`Error::Draft`] if what is said does not fit it.
    pub fn new(logs: &[PathBuf], said: &Description) -> Result<Self, Error> {
        let first = logs.first().ok_or(DraftError::NoLog)?;
        Self::in_folder(inspect_with(first, &said.text_options())?, Path::new(""), logs, said)
    }

    /// The same with a first log that is inspected already; the logs are relative to a folder.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn in_folder(
        first: Inspection,
        folder: &Path,
        logs: &[PathBuf],
        said: &Description,
    ) -> Result<Self, Error> {
        let draft = CampaignDraft::new(&first, logs, said)?;
        let mut files = LastFile::default();
        for (index, other) in logs.iter().map(|other| folder.join(other)).enumerate() {
            // The first log has others in it where its path fits several groups.
            if index == 0 && LogPath::of(&other).group.is_none() {
                continue;
            }
            let content = files.content(&LogPath::of(&other), &said.text_options());
            first.same_units(&other, content.map_err(Error::from)?)?;
        }
        let mut described = Self { log: first, draft, folder: folder.to_owned() };
        if let Some(hold) = described.hold_shown() {
            let said = Description { hold_shown: Some(hold), ..said.clone() };
            described.draft = CampaignDraft::new(&described.log, logs, &said)?;
        }
        Ok(described)
    }

    /// Whether the command is held, and why, if only the motion shows it. Logs that cannot be read show nothing here.
    fn hold_shown(&self) -> Option<(String, String)> {
        if !self.draft.assumes_hold() {
            return None;
        }
        let campaign = self.read().ok()?.campaign;
        let found = hold_shown(&campaign)?;
        let why = match (found.by, found.hold) {
            (HoldEvidence::Delay(delay), Hold::Sampled) => format!(
                "as a measured command it would act {:.2} ± {:.2} samples late: it is held from one sample to the next",
                delay.value, delay.std
            ),
            (HoldEvidence::Delay(delay), Hold::Measured) => format!(
                "it acts {:.2} ± {:.2} samples late, a held command would act half a sample late: it is measured",
                delay.value, delay.std
            ),
            (HoldEvidence::Viscous { measured, held }, hold) => format!(
                "viscous friction would be {measured} as a measured command, {held} as a held one: it is {}",
                if hold == Hold::Sampled { "held from one sample to the next" } else { "measured" }
            ),
            _ => return None,
        };
        let name = if found.hold == Hold::Sampled { "sampled" } else { "measured" };
        Some((name.to_owned(), why))
    }

    /// Reads the logs.
    ///
    /// # Errors
    /// [`Error::Draft`] if something is missing in the description; others if a log cannot be used.
    pub fn read(&self) -> Result<CampaignFile, Error> {
        CampaignReader::of_text(NAME, self.draft.text()?).in_folder(&self.folder).read()
    }
}
