//! Arguments of `lissom init`.

use std::path::PathBuf;

use clap::Args;

use super::log_args::LogArgs;

/// Writes a campaign.toml for logs, with comments, and says which command to run next. It never overwrites a file.
#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(crate) struct InitArgs {
    /// Logs of one drive with the same columns
    #[arg(required = true, value_name = "LOG")]
    pub(crate) logs: Vec<PathBuf>,
    /// File to write
    #[arg(long, value_name = "FILE", default_value = "campaign.toml")]
    pub(crate) out: PathBuf,
    #[command(flatten)]
    pub(crate) said: LogArgs,
}

const HELP: &str = "\
Examples:
  lissom init log.csv
  lissom init logs/*.csv --motor q:deg --torque-constant \"0.1 N*m/A\" --out campaign.toml
What the log does not show stands in the file as TO DO, with what to write.";
