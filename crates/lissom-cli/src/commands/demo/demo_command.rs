//! `lissom demo`: the experiment of the 1989 report on a virtual rig, identified from its logs only.

use std::path::Path;

use lissom_io::write::{self, Batch};
use lissom_io::{ArmFile, ResultFile, read_campaign};
use lissom_views::report_page::{self, PageContent};
use lissom_views::{Reference, result_figures};

use super::demo_campaign;
use crate::args::demo_args::DemoArgs;
use crate::args::stdout_name::STDOUT;
use crate::shared::command_hint::page_hints;
use crate::shared::exit_codes::ExitCode;
use crate::shared::failure::Failure;
use crate::shared::output_guard;
use crate::tasks::demo_comparison::{compared, comparison};
use crate::tasks::identification::{Asked, identified};
use crate::tasks::page_logs::predicted;
use crate::views::{demo_table, plot_file, printer};

/// The arm.toml of the demo.
const ARM: &str = include_str!("arm.toml");

pub(crate) fn run(args: &DemoArgs) -> Result<ExitCode, Failure> {
    let out = &args.out;
    output_guard::guard(args.json.as_deref().filter(|path| *path != Path::new(STDOUT)), None)?;
    let arm_path = out.join("arm.toml");
    let rig = ArmFile::from_text(&arm_path, ARM)?.rig(&arm_path).map_err(lissom_io::Error::from)?;
    write::create_folder(out)?;
    write::write_text(&arm_path, ARM)?;
    demo_campaign::write_logs(&rig, out)?;

    let campaign_path = out.join("campaign.toml");
    let file = read_campaign(&campaign_path)?;
    let id = identified(&campaign_path, &file, Asked::default())?;

    let channels = &file.campaign.channels;
    let truth = Reference::truth(&rig.arm);
    let result = ResultFile::of(channels, &id, None);
    write::write_json(&out.join("result.json"), &result)?;
    let mut batch = Batch::new();
    plot_file::add_all(&mut batch, out, &result_figures(&result, Some(&truth)))?;
    batch.commit()?;
    let own = predicted(&file.campaign, id.arm.as_ref());
    let logs = own.as_ref().map(|own| (&file.campaign, own));
    let (reference, hints) = (Some(&truth), &page_hints(&id.findings));
    let content = PageContent { result: &result, logs, reference, hints };
    let page = report_page::page("lissom demo", content);
    write::write_text(&out.join("report.html"), &page.to_html())?;

    let rows = comparison(&rig.arm, &id);
    match args.json.as_deref() {
        Some(path) if path == Path::new(STDOUT) => printer::json(&compared(&rows, result))?,
        json => {
            if let Some(path) = json {
                write::write_json(path, &compared(&rows, result))?;
            }
            demo_table::report(out, &file.campaign, &id, &rows);
        }
    }
    Ok(ExitCode::SUCCESS)
}
