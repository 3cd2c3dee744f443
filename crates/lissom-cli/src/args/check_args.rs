//! Arguments of `lissom check`.

use std::path::PathBuf;

use clap::Args;

use super::log_args::LogArgs;
use super::stdout_name::STDOUT;

/// Identifies a log and compares its parameters with limits, with their uncertainty: for a test at the end of a line.
#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(crate) struct CheckArgs {
    /// The log
    pub(crate) log: PathBuf,
    /// The limits.toml
    #[arg(long, value_name = "FILE")]
    pub(crate) limits: PathBuf,
    /// Read LOG with the columns and units of this campaign.toml
    #[arg(long, value_name = "CAMPAIGN")]
    pub(crate) like: Option<PathBuf>,
    /// Leave out the output-error method
    #[arg(long)]
    pub(crate) quick: bool,
    /// Write the check as JSON to FILE (without FILE: print only JSON)
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = STDOUT)]
    pub(crate) json: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) said: LogArgs,
}

const HELP: &str = "\
Example:
  lissom check drive-17/0815.csv --limits limits.toml --like campaign.toml
limits.toml has tables [[limits]] with parameter (a key of result.json), min, max; and
path = \"{machine}/{time}.csv\" for what the path of a log says. Exit code 0: all 95 % intervals are
within their limits; 5: one is outside; 3: the log does not decide.";
