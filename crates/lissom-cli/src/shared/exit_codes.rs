//! Exit codes that several subcommands share.

/// The verdict refuses a figure asked for.
pub(crate) const REFUSED: u8 = 3;
/// Stopped by Ctrl-C or a time limit: what is printed and written is the best result so far.
pub(crate) const INTERRUPTED: u8 = 4;
/// Ended by a second Ctrl-C, with nothing written.
pub(crate) const KILLED: i32 = 130;
