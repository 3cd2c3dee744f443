//! Arguments of `lissom thresholds`.

use std::path::PathBuf;

use clap::Args;

use super::stdout_name::STDOUT;

/// Lists each threshold with its unit, its reason and its origin: derived from theory or from another number, measured
/// on logs or simulated campaigns, or a convention.
#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(crate) struct ThresholdsArgs {
    /// Write the list as JSON to FILE (without FILE: print only JSON)
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = STDOUT)]
    pub(crate) json: Option<PathBuf>,
}

const HELP: &str = "\
Example:
  lissom thresholds --json thresholds.json
Each threshold has its unit, its reason and its origin: derived from theory or from another number,
measured on logs or simulated campaigns, or a convention.";
