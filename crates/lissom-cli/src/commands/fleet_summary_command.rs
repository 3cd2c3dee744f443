//! `lissom fleet summary`.

use std::path::Path;

use lissom_fleet::{SummaryOptions, open, summarise};
use lissom_io::write::{self, Batch};
use lissom_views::fleet_page;

use crate::args::fleet_args::FleetSummaryArgs;
use crate::args::stdout_name::STDOUT;
use crate::shared::exit_codes::ExitCode;
use crate::shared::failure::Failure;
use crate::shared::output_guard;
use crate::views::{fleet_summary_table, printer};

pub(crate) fn run(args: &FleetSummaryArgs) -> Result<ExitCode, Failure> {
    let json = args.json.as_deref();
    let json_file = json.filter(|path| *path != Path::new(STDOUT));
    output_guard::guard(json_file, args.report.as_deref())?;
    let summary = summarise(&open(&args.folder)?, SummaryOptions::default())?;
    let mut batch = Batch::new();
    if let Some(path) = json_file {
        batch.file(path, write::json_text(path, &summary)?.as_bytes())?;
    }
    if let Some(path) = &args.report {
        let title = format!("Fleet {}", args.folder.display());
        batch.file(path, fleet_page::page(&title, &summary).as_bytes())?;
    }
    batch.commit()?;
    if json.is_some() && json_file.is_none() {
        printer::json(&summary)?;
    } else {
        fleet_summary_table::print(&summary);
    }
    Ok(ExitCode::SUCCESS)
}
