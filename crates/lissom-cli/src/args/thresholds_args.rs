//! What `lissom thresholds` can be asked for.

use std::path::PathBuf;

use clap::Args;

use super::stdout_name::STDOUT;

/// Each has a unit and a reason, and says where its value comes from: derived from theory or from
/// another number, measured on logs or simulated campaigns, or a convention.
#[derive(Debug, Args)]
pub(crate) struct ThresholdsArgs {
    /// Write the list as JSON to FILE, or alone to standard output
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = STDOUT)]
    pub(crate) json: Option<PathBuf>,
}
