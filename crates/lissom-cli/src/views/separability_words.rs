//! The verdict: which parameters the logs identify, in words.

use lissom::identify::Identified;
use lissom::record::Axis;

use super::printer::line;

/// Prints the verdict in words.
pub(crate) fn print(axis: Axis, id: &Identified) {
    let words = id.separability.as_ref().map_or(Vec::new(), |found| found.words(axis));
    if words.is_empty() {
        return;
    }
    line("\nverdict: what the logs identify");
    for text in words {
        line(&format!("  {text}"));
    }
}
