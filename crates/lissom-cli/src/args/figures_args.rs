//! What `lissom figures` can be asked for.

use std::path::PathBuf;

use clap::Args;

use super::stdout_name::STDOUT;

/// Motor and beam by stepped sines (theory, as measured, corrected, fitted), and friction by steady
/// velocities beside friction by sines, on a joint whose friction grows less than in proportion with
/// speed: extrapolated from high speed to rest it comes out too high.
#[derive(Debug, Args)]
pub(crate) struct FiguresArgs {
    /// Folder for the figures and their logs
    #[arg(long, value_name = "DIR", default_value = "lissom-figures")]
    pub(crate) out: PathBuf,
    /// Write the friction figures as JSON to FILE, or alone to standard output
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = STDOUT)]
    pub(crate) json: Option<PathBuf>,
}
