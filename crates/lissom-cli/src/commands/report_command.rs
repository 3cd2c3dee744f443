//! `lissom report RESULT [LOG...]`.

use std::path::Path;

use lissom_io::write::Batch;
use lissom_views::report_page;

use crate::args::report_args::ReportArgs;
use crate::shared::exit_codes::ExitCode;
use crate::shared::failure::Failure;
use crate::shared::output_guard;
use crate::shared::shell_word::shell_word;
use crate::tasks::stored_result::StoredResult;
use crate::views::printer;

pub(crate) fn run(args: &ReportArgs) -> Result<ExitCode, Failure> {
    let stored = &args.stored;
    let out = args.out.clone().unwrap_or_else(|| stored.result.with_extension("html"));
    let inputs = [&stored.result].into_iter().chain(&stored.logs).chain(&stored.like);
    let inputs: Vec<&Path> = inputs.map(AsRef::as_ref).collect();
    output_guard::guard_inputs(Some(&out), &inputs)?;
    output_guard::guard(None, Some(&out))?;
    let found = StoredResult::read(stored)?;
    let page = report_page::page(&stored.result.display().to_string(), found.content());
    let mut batch = Batch::new();
    batch.file(&out, page.to_html().as_bytes())?;
    batch.commit()?;
    printer::line(&format!("written: {}", shell_word(&out.display().to_string())));
    Ok(ExitCode::SUCCESS)
}
