//! A stored result with logs that its arm predicts.

use lissom::identify::{LogPrediction, predict_logs};
use lissom::record::Campaign;
use lissom_io::{CampaignFile, CampaignReader, ResultFile, read_arm, read_campaign};
use lissom_views::report_page::PageContent;
use lissom_views::{ProgramHints, Reference};

use crate::args::stored_args::StoredArgs;
use crate::shared::command_hint::stored_page_hints;
use crate::shared::failure::Failure;
use crate::shared::progress_bar::during;
use crate::tasks::described_logs::is_toml;

/// What a page of a stored result is made of.
pub(crate) struct StoredResult {
    pub(crate) result: ResultFile,
    logs: Option<(CampaignFile, LogPrediction)>,
    reference: Option<Reference>,
    hints: ProgramHints,
}

impl StoredResult {
    /// Reads the result and the logs, and predicts the logs.
    pub(crate) fn read(args: &StoredArgs) -> Result<Self, Failure> {
        let result = ResultFile::read(&args.result)?;
        let hints = stored_page_hints(&result.findings);
        let Some(file) = logs(args)? else {
            return Ok(Self { result, logs: None, reference: None, hints });
        };
        let arm = read_arm(&args.result, &file.campaign.channels)?;
        let reference = Reference::of(&file)?;
        let predicted = during("prediction of the logs", || predict_logs(&arm, &file.campaign));
        let predicted = predicted.map_err(|source| {
            let log = args.logs.first().unwrap_or(&args.result).clone();
            Failure::Validate { log, source }
        })?;
        Ok(Self { result, logs: Some((file, predicted)), reference, hints })
    }

    /// What the page shows.
    pub(crate) fn content(&self) -> PageContent<'_> {
        PageContent {
            result: &self.result,
            logs: self.logs(),
            reference: self.reference.as_ref(),
            hints: &self.hints,
        }
    }

    fn logs(&self) -> Option<(&Campaign, &LogPrediction)> {
        self.logs.as_ref().map(|(file, predicted)| (&file.campaign, predicted))
    }
}

/// Reads the logs: a campaign.toml, or logs with the columns and units of another campaign.
fn logs(args: &StoredArgs) -> Result<Option<CampaignFile>, Failure> {
    if let Some(campaign) = &args.like {
        let reader = CampaignReader::of_file(campaign);
        return Ok(Some(args.logs.iter().fold(reader, |reader, log| reader.only(log)).read()?));
    }
    match args.logs.as_slice() {
        [] => Ok(None),
        [campaign] if is_toml(campaign) => Ok(Some(read_campaign(campaign)?)),
        [log] => Err(Failure::UndescribedLog { log: log.clone() }),
        [campaign, ..] if is_toml(campaign) => Err(Failure::Asked(
            format!("{}: describes its logs itself: no other log may be given", campaign.display()),
            "give one campaign.toml, or logs with --like campaign.toml",
        )),
        [log, ..] => Err(Failure::UndescribedLog { log: log.clone() }),
    }
}
