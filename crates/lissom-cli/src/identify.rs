//! `lissom identify CAMPAIGN`.

use std::path::Path;
use std::process::ExitCode;

use lissom::identify::{Identified, Options, Severity, identify};
use lissom_io::write::{self, Batch};
use lissom_io::{CampaignFile, ResultFile, UnitNames, read_campaign};

use crate::cli::{IdentifyArgs, STDOUT};
use crate::failure::Failure;
use crate::reference::Reference;
use crate::{equivalent, figures, geometry, output, page, print, progress};

/// The verdict refuses a figure asked for.
pub(crate) const REFUSED: u8 = 3;

pub(crate) fn run(args: &IdentifyArgs) -> Result<ExitCode, Failure> {
    let json = args.json.as_deref();
    let json_file = json.filter(|path| *path != Path::new(STDOUT));
    output::guard(json_file, args.report.as_deref())?;
    let file = read_campaign(&args.campaign)?;
    let id = identified(&args.campaign, &file, args.window, args.quick)?;
    let names = UnitNames::new(&file.campaign.channels);
    let reference = Reference::of(&file)?;
    let reference = reference.as_ref();
    let geometry = geometry::check(&id, reference);
    let result = ResultFile::of(&file.campaign.channels, &id, geometry.as_ref());
    let mut batch = Batch::new();
    if let Some(path) = &args.report {
        let title = args.campaign.display().to_string();
        let text = page::page(&title, &file.campaign, names, &id, reference, geometry.as_ref());
        batch.file(path, text.as_bytes())?;
    }
    if let Some(path) = json_file {
        batch.file(path, write::json_text(path, &result)?.as_bytes())?;
    }
    if let Some(folder) = &args.plots {
        figures::add_all(&mut batch, folder, &file.campaign.channels, names, &id, reference)?;
    }
    batch.commit()?;
    if json.is_some() && json_file.is_none() {
        print::json(&result);
    } else {
        print::campaign(&file.campaign);
        print::ranges(names, &file.campaign);
        print::runs(&id);
        print::line("");
        print::figures(names, &id, reference);
        print::constant_velocity(names, &id);
        if let Some(found) = &id.equivalent {
            equivalent::brief(names, found);
        }
        geometry::print(geometry.as_ref());
        print::verdict(names.axis, &id);
        print::findings(&id.findings);
    }
    Ok(code(&id))
}

/// Identifies a campaign that was read, with a progress bar.
pub(crate) fn identified(
    path: &Path,
    file: &CampaignFile,
    window: Option<f64>,
    without_output_error: bool,
) -> Result<Identified, Failure> {
    let window_s = window.map_or_else(|| file.analysis.window_s.clone(), |w| vec![w]);
    let harmonics = file.analysis.harmonics;
    let options = Options { window_s, harmonics, without_output_error };
    let bar = progress::stages(progress::steps(file.campaign.runs.len()));
    let id = identify(&file.campaign, &options, |stage| progress::stage(&bar, stage));
    bar.finish_and_clear();
    id.map_err(|source| Failure::Identify { campaign: path.to_owned(), source })
}

fn code(id: &Identified) -> ExitCode {
    let refused = id.findings.iter().any(|f| f.severity == Severity::Refusal);
    if refused { ExitCode::from(REFUSED) } else { ExitCode::SUCCESS }
}
