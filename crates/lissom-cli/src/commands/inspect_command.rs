//! `lissom inspect LOG...`.

use std::path::Path;

use lissom_io::inspect::{InspectionFile, TextOptions, inspect_with};
use lissom_io::write::{self, Batch};

use crate::args::inspect_args::InspectArgs;
use crate::args::stdout_name::STDOUT;
use crate::shared::exit_codes::ExitCode;
use crate::shared::failure::Failure;
use crate::shared::output_guard;
use crate::views::{channel_plots, inspection_table, printer};

pub(crate) fn run(args: &InspectArgs) -> Result<ExitCode, Failure> {
    let json = args.json.as_deref();
    let json_file = json.filter(|path| *path != Path::new(STDOUT));
    output_guard::guard(json_file, None)?;
    let inputs: Vec<&Path> = args.logs.iter().map(AsRef::as_ref).collect();
    output_guard::guard_inputs(json_file, &inputs)?;
    let options = TextOptions {
        header_row: args.header_row,
        skip_rows: args.skip_rows,
        ..TextOptions::default()
    };
    let (mut found, mut failures) = (Vec::new(), Vec::new());
    for log in &args.logs {
        match inspect_with(log, &options) {
            Ok(inspection) => found.push(inspection),
            // Files are written only if all logs can be read; on the terminal one log does not hide the others.
            Err(error) if json.is_some() || args.plots.is_some() => return Err(error.into()),
            Err(error) => failures.push(Failure::from(error)),
        }
    }
    let content = InspectionFile::of(&found);
    let mut batch = Batch::new();
    if let Some(path) = json_file {
        batch.file(path, write::json_text(path, &content)?.as_bytes())?;
    }
    if let Some(folder) = &args.plots {
        for log in &found {
            channel_plots::add(&mut batch, folder, log, found.len() > 1)?;
        }
    }
    batch.commit()?;
    if json.is_some() && json_file.is_none() {
        printer::json(&content)?;
        return Ok(ExitCode::SUCCESS);
    }
    for (k, log) in found.iter().enumerate() {
        if k > 0 {
            printer::line("");
        }
        inspection_table::print(log);
    }
    failures.iter().for_each(printer::failure);
    Ok(if failures.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
