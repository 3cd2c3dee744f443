//! How a file argument names standard output.

/// The file name that stands for standard output.
pub(crate) const STDOUT: &str = "-";
