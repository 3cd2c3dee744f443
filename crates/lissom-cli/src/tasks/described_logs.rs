//! Logs that no campaign.toml describes: what the log shows and what the user says make one.

use std::path::{Path, PathBuf};

use lissom::identify::hold_shown;
use lissom::record::Hold;
use lissom_io::inspect::{CampaignDraft, Description, DraftError, Inspection, Role, inspect_with};
use lissom_io::{CampaignFile, CampaignReader};

use crate::shared::failure::Failure;
use crate::shared::shell_word::shell_word;

/// Name of the description in messages.
const NAME: &str = "description of the log";

/// Logs, as they are described.
pub(crate) struct DescribedLogs {
    /// The first log.
    pub(crate) log: Inspection,
    /// The campaign made of it.
    pub(crate) draft: CampaignDraft,
    /// A channel that is not used.
    unused: Option<String>,
}

/// The option for a channel that is probably a point of the arm, if its unit is known.
pub(crate) fn tip_option(log: &Inspection) -> Option<String> {
    let tip = log.roles.of(Role::Tip)?;
    let channel = &log.channels[tip.channel];
    let unit = channel.unit.as_ref().filter(|unit| unit.known.is_some())?;
    Some(format!("--tip {}", shell_word(&format!("{}:{}", channel.label(), unit.text))))
}

impl DescribedLogs {
    /// Looks at the first log, and makes a campaign of all.
    pub(crate) fn new(logs: &[PathBuf], said: &Description) -> Result<Self, Failure> {
        let first = logs.first().ok_or(lissom_io::Error::from(DraftError::NoLog))?;
        let log = inspect_with(first, &said.text_options())?;
        let draft = CampaignDraft::new(&log, logs, said).map_err(lissom_io::Error::from)?;
        for other in &logs[1..] {
            log.same_units(other, &said.text_options())?;
        }
        let unused = tip_option(&log).filter(|_| said.tips.is_empty());
        let unused = unused.map(|option| {
            format!("a channel that is probably a point of the arm is not used: add {option}")
        });
        let mut described = Self { log, draft, unused };
        if let Some(hold) = described.hold_shown() {
            let said = Description { hold_shown: Some(hold), ..said.clone() };
            let draft = CampaignDraft::new(&described.log, logs, &said);
            described.draft = draft.map_err(lissom_io::Error::from)?;
        }
        Ok(described)
    }

    /// That the command is held, and why, if only the motion shows it. Logs that cannot be read show nothing here.
    fn hold_shown(&self) -> Option<(String, String)> {
        if !self.draft.assumes_hold() {
            return None;
        }
        let campaign = self.read().ok()?.campaign;
        let found = hold_shown(&campaign).filter(|found| found.hold == Hold::Sampled)?;
        let why = format!(
            "as a measured command it would act {:.2} ± {:.2} samples late: it is held from one sample to the next",
            found.delay_samples, found.delay_std_samples
        );
        Some(("sampled".to_owned(), why))
    }

    /// What does not agree in the first log, and what of it is not used.
    pub(crate) fn notes(&self) -> impl Iterator<Item = &str> {
        self.log.notes.iter().chain(&self.unused).map(String::as_str)
    }

    /// Reads the logs.
    pub(crate) fn read(&self) -> Result<CampaignFile, Failure> {
        let text = self.draft.text().map_err(lissom_io::Error::from)?;
        Ok(CampaignReader::of_text(NAME, text).read()?)
    }
}

/// Whether a path is that of a campaign.toml.
pub(crate) fn is_toml(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml"))
}
