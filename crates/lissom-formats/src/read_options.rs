//! How a text is read.

/// How a text is read, where its content does not show it. Other formats state it themselves.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct ReadOptions {
    /// The row with the names of the columns, counted from 1 as an editor does; the table is the first one below it.
    pub header_row: Option<usize>,
    /// Rows at the top of the file that are left out.
    pub skip_rows: usize,
    /// Whether the numbers have a decimal comma.
    pub decimal_comma: Option<bool>,
}
