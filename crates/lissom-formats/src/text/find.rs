//! Finds the table of numbers in a text: the first long block of rows with the same number of cells.

use super::cells::{Cell, Decimal, Separator};
use super::lines::{MANY_COLUMNS, header_lines, is_skipped};
use super::row::Row;
use super::table::Table;

/// A block of so many rows is a table; a shorter one only if there is no other.
const LONG: usize = 8;
/// Rows at the beginning of a block whose longest gives its width.
const FIRST_ROWS: usize = 100;

/// Finds the table below the first `skipped` lines, with a decimal comma or without one if that is stated.
pub(crate) fn find(text: &str, skipped: usize, decimal_comma: Option<bool>) -> Option<Table<'_>> {
    let separators = Separator::ALL.into_iter();
    let candidates = separators.flat_map(|s| s.decimals().map(|decimal| (s, decimal)));
    let (has_commas, has_quotes) = (text.contains(','), text.contains('"'));
    let is_possible = |(separator, decimal): &(Separator, Decimal)| {
        let is_stated = decimal_comma.is_none_or(|comma| comma == (*decimal == Decimal::Comma));
        // Between commas, a comma belongs to a number only in quotes.
        let has_its_commas = has_commas && (has_quotes || *separator != Separator::Char(','));
        is_stated && (*decimal == Decimal::Point || has_its_commas || decimal_comma == Some(true))
    };
    find_separated(text, skipped, candidates.filter(is_possible))
}

/// Finds the table in a text whose cells are separated by tabs.
#[cfg(feature = "xlsx")]
pub(crate) fn find_in_tabs(text: &str) -> Option<Table<'_>> {
    find_separated(text, 0, std::iter::once((Separator::Char('\t'), Decimal::Point)))
}

/// Finds the table with one of these separators and decimal signs: that with most values.
fn find_separated(
    text: &str,
    skipped: usize,
    candidates: impl Iterator<Item = (Separator, Decimal)>,
) -> Option<Table<'_>> {
    let lines: Vec<&str> = text.lines().collect();
    let ends_in_a_row = !text.ends_with(['\n', '\r']);
    let mut best: Option<(Separator, Decimal, Block)> = None;
    let mut most = (false, 0);
    let mut may_be_other = false;
    for (separator, decimal) in candidates {
        let Some(block) = block(&lines, skipped, separator, decimal) else { continue };
        let rank = (block.end - block.first >= LONG || block.width >= MANY_COLUMNS, block.values);
        let is_as_good = rank == most && decimal != Decimal::Point;
        may_be_other |= is_as_good
            && best.as_ref().is_some_and(|(s, d, _)| *s == separator && *d != Decimal::Point);
        if rank > most {
            most = rank;
            best = Some((separator, decimal, block));
            may_be_other = false;
        }
    }
    let (mut separator, decimal, mut found) = best?;
    // A comma before the fraction of a second makes one cell more than the header has.
    let stamped = Separator::CommaAfterStamp;
    if separator == Separator::Char(',')
        && cells_above(&lines, found.first, stamped) + 1 == found.width
        && let Some(other) = block(&lines, skipped, stamped, decimal)
        && (other.first, other.end, other.width + 1) == (found.first, found.end, found.width)
    {
        (separator, found) = (stamped, other);
    }
    let Block { first, end, width, .. } = found;
    let header = header_lines(&lines, first);
    Some(Table {
        lines,
        header,
        separator,
        decimal,
        may_be_other,
        first,
        end,
        width,
        ends_in_a_row,
    })
}

/// Number of cells of the line above a table.
fn cells_above(lines: &[&str], first: usize, separator: Separator) -> usize {
    let above = lines[..first].iter().rev().find(|line| !line.trim().is_empty());
    above.map_or(0, |line| separator.cells(line).count())
}

/// A block of rows of numbers.
struct Block {
    first: usize,
    end: usize,
    width: usize,
    /// Cells with values, less those with words.
    values: usize,
}

impl Block {
    /// Takes the rows directly above whose cells are numbers in the columns in which the first row has numbers: in other
    /// columns some oscilloscopes state their settings.
    fn take_rows_above(
        &mut self,
        lines: &[&str],
        skipped: usize,
        separator: Separator,
        decimal: Decimal,
    ) {
        let values = |line: &str| -> Vec<bool> {
            let is_value = |cell| Cell::of(cell, decimal).is_value();
            separator.cells(line).map(is_value).collect()
        };
        let columns = values(lines[self.first]);
        let fits = |line: &str| {
            let cells = values(line);
            columns.iter().enumerate().all(|(k, filled)| !filled || cells.get(k) == Some(&true))
        };
        while self.first > skipped && fits(lines[self.first - 1]) {
            self.first -= 1;
        }
    }
}

/// The first long block of rows of numbers, else the longest.
fn block(lines: &[&str], skipped: usize, separator: Separator, decimal: Decimal) -> Option<Block> {
    let mut best: Option<Block> = None;
    let mut at = skipped;
    while at < lines.len() {
        let is_one_cell = || separator.cells(lines[at]).nth(1).is_none();
        if is_one_cell() || Row::of(lines[at], separator, decimal).is_none_or(|row| row.width < 2) {
            at += 1;
            continue;
        }
        let mut block = Block { first: at, end: at, width: 0, values: 0 };
        let header = header_lines(lines, at);
        while let Some(line) = lines.get(block.end) {
            if !is_skipped(line) && !header.contains(&line.trim()) {
                let Some(row) = Row::of(line, separator, decimal) else { break };
                let grows = block.end < block.first + FIRST_ROWS;
                if row.values_end > block.width && !grows {
                    break;
                }
                if grows {
                    block.width = block.width.max(row.width);
                }
                block.values += row.values;
            }
            block.end += 1;
        }
        block.take_rows_above(lines, skipped, separator, decimal);
        at = block.end;
        let is_long = block.end - block.first >= LONG;
        if best.as_ref().is_none_or(|b| block.end - block.first > b.end - b.first) {
            best = Some(block);
        }
        if is_long {
            break;
        }
    }
    best
}
