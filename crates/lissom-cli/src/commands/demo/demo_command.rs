//! `lissom demo`: the experiment of the 1989 report on a virtual rig, identified from its logs only.

use std::path::Path;

use lissom_io::write::{self, Batch};
use lissom_io::{ArmFile, ResultFile, read_campaign};
use lissom_views::{Reference, own_logs, report_page, result_figures};

use super::demo_campaign;
use crate::args::demo_args::DemoArgs;
use crate::args::stdout_name::STDOUT;
use crate::shared::command_hint::PAGE_HINTS;
use crate::shared::exit_codes::ExitCode;
use crate::shared::failure::Failure;
use crate::shared::output_guard;
use crate::shared::progress_bar::during;
use crate::tasks::demo_comparison::{compared, comparison};
use crate::tasks::identification::{Asked, identified};
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
    plot_file::add_all(&mut batch, out, &result_figures(channels, &id, Some(&truth)))?;
    batch.commit()?;
    let own = during("prediction for the report page", || own_logs(&file.campaign, &id));
    let (own, truth) = (own.as_ref(), Some(&truth));
    let page = report_page::page("lissom demo", &file.campaign, &id, own, truth, None, PAGE_HINTS);
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
