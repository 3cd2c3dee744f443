//! `lissom identify CAMPAIGN`.

use std::path::Path;
use std::process::ExitCode;

use lissom::identify::{Identified, Options, Severity, identify};
use lissom_io::units::{Dimension, parse_quantity};
use lissom_io::{CampaignFile, UnitNames, read_campaign, result_json, write};

use crate::cli::IdentifyArgs;
use crate::failure::Failure;
use crate::{figures, page, print, progress};

/// The verdict refuses a figure asked for.
pub(crate) const REFUSED: u8 = 3;

pub(crate) fn run(args: &IdentifyArgs) -> Result<ExitCode, Failure> {
    let window = args
        .window
        .as_deref()
        .map(|text| parse_quantity(text, Dimension::TIME))
        .transpose()
        .map_err(Failure::Window)?;
    let file = read_campaign(&args.campaign)?;
    let id = identified(&args.campaign, &file, window)?;
    let result = result_json(&file.campaign.channels, &id);
    let names = UnitNames::new(&file.campaign.channels);
    if let Some(path) = &args.report {
        let title = args.campaign.display().to_string();
        let text = page::page(&title, &file.campaign, names, &id, None);
        write::write_text(path, &text)?;
    }
    if let Some(folder) = &args.plots {
        figures::write_all(folder, &file.campaign.channels, names, &id, None)?;
    }
    match &args.json {
        Some(None) => print::json(&result),
        other => {
            if let Some(Some(path)) = other {
                write::write_json(path, &result)?;
            }
            print::campaign(&file.campaign);
            print::runs(&id);
            print::line("");
            print::figures(names, &id);
            print::findings(&id.findings);
        }
    }
    Ok(code(&id))
}

/// Identifies a campaign that was read, with a progress bar.
pub(crate) fn identified(
    path: &Path,
    file: &CampaignFile,
    window: Option<f64>,
) -> Result<Identified, Failure> {
    let window_s = window.map_or_else(|| file.analysis.window_s.clone(), |w| vec![w]);
    let options = Options { window_s, harmonics: file.analysis.harmonics };
    let bar = progress::bar(progress::steps(file.campaign.runs.len()), "identifying");
    let id = identify(&file.campaign, &options, |stage| progress::stage(&bar, stage));
    bar.finish_and_clear();
    id.map_err(|source| Failure::Identify { campaign: path.to_owned(), source })
}

fn code(id: &Identified) -> ExitCode {
    let refused = id.findings.iter().any(|f| f.severity == Severity::Refusal);
    if refused { ExitCode::from(REFUSED) } else { ExitCode::SUCCESS }
}
