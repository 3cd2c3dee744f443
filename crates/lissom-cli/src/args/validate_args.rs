//! Arguments of `lissom validate`.

use std::path::PathBuf;

use clap::Args;

use super::positive_time::positive_time;
use super::stdout_name::STDOUT;

/// Takes a result of `lissom identify` and a log of the same drive that was not used for this result.
#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(crate) struct ValidateArgs {
    /// The result.json of `lissom identify CAMPAIGN --json result.json`
    pub(crate) result: PathBuf,
    /// A campaign.toml that describes the log; with --like the log itself
    pub(crate) log: PathBuf,
    /// Read LOG with the columns and units of this campaign.toml
    #[arg(long, value_name = "CAMPAIGN")]
    pub(crate) like: Option<PathBuf>,
    /// Write the validation as JSON to FILE (without FILE: print only JSON)
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = STDOUT)]
    pub(crate) json: Option<PathBuf>,
    /// Write plots of torque, motion and residuals into DIR as SVG and PNG
    #[arg(long, value_name = "DIR")]
    pub(crate) plots: Option<PathBuf>,
    /// Averaging window of the torque, e.g. "20 ms" [default: as in RESULT]
    #[arg(long, value_name = "TIME", value_parser = positive_time, allow_hyphen_values = true)]
    pub(crate) window: Option<f64>,
    /// Predict the motion over this time only, e.g. "0.5 s" [default: several]
    #[arg(long, value_name = "TIME", value_parser = positive_time, allow_hyphen_values = true)]
    pub(crate) horizon: Option<f64>,
}

const HELP: &str = "\
Examples:
  lissom validate result.json run-09.csv --like campaign.toml --plots plots
  lissom validate result.json other/campaign.toml --json validation.json
The torque is predicted from the logged motion, the motion from the logged command by simulation.
A white residual as small as the sensor's noise: nothing is missing. A larger one: the output lists
the terms that it resembles, such as a delay, friction or inertia. The motion of an open loop drifts
over whole runs; look at shorter horizons. The exit code is 3 if the torque cannot be predicted.";
