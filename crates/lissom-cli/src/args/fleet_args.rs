//! Arguments of `lissom fleet`.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::{Args, Subcommand};

use super::identify_args::EffortArg;
use super::positive_time::positive_time;
use super::stdout_name::STDOUT;

/// Identifies the logs of many machines, each by itself, in worker processes, and writes a row for each log. A run that was
/// stopped goes on where it was.
#[derive(Debug, Args)]
#[command(after_help = HELP, args_conflicts_with_subcommands = true)]
pub(crate) struct FleetArgs {
    #[command(subcommand)]
    pub(crate) command: Option<FleetCommand>,
    #[command(flatten)]
    pub(crate) run: FleetRunArgs,
}

#[derive(Debug, Subcommand)]
pub(crate) enum FleetCommand {
    /// Show the distribution of each parameter, logs and machines that differ, and drift
    Summary(FleetSummaryArgs),
    /// Write the rows as one table, CSV or Parquet
    Table(FleetTableArgs),
    /// Identify the logs that standard input names (for `lissom fleet` itself)
    #[command(hide = true)]
    Worker,
}

#[derive(Debug, Args)]
pub(crate) struct FleetRunArgs {
    /// Logs, and folders with logs
    pub(crate) logs: Vec<PathBuf>,
    /// The campaign.toml that describes every log; its runs are read only with --by-folder
    #[arg(long, value_name = "CAMPAIGN")]
    pub(crate) like: Option<PathBuf>,
    /// Write rows into DIR
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Logs from a CSV with columns log, machine, time
    #[arg(long, value_name = "FILE", conflicts_with = "logs")]
    pub(crate) table: Option<PathBuf>,
    /// Machine and time from the end of the path, e.g. "{machine}/{time}.csv"
    #[arg(long, value_name = "PATTERN")]
    pub(crate) pattern: Option<String>,
    /// A folder with the files of the campaign's runs is one log
    #[arg(long)]
    pub(crate) by_folder: bool,
    /// Worker processes at a time [default: cores of this machine]
    #[arg(long, value_name = "NUMBER")]
    pub(crate) workers: Option<NonZeroUsize>,
    /// Effort for every log
    #[arg(long, value_name = "EFFORT", default_value = "quick", hide_possible_values = true)]
    pub(crate) effort: EffortArg,
    /// Effort for logs whose findings ask for it; "none" for no log
    #[arg(long, value_name = "EFFORT", default_value = "normal", value_parser = ["none", "normal", "thorough"], hide_possible_values = true)]
    pub(crate) refine: String,
    /// Finding that asks for it, repeatable [default: every refusal, and angle-lag]
    #[arg(long, value_name = "CODE")]
    pub(crate) refine_on: Vec<String>,
    /// Time for a log; its process is then ended
    #[arg(long, value_name = "TIME", default_value = "60 s", value_parser = positive_time, allow_hyphen_values = true)]
    pub(crate) time_limit: f64,
    /// How often a log is tried again whose process ended
    #[arg(long, value_name = "NUMBER", default_value_t = 2)]
    pub(crate) retries: u32,
    /// Keep the whole result.json of each log in its row
    #[arg(long)]
    pub(crate) results: bool,
    /// Fail if DIR has rows already
    #[arg(long, conflicts_with = "again")]
    pub(crate) new: bool,
    /// Do logs again that failed so: missing, input, time_limit, process_ended, internal; repeatable
    #[arg(long, value_name = "FAILURE", value_parser = ["missing", "input", "time_limit", "process_ended", "internal"], hide_possible_values = true)]
    pub(crate) again: Vec<String>,
}

#[derive(Debug, Args)]
#[command(after_help = SUMMARY_HELP)]
pub(crate) struct FleetSummaryArgs {
    /// The folder into which `lissom fleet` wrote
    pub(crate) folder: PathBuf,
    /// Write the summary as JSON to FILE (without FILE: print only JSON)
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = STDOUT)]
    pub(crate) json: Option<PathBuf>,
    /// Write a self-contained HTML page
    #[arg(long, value_name = "FILE")]
    pub(crate) report: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct FleetTableArgs {
    /// The folder into which `lissom fleet` wrote
    pub(crate) folder: PathBuf,
    /// Write the table to FILE: Parquet if it ends in .parquet, and else CSV
    #[arg(long, value_name = "FILE")]
    pub(crate) out: PathBuf,
}

const HELP: &str = "\
Examples:
  lissom fleet logs --like campaign.toml --out fleet --pattern \"{machine}/{time}.csv\"
  lissom fleet --table logs.csv --like campaign.toml --out fleet
  lissom fleet logs --like campaign.toml --out fleet --by-folder --pattern \"{machine}/{time}\"
  lissom fleet summary fleet --report page.html
Each log is identified quickly; where an estimate is refused or the angle lags, again with --refine EFFORT.
What is wrong with one log is in its row. Rows are in Parquet files, which manifest.json lists.";

const SUMMARY_HELP: &str = "\
Example:
  lissom fleet summary fleet --report page.html
Machines and times come from --pattern or --table of `lissom fleet`. See the page Fleets of the book.";
