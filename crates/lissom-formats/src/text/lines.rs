//! Lines of a text that are rows of a table, and those that are not.

/// A table with at least so many columns may have one row for each signal.
pub(super) const MANY_COLUMNS: usize = 50;

/// Whether a line belongs to no table: it is blank or a comment.
pub(super) fn is_skipped(line: &str) -> bool {
    let line = line.trim_start();
    line.is_empty() || line.starts_with(['#', '%'])
}

/// The lines of names and units above line `first`: a table may repeat them.
pub(super) fn header_lines<'a>(lines: &[&'a str], first: usize) -> Vec<&'a str> {
    let above = lines[..first].iter().rev().map(|line| line.trim());
    above.filter(|line| !line.is_empty()).take(2).collect()
}
