//! A row of a table: which of its cells have values.

use super::cells::{Cell, Decimal, Separator};

/// A row of numbers.
pub(super) struct Row {
    /// Number of cells up to the last filled one.
    pub(super) width: usize,
    /// Number of cells up to the last one with a value: words behind the table are remarks.
    pub(super) values_end: usize,
    /// Cells with values, less those with words.
    pub(super) values: usize,
}

impl Row {
    /// A line as a row; `None` if most of its cells are no values.
    pub(super) fn of(line: &str, separator: Separator, decimal: Decimal) -> Option<Self> {
        let (mut values, mut words, mut width, mut values_end) = (0_usize, 0_usize, 0, 0);
        for (k, cell) in separator.cells(line).enumerate() {
            match Cell::of(cell, decimal) {
                Cell::Blank => continue,
                Cell::Words => words += 1,
                _ => {
                    values += 1;
                    values_end = k + 1;
                }
            }
            width = k + 1;
        }
        (values > words).then(|| Self { width, values_end, values: values - words })
    }
}
