//! Names and units above a table.

use super::cells::{Cell, Decimal, Separator};
use crate::unit;

/// Least number of columns of a table that may have a column without a name.
const WIDE: usize = 4;

/// Names of the columns, and their units.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Header {
    pub(crate) names: Vec<String>,
    pub(crate) units: Vec<Option<String>>,
    /// Line of the names, from 0.
    pub(crate) line: Option<usize>,
}

impl Header {
    /// The header above line `first` of a table with `width` columns.
    pub(crate) fn above(lines: &[&str], first: usize, width: usize, separator: Separator) -> Self {
        let above = (0..first).rev().filter(|k| !lines[*k].trim().is_empty()).take(2);
        let rows: Vec<(usize, Vec<&str>)> =
            above.map(|k| (k, separator.cells(unmarked(lines[k])).collect())).collect();
        // The last column of a wide table may have no name.
        let unnamed = usize::from(width >= WIDE);
        // Where units are below them, names may be numbers: those of the channels of an oscilloscope.
        let full = |cells: &[&str], with_units: bool| {
            let filled = cells.iter().filter(|c| !c.is_empty()).count();
            let is_number = |c: &&str| matches!(Cell::of(c, Decimal::Point), Cell::Number(_));
            let numbers = cells.iter().filter(|c| is_number(c)).count();
            let are_names = if with_units { numbers < filled } else { numbers == 0 };
            are_names && 2 * filled >= width && cells.len() + unnamed >= width
        };
        let of = |at: usize, units: Option<&[&str]>| {
            let (line, mut cells) = rows[at].clone();
            cells.resize(width, "");
            Self::of(line, &cells, units.unwrap_or_default())
        };
        match &rows[..] {
            [(_, units), (_, above)] if is_units(units, width) && full(above, true) => {
                of(1, Some(units))
            }
            [(_, cells), ..] if full(cells, false) => of(0, None),
            // Without a separator at their ends, words fit where cells are separated by blanks.
            _ => Self::default(),
        }
    }

    /// The header in a row, counted from 1, above line `first`.
    ///
    /// # Errors
    /// The number of names, if they are fewer than half of the columns.
    pub(crate) fn stated(
        lines: &[&str],
        row: usize,
        first: usize,
        width: usize,
        separator: Separator,
    ) -> Result<Self, usize> {
        let cells = |line: usize| -> Vec<&str> {
            lines.get(line).map_or_else(Vec::new, |text| separator.cells(unmarked(text)).collect())
        };
        let line = row.saturating_sub(1);
        let mut names = cells(line);
        let filled = names.iter().take(width).filter(|c| !c.is_empty()).count();
        if 2 * filled < width {
            return Err(filled);
        }
        names.resize(width, "");
        let units = (row..first).map(cells).find(|cells| is_units(cells, width));
        Ok(Self::of(line, &names, &units.unwrap_or_default()))
    }

    fn of(line: usize, cells: &[&str], units: &[&str]) -> Self {
        let names: Vec<String> = cells.iter().map(|cell| (*cell).to_owned()).collect();
        let stated = |k: usize| units.get(k).filter(|text| unit::is_unit(text));
        let unit = |(k, name): (usize, &String)| {
            stated(k).map(|unit| unit::bare(unit).to_owned()).or_else(|| unit::in_name(name))
        };
        Self { units: names.iter().enumerate().map(unit).collect(), names, line: Some(line) }
    }
}

/// A line without the mark of a comment.
fn unmarked(line: &str) -> &str {
    line.trim_start_matches(['#', '%', ' '])
}

/// Whether most of the filled cells are units: one may state that the column is an index.
fn is_units(cells: &[&str], width: usize) -> bool {
    let filled = || cells.iter().take(width).filter(|cell| !cell.is_empty());
    let units = filled().filter(|cell| unit::is_unit(cell)).count();
    2 * units > filled().count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_units() {
        let lines = ["made by x", "t,i [A],q", "s,A,rad", "0,1,2"];
        let header = Header::above(&lines, 3, 3, Separator::Char(','));
        assert_eq!(header.names, ["t", "i [A]", "q"]);
        assert_eq!(header.units, [Some("s".to_owned()), Some("A".into()), Some("rad".into())]);
        let alone = Header::above(&["t [s];q (deg)", "0;1"], 1, 2, Separator::Char(';'));
        assert_eq!(alone.units, [Some("s".to_owned()), Some("deg".into())]);
        assert!(Header::above(&["a title"], 1, 3, Separator::Blanks).names.is_empty());
    }
}
