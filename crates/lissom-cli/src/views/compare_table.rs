//! The table of `lissom compare`: results side by side.

use lissom_io::ComparedFile;
use lissom_views::compare_words::{results, rows, sentences};

use super::printer::{line, table, wrapped};

/// Width of sentences.
const WIDTH: usize = 100;
/// Indent of the lines after the first one of a sentence.
const INDENT: &str = "  ";

/// Prints the names of the results, the table of their parameters, and the differences in words.
pub(crate) fn comparison(found: &ComparedFile) {
    for result in results(found) {
        line(&result);
    }
    line("");
    table(&rows(found));
    line("");
    for text in sentences(found) {
        sentence(&text);
    }
}

fn sentence(text: &str) {
    // Keeps a number and its percent sign on one line.
    let bound = text.replace(" %", "\0%");
    for (k, part) in wrapped(&bound, WIDTH).iter().enumerate() {
        line(&format!("{}{}", if k == 0 { "" } else { INDENT }, part.replace('\0', " ")));
    }
}
