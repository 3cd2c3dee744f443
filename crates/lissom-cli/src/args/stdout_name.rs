//! The name of standard output as a file argument.

/// The file name that stands for standard output.
pub(crate) const STDOUT: &str = "-";
