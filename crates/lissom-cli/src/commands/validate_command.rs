//! `lissom validate RESULT LOG`.

use std::path::Path;

use lissom::identify::{Severity, ValidationOptions, validate};
use lissom_io::write::{self, Batch};
use lissom_io::{
    CampaignFile, UnitNames, ValidationFile, read_arm, read_campaign, read_campaign_like,
};
use lissom_views::validation_plots;

use crate::args::stdout_name::STDOUT;
use crate::args::validate_args::ValidateArgs;
use crate::shared::exit_codes::ExitCode;
use crate::shared::failure::Failure;
use crate::shared::output_guard;
use crate::tasks::described_logs::is_toml;
use crate::views::{campaign_summary, finding_list, plot_file, printer, validation_table};

pub(crate) fn run(args: &ValidateArgs) -> Result<ExitCode, Failure> {
    let json = args.json.as_deref();
    let json_file = json.filter(|path| *path != Path::new(STDOUT));
    output_guard::guard(json_file, None)?;
    output_guard::guard_inputs(json_file, &[&args.result, &args.log])?;
    let file = log(args)?;
    let campaign = &file.campaign;
    let found = read_arm(&args.result, &campaign.channels)?;
    let options = ValidationOptions { window_s: args.window, horizon_s: args.horizon };
    let validation = validate(&found, campaign, &options)
        .map_err(|source| Failure::Validate { log: args.log.clone(), source })?;
    let result = ValidationFile::of(campaign, &found, &validation);
    let mut batch = Batch::new();
    if let Some(path) = json_file {
        batch.file(path, write::json_text(path, &result)?.as_bytes())?;
    }
    if let Some(folder) = &args.plots {
        plot_file::add_all(&mut batch, folder, &validation_plots(campaign, &validation))?;
    }
    batch.commit()?;
    if json.is_some() && json_file.is_none() {
        printer::json(&result)?;
    } else {
        campaign_summary::campaign(UnitNames::new(&campaign.channels), campaign);
        validation_table::validation(
            UnitNames::new(&campaign.channels),
            campaign,
            &found,
            &validation,
        );
        finding_list::findings(&validation.findings);
    }
    let refused = validation.findings.iter().any(|f| f.severity() == Severity::Refusal);
    Ok(if refused { ExitCode::REFUSED } else { ExitCode::SUCCESS })
}

/// Reads the log: a campaign.toml, or one log with the columns and units of another campaign.
fn log(args: &ValidateArgs) -> Result<CampaignFile, Failure> {
    match &args.like {
        Some(campaign) => Ok(read_campaign_like(campaign, &args.log)?),
        None if is_toml(&args.log) => Ok(read_campaign(&args.log)?),
        None => Err(Failure::UndescribedLog { log: args.log.clone() }),
    }
}
