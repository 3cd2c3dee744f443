//! `lissom compare RESULT RESULT...`: parameters side by side.

use std::path::Path;

use lissom_io::write::{self, Batch};

use crate::args::compare_args::CompareArgs;
use crate::args::stdout_name::STDOUT;
use crate::shared::exit_codes::ExitCode;
use crate::shared::failure::Failure;
use crate::shared::output_guard;
use crate::tasks::result_comparison::{compared, is_result};
use crate::views::{compare_table, printer};

pub(crate) fn run(args: &CompareArgs) -> Result<ExitCode, Failure> {
    let json = args.json.as_deref();
    let json_file = json.filter(|path| *path != Path::new(STDOUT));
    output_guard::guard(json_file, None)?;
    let inputs: Vec<&Path> = args.results.iter().map(AsRef::as_ref).collect();
    output_guard::guard_inputs(json_file, &inputs)?;
    // In `--json a.json b.json c.json` the first is a result, too.
    if let Some(file) = json_file.filter(|file| is_result(file)) {
        return Err(Failure::NotAnOutput { file: file.to_owned() });
    }
    let found = compared(&args.results)?;
    if let Some(path) = json_file {
        let mut batch = Batch::new();
        batch.file(path, write::json_text(path, &found)?.as_bytes())?;
        batch.commit()?;
    }
    if json.is_some() && json_file.is_none() {
        printer::json(&found)?;
    } else {
        compare_table::comparison(&found);
    }
    Ok(ExitCode::SUCCESS)
}
