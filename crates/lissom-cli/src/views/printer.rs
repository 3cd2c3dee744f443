//! All printing of the command: results to standard output, errors and remarks to standard error.
#![expect(clippy::print_stderr, reason = "the command's printer")]

use std::io::{ErrorKind, Write as _};
use std::path::Path;

use lissom_io::write;
use serde::Serialize;

use crate::shared::failure::Failure;

/// Prints an error and its hint.
pub(crate) fn failure(failure: &Failure) {
    eprintln!("error: {failure}");
    if let Some(hint) = failure.hint() {
        eprintln!("hint: {hint}");
    }
}

/// Prints a line of the result. If the reader closes the pipe (as `head` does), the command ends without a message.
pub(crate) fn line(text: &str) {
    if let Err(error) = writeln!(std::io::stdout().lock(), "{text}") {
        if error.kind() != ErrorKind::BrokenPipe {
            eprintln!("error: standard output: {error}");
        }
        std::process::exit(i32::from(error.kind() != ErrorKind::BrokenPipe));
    }
}

/// Prints a remark that is not part of the result.
pub(crate) fn note(text: &str) {
    eprintln!("{text}");
}

/// Prints JSON to standard output, the same text as in a file.
pub(crate) fn json(value: &impl Serialize) -> Result<(), Failure> {
    line(write::json_text(Path::new("standard output"), value)?.trim_end());
    Ok(())
}

/// Prints a table with its first column aligned to the left, the others to the right.
pub(crate) fn table(rows: &[Vec<String>]) {
    for text in lissom_text::table_lines(rows) {
        line(&text);
    }
}

/// Wraps a text into lines of at most `width` characters; a longer word gets its own line.
pub(crate) fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(last) if last.chars().count() + 1 + word.chars().count() <= width => {
                last.push(' ');
                last.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}
