//! Exit codes that several subcommands share.

/// Done, but a requested parameter could not be identified, or the torque of a log could not be predicted.
pub(crate) const REFUSED: u8 = 3;
/// Stopped by Ctrl-C or a time limit; the output is the best result so far.
pub(crate) const INTERRUPTED: u8 = 4;
/// A parameter is outside its limits.
pub(crate) const OUTSIDE: u8 = 5;
/// Stopped by a second Ctrl-C, without a result.
pub(crate) const KILLED: i32 = 130;
