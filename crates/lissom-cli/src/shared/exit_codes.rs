//! Exit codes that several subcommands share.

/// The verdict refuses a figure asked for.
pub(crate) const REFUSED: u8 = 3;
