//! `lissom init LOG...`.

use std::path::PathBuf;

use lissom::DescribedLogs;
use lissom_io::write;

use crate::args::init_args::InitArgs;
use crate::shared::exit_codes::ExitCode;
use crate::shared::failure::Failure;
use crate::shared::shell_word::shell_word;
use crate::views::{draft_lines, printer};

pub(crate) fn run(args: &InitArgs) -> Result<ExitCode, Failure> {
    if args.out.exists() {
        return Err(Failure::Exists { file: args.out.clone() });
    }
    // Files of a campaign are relative to its folder.
    let elsewhere = args.out.parent().is_some_and(|folder| !folder.as_os_str().is_empty());
    let whole = |log: &PathBuf| match std::path::absolute(log) {
        Ok(path) if elsewhere => path,
        _ => log.clone(),
    };
    let logs: Vec<PathBuf> = args.logs.iter().map(whole).collect();
    let found = DescribedLogs::new(&logs, &args.said.description())?;
    let text = format!(
        "# Written by `lissom init`. Check every line: units, and whether the input is commanded or measured.\n\
         # All keys: the page campaign.toml of the book.\n\n{}",
        found.draft.commented()
    );
    write::write_text(&args.out, &text)?;
    draft_lines::taken(&found.draft);
    let missing: Vec<String> = found.draft.missing().map(ToString::to_string).collect();
    for text in &missing {
        printer::line(&format!("to do: {text}"));
    }
    let out = shell_word(&args.out.display().to_string());
    printer::line(&format!("written: {out}"));
    printer::line(&if missing.is_empty() {
        format!("next: lissom identify {out} --report report.html")
    } else {
        format!("next: complete the lines marked TO DO in {out}, then lissom identify {out}")
    });
    Ok(ExitCode::SUCCESS)
}
