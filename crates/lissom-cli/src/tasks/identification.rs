//! Identification of a campaign, with a progress bar and an end by Ctrl-C or a time limit.

use std::path::Path;
use std::time::Duration;

use lissom::identify::{Effort, Identified, Interrupt, Options, Stage, identify};
use lissom_io::CampaignFile;

use crate::shared::failure::Failure;
use crate::shared::{interrupted, progress_bar};

/// Options of an identification that are not in the campaign file.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Asked {
    /// Length of the regression's window \[s\]; chosen from the data if absent.
    pub(crate) window_s: Option<f64>,
    /// Effort of the search.
    pub(crate) effort: Effort,
    /// Time after which the search stops with the best result so far \[s\].
    pub(crate) time_limit_s: Option<f64>,
}

/// Identifies a campaign, with a progress bar. After Ctrl-C or the time limit the result is the best one so far.
pub(crate) fn identified(
    path: &Path,
    file: &CampaignFile,
    asked: Asked,
) -> Result<Identified, Failure> {
    // A time that is too long for a `Duration` is no limit.
    let limit = asked.time_limit_s.and_then(|s| Duration::try_from_secs_f64(s).ok());
    let interrupt = limit.map_or_else(Interrupt::default, Interrupt::after);
    interrupted::on_ctrl_c(&interrupt);
    let options = options(file, asked, interrupt);
    let steps = Stage::count(file.campaign.runs.len());
    let progress = progress_bar::Stages::new(steps, &options);
    let id = identify(&file.campaign, &options, |stage| progress.stage(stage));
    progress.finish();
    id.map_err(|source| Failure::Identify { campaign: path.to_owned(), source })
}

/// The result of the methods that need no search, which takes a fraction of a second.
pub(crate) fn first_answer(
    path: &Path,
    file: &CampaignFile,
    asked: Asked,
) -> Result<Identified, Failure> {
    let asked = Asked { effort: Effort::Quick, ..asked };
    let found = identify(&file.campaign, &options(file, asked, Interrupt::default()), |_| ());
    found.map_err(|source| Failure::Identify { campaign: path.to_owned(), source })
}

fn options(file: &CampaignFile, asked: Asked, interrupt: Interrupt) -> Options {
    let of_file = file.options();
    let window_s = asked.window_s.map_or(of_file.window_s, |w| vec![w]);
    Options { window_s, effort: asked.effort, interrupt, ..of_file }
}
