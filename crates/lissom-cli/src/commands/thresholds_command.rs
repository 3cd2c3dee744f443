//! `lissom thresholds`.

use std::path::Path;

use lissom_io::ThresholdsFile;
use lissom_io::write::{self, Batch};

use crate::args::stdout_name::STDOUT;
use crate::args::thresholds_args::ThresholdsArgs;
use crate::shared::exit_codes::ExitCode;
use crate::shared::failure::Failure;
use crate::shared::output_guard;
use crate::views::{printer, threshold_table};

pub(crate) fn run(args: &ThresholdsArgs) -> Result<ExitCode, Failure> {
    let json = args.json.as_deref();
    let json_file = json.filter(|path| *path != Path::new(STDOUT));
    output_guard::guard(json_file, None)?;
    if let Some(path) = json_file {
        let mut batch = Batch::new();
        batch.file(path, write::json_text(path, &ThresholdsFile::all())?.as_bytes())?;
        batch.commit()?;
    }
    if json.is_some() && json_file.is_none() {
        printer::json(&ThresholdsFile::all())?;
    } else {
        threshold_table::thresholds();
    }
    Ok(ExitCode::SUCCESS)
}
