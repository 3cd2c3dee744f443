//! What is done with every log.

use std::path::{Component, Path, PathBuf};
use std::time::Duration;

use lissom::identify::findings;
use lissom_io::{CampaignReader, EffortName};
use serde::{Deserialize, Serialize};

use crate::fleet_error::FleetError;
use crate::row::{FleetRow, RowOutcome};
use crate::version::VERSION;

/// What is done with every log of a fleet.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FleetSettings {
    /// Version of lissom that made these settings.
    pub version: String,
    /// What errors call the campaign; a file in it is relative to the folder of this name.
    pub campaign_name: PathBuf,
    /// Text of the `campaign.toml` that describes every log; its runs are read only if logs are folders.
    pub campaign: String,
    /// Whether each log is a folder with the files of the campaign's runs. Otherwise it is one file.
    #[serde(default)]
    pub by_folder: bool,
    /// Effort for every log.
    pub effort: EffortName,
    /// When a log is identified again with more effort.
    pub refinement: Option<Refinement>,
    /// Time for one log \[s\]. A search ends with its best result so far after 80 % of it; a process that needs longer is
    /// ended.
    pub time_limit_s: f64,
    /// How often a log is tried again whose process ended unexpectedly.
    pub retries: u32,
    /// Whether the rows contain the whole result as JSON.
    pub keep_results: bool,
}

/// A second identification with more effort.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Refinement {
    /// Its effort.
    pub effort: EffortName,
    /// Codes of the findings that ask for it; if empty, every refusal and `angle-lag`.
    pub codes: Vec<String>,
}

/// Time limit of a log, if nothing else is said \[s\].
pub const TIME_LIMIT_S: f64 = 60.0;
/// Retries, if nothing else is said.
pub const RETRIES: u32 = 2;
/// Share of a log's time after which a search ends with its best result so far.
const SEARCH_SHARE: f64 = 0.8;

impl FleetSettings {
    /// Quick for every log, normal effort where an estimate is refused or the angle lags.
    pub fn new(campaign_name: impl Into<PathBuf>, campaign: impl Into<String>) -> Self {
        Self {
            version: VERSION.to_owned(),
            campaign_name: campaign_name.into(),
            campaign: campaign.into(),
            by_folder: false,
            effort: EffortName::Quick,
            refinement: Some(Refinement { effort: EffortName::Normal, codes: Vec::new() }),
            time_limit_s: TIME_LIMIT_S,
            retries: RETRIES,
            keep_results: false,
        }
    }

    /// Checks that the campaign describes logs; no log is read.
    ///
    /// # Errors
    /// As [`FleetSettings::run_files`].
    pub(crate) fn check_campaign(&self, folder: &Path) -> Result<(), FleetError> {
        self.run_files()?;
        match self.reader(&folder.join(".no-log")).read() {
            Ok(_) | Err(lissom_io::Error::Log(_)) => Ok(()),
            Err(error) => Err(FleetError::Campaign(Box::new(error))),
        }
    }

    /// Checks that the findings exist that ask for a refinement.
    ///
    /// # Errors
    /// [`FleetError::FindingCode`] if one does not.
    pub(crate) fn check_codes(&self) -> Result<(), FleetError> {
        let asked = self.refinement.iter().flat_map(|more| &more.codes);
        match asked.into_iter().find(|code| !findings::codes().contains(&code.as_str())) {
            Some(code) => Err(FleetError::FindingCode { code: code.clone() }),
            None => Ok(()),
        }
    }

    /// If each log is a folder: the files of the campaign's runs, relative to the folder, in the order of the campaign, with `/`
    /// between their parts.
    ///
    /// # Errors
    /// [`FleetError::Campaign`] if a key or value of the campaign is wrong or it has no runs, [`FleetError::Runs`] if a file of a
    /// run is not in the folder of the log.
    pub fn run_files(&self) -> Result<Option<Vec<String>>, FleetError> {
        if !self.by_folder {
            return Ok(None);
        }
        let campaign = |error| FleetError::Campaign(Box::new(error));
        let files = self.text_reader().run_files().map_err(campaign)?;
        let mut relative = Vec::with_capacity(files.len());
        for file in files {
            let Some(path) = below_a_folder(&file) else {
                let place = self.campaign_name.display().to_string();
                let problem =
                    format!("the file \"{}\" is not in the folder of a log", file.display());
                return Err(FleetError::Runs { place, problem });
            };
            if !relative.contains(&path) {
                relative.push(path);
            }
        }
        Ok(Some(relative))
    }

    fn text_reader(&self) -> CampaignReader {
        CampaignReader::of_text(&self.campaign_name, self.campaign.clone())
    }

    /// The reader of a log.
    pub(crate) fn reader(&self, log: &Path) -> CampaignReader {
        if self.by_folder {
            self.text_reader().in_folder(log)
        } else {
            self.text_reader().only(log)
        }
    }

    /// Whether a row is of more effort than every log has.
    pub(crate) fn is_refined(&self, row: &FleetRow) -> bool {
        matches!(&row.outcome, RowOutcome::Identified(found) if found.effort > self.effort)
    }

    /// The time for one log.
    pub(crate) fn time_limit(&self) -> Duration {
        Duration::try_from_secs_f64(self.time_limit_s).unwrap_or(Duration::MAX)
    }

    /// The time after which a search ends.
    pub(crate) fn search_limit(&self) -> Duration {
        Duration::try_from_secs_f64(SEARCH_SHARE * self.time_limit_s).unwrap_or(Duration::MAX)
    }
}

/// A path that stays in its folder, with `/` between its parts.
fn below_a_folder(path: &Path) -> Option<String> {
    let mut parts = Vec::new();
    for part in path.components() {
        match part {
            Component::Normal(part) => parts.push(part.to_str()?),
            Component::CurDir => {}
            _ => return None,
        }
    }
    (!parts.is_empty()).then(|| parts.join("/"))
}
