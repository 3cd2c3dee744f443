//! `lissom compare RESULT RESULT...`: parameters side by side.

use std::path::{Path, PathBuf};

use lissom_io::write::{self, Batch};
use lissom_io::{ComparedFile, Error, ParameterList, ResultFile};
use lissom_views::compare_page;

use crate::args::compare_args::CompareArgs;
use crate::args::stdout_name::STDOUT;
use crate::shared::exit_codes::ExitCode;
use crate::shared::failure::Failure;
use crate::shared::output_guard;
use crate::views::{compare_table, printer};

pub(crate) fn run(args: &CompareArgs) -> Result<ExitCode, Failure> {
    let json = args.json.as_deref();
    let json_file = json.filter(|path| *path != Path::new(STDOUT));
    let report = args.report.as_deref();
    output_guard::guard(json_file, report)?;
    let inputs: Vec<&Path> = args.results.iter().map(AsRef::as_ref).collect();
    output_guard::guard_inputs(json_file, &inputs)?;
    output_guard::guard_inputs(report, &inputs)?;
    // In `--json a.json b.json c.json` the first is a result, too.
    if let Some(file) = json_file.filter(|file| is_result(file)) {
        return Err(Failure::NotAnOutput { file: file.to_owned() });
    }
    let found = compared(&args.results)?;
    let mut batch = Batch::new();
    if let Some(path) = json_file {
        batch.file(path, write::json_text(path, &found)?.as_bytes())?;
    }
    if let Some(path) = report {
        let page = compare_page::page("Comparison", &found);
        batch.file(path, page.to_html().as_bytes())?;
    }
    batch.commit()?;
    if json.is_some() && json_file.is_none() {
        printer::json(&found)?;
    } else {
        compare_table::comparison(&found);
    }
    Ok(ExitCode::SUCCESS)
}

/// Reads the results and compares them.
fn compared(files: &[PathBuf]) -> Result<ComparedFile, Failure> {
    refuse_repeated(files)?;
    let read = |file: &PathBuf| {
        let result = ResultFile::read(file).map_err(Failure::NoResult)?;
        Ok::<_, Failure>((file.display().to_string(), ParameterList::of(&result)))
    };
    let lists = files.iter().map(read).collect::<Result<Vec<_>, _>>()?;
    Ok(ComparedFile::of(&lists).map_err(Error::from)?)
}

/// Whether a file is a result of `lissom identify`.
fn is_result(file: &Path) -> bool {
    file.is_file() && ResultFile::read(file).is_ok()
}

fn refuse_repeated(files: &[PathBuf]) -> Result<(), Failure> {
    if let [only] = files {
        let words = format!("{}: is the only result given", only.display());
        return Err(Failure::Asked(
            words,
            "give two or more: lissom compare before.json after.json",
        ));
    }
    for (i, file) in files.iter().enumerate() {
        let whole = file.canonicalize().ok();
        for earlier in &files[..i] {
            if whole.is_some() && earlier.canonicalize().ok() == whole {
                let words = format!("{}: is given twice", file.display());
                let hint = "give results from different logs: only their errors are independent";
                return Err(Failure::Asked(words, hint));
            }
        }
    }
    Ok(())
}
