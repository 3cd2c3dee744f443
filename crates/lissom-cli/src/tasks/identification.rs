//! Identification of a campaign, with a progress bar.

use std::path::Path;

use lissom::identify::{Identified, Options, identify};
use lissom_io::CampaignFile;

use crate::shared::failure::Failure;
use crate::shared::progress_bar;

/// Identifies a campaign that was read, with a progress bar.
pub(crate) fn identified(
    path: &Path,
    file: &CampaignFile,
    window: Option<f64>,
    without_output_error: bool,
) -> Result<Identified, Failure> {
    let window_s = window.map_or_else(|| file.analysis.window_s.clone(), |w| vec![w]);
    let harmonics = file.analysis.harmonics;
    let options = Options { window_s, harmonics, without_output_error, most_evaluations: None };
    let bar = progress_bar::stages(progress_bar::steps(file.campaign.runs.len()));
    let id = identify(&file.campaign, &options, |stage| progress_bar::stage(&bar, stage));
    bar.finish_and_clear();
    id.map_err(|source| Failure::Identify { campaign: path.to_owned(), source })
}
