//! What `lissom validate` can be asked for.

use std::path::PathBuf;

use clap::Args;

use super::positive_time::positive_time;
use super::stdout_name::STDOUT;

/// RESULT is what `lissom identify CAMPAIGN --json RESULT` wrote; LOG is a run that is not in CAMPAIGN.
#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(crate) struct ValidateArgs {
    /// The result.json
    pub(crate) result: PathBuf,
    /// A campaign.toml that describes the log, or with --like the log itself
    pub(crate) log: PathBuf,
    /// Read LOG as this campaign.toml reads its own logs
    #[arg(long, value_name = "CAMPAIGN")]
    pub(crate) like: Option<PathBuf>,
    /// Write what comes of it as JSON to FILE, or alone to standard output
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = STDOUT)]
    pub(crate) json: Option<PathBuf>,
    /// Draw torque, motion, residuals and correlations into DIR as SVG and PNG
    #[arg(long, value_name = "DIR")]
    pub(crate) plots: Option<PathBuf>,
    /// Length of the window that torque is averaged with, e.g. "20 ms"; that of the logs used when absent
    #[arg(long, value_name = "TIME", value_parser = positive_time, allow_hyphen_values = true)]
    pub(crate) window: Option<f64>,
    /// Predict motion over this time alone, e.g. "0.5 s"; whole runs and shorter ones when absent
    #[arg(long, value_name = "TIME", value_parser = positive_time, allow_hyphen_values = true)]
    pub(crate) horizon: Option<f64>,
}

const HELP: &str = "\
  lissom identify campaign.toml --json result.json
  lissom validate result.json run-09.csv --like campaign.toml --plots plots

Two predictions and their residuals:

  torque   from the logged motion: what the figures say it takes, beside what was commanded.
           No figure is better known than this is predicted.
  motion   from the logged command: the arm simulated, sticking and slipping, from one initial
           state for each stretch. Over whole runs an open motor drifts; see the shorter ones.
  left     residuals as large as the sensor's own noise and white: nothing is missing. Beyond
           that, the terms that the residual looks like say what is: a delay, friction, inertia.

docs/src/how-to/validate.md explains every figure. Exit code 3: the torque is not predicted.";
