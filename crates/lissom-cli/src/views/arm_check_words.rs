//! Comparison of the identified arm with an arm.toml, in words.

use lissom_io::result::GeometryEntry;
use lissom_views::arm_check::lines;

use super::printer;

/// Prints the comparison.
pub(crate) fn print(check: Option<&GeometryEntry>) {
    let Some(check) = check else { return };
    printer::line("");
    for line in lines(check) {
        printer::line(&line);
    }
}
