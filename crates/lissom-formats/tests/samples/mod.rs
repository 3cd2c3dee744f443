//! The small files that the tests keep, and what they contain.

use std::path::Path;

use lissom_formats::{LogData, read};

/// A file of `tests/files`, read.
pub(crate) fn sample(name: &str) -> LogData {
    read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files").join(name)).unwrap()
}

/// Names of its channels.
pub(crate) fn names(data: &LogData) -> Vec<&str> {
    data.channels.iter().map(|c| c.name.as_str()).collect()
}
