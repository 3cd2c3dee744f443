//! `lissom identify CAMPAIGN`.

use std::io::{IsTerminal as _, stdout};
use std::path::Path;

use lissom::DescribedLogs;
use lissom::identify::{Effort, Identified, Severity};
use lissom_io::write::{self, Batch};
use lissom_io::{ResultFile, UnitNames, read_campaign};
use lissom_views::friction_speeds::friction_speeds_words;
use lissom_views::known_arm::checked;
use lissom_views::report_page::{self, PageContent};
use lissom_views::unused_torque::unused_torque_words;
use lissom_views::{Reference, result_figures};

use crate::args::identify_args::IdentifyArgs;
use crate::args::stdout_name::STDOUT;
use crate::shared::command_hint::page_hints;
use crate::shared::exit_codes::ExitCode;
use crate::shared::failure::Failure;
use crate::shared::output_guard;
use crate::tasks::described_logs::{is_toml, notes};
use crate::tasks::identification::{Asked, first_answer, identified};
use crate::tasks::page_logs::predicted;
use crate::views::{
    arm_check_words, campaign_summary, draft_lines, equivalent_table, finding_list,
    parameter_table, plot_file, printer, separability_words,
};

pub(crate) fn run(args: &IdentifyArgs) -> Result<ExitCode, Failure> {
    let json = args.json.as_deref();
    let json_file = json.filter(|path| *path != Path::new(STDOUT));
    output_guard::guard(json_file, args.report.as_deref())?;
    let described = described(args)?;
    let file = match &described {
        Some(logs) => logs.read()?,
        None => read_campaign(&args.input[0])?,
    };
    let name = args.input[0].as_path();
    let names = UnitNames::new(&file.campaign.channels);
    let reference = Reference::of(&file)?;
    let reference = reference.as_ref();
    let asked =
        Asked { window_s: args.window, effort: args.effort(), time_limit_s: args.time_limit };
    let to_terminal = json.is_none_or(|path| path != Path::new(STDOUT)) && stdout().is_terminal();
    if to_terminal && asked.effort != Effort::Quick {
        let first = first_answer(name, &file, asked)?;
        printer::line("first result, before the search (running now):");
        let first = ResultFile::of(&file.campaign.channels, &first, None);
        parameter_table::parameters(names, &first, reference);
        printer::line("");
    }
    let id = identified(name, &file, asked)?;
    let geometry = checked(&id, reference);
    let result = ResultFile::of(&file.campaign.channels, &id, geometry.as_ref());
    let mut batch = Batch::new();
    if let Some(path) = &args.report {
        let title = name.display().to_string();
        let own = predicted(&file.campaign, id.arm.as_ref());
        let logs = own.as_ref().map(|own| (&file.campaign, own));
        let hints = &page_hints(&id.findings);
        let page =
            report_page::page(&title, PageContent { result: &result, logs, reference, hints });
        batch.file(path, page.to_html().as_bytes())?;
    }
    if let Some(path) = json_file {
        batch.file(path, write::json_text(path, &result)?.as_bytes())?;
    }
    if let Some(folder) = &args.plots {
        let plots = result_figures(&result, reference);
        plot_file::add_all(&mut batch, folder, &plots)?;
    }
    batch.commit()?;
    if json.is_some() && json_file.is_none() {
        printer::json(&result)?;
    } else {
        if let Some(logs) = &described {
            for note in notes(logs, &args.said.description()) {
                printer::line(&note);
            }
            draft_lines::taken(&logs.draft);
        }
        campaign_summary::campaign(names, &file.campaign);
        campaign_summary::ranges(names, &file.campaign);
        campaign_summary::runs(&id);
        printer::line("");
        parameter_table::parameters(names, &result, reference);
        if let Some(words) = unused_torque_words(&result) {
            printer::line(&words);
        }
        for words in friction_speeds_words(&result) {
            printer::line(&words);
        }
        parameter_table::constant_velocity(&result);
        if let Some(found) = &result.equivalent {
            equivalent_table::brief(names, found);
        }
        arm_check_words::print(result.geometry.as_ref());
        separability_words::print(names.axis, &id);
        finding_list::findings(&id.findings);
    }
    Ok(code(&id))
}

/// The logs, if no campaign.toml is given.
fn described(args: &IdentifyArgs) -> Result<Option<DescribedLogs>, Failure> {
    let campaigns = args.input.iter().filter(|path| is_toml(path) || path.is_dir()).count();
    if campaigns == 0 {
        return Ok(Some(DescribedLogs::new(&args.input, &args.said.description())?));
    }
    if args.input.len() > 1 || !args.said.is_empty() {
        return Err(Failure::Asked(
            "a campaign.toml describes its logs itself: no other file and no option about columns or drive may be given"
                .to_owned(),
            "give one campaign.toml, or logs",
        ));
    }
    Ok(None)
}

fn code(id: &Identified) -> ExitCode {
    if id.is_interrupted() {
        return ExitCode::INTERRUPTED;
    }
    let refused = id.findings.iter().any(|f| f.severity() == Severity::Refusal);
    if refused { ExitCode::REFUSED } else { ExitCode::SUCCESS }
}
