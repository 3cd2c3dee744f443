//! What `lissom identify` can be asked for.

use std::path::PathBuf;

use clap::Args;

use super::positive_time::positive_time;
use super::stdout_name::STDOUT;

/// The logs are described by a campaign.toml: columns, units, what is known of the drive.
#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(crate) struct IdentifyArgs {
    /// The campaign.toml
    pub(crate) campaign: PathBuf,
    /// Write the result as JSON to FILE, or alone to standard output
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = STDOUT)]
    pub(crate) json: Option<PathBuf>,
    /// Write one self-contained HTML page
    #[arg(long, value_name = "FILE")]
    pub(crate) report: Option<PathBuf>,
    /// Draw the Bode plots into DIR as SVG and PNG
    #[arg(long, value_name = "DIR")]
    pub(crate) plots: Option<PathBuf>,
    /// Length of the regression's window, e.g. "0.3 s"; chosen from the data when absent
    #[arg(long, value_name = "TIME", value_parser = positive_time, allow_hyphen_values = true)]
    pub(crate) window: Option<f64>,
    /// Closed forms only: do not replay the runs through the arm
    #[arg(long)]
    pub(crate) quick: bool,
}

const HELP: &str = "\
A campaign.toml:

  [signals]
  time    = { column = \"t\", unit = \"s\" }
  current = { column = \"i\", unit = \"A\", hold = \"sampled\" }  # or \"measured\"
  motor   = { column = \"theta_m\", unit = \"rad\" }
  tips    = [{ name = \"tip\", column = \"theta_t\", unit = \"rad\" }]
  [drive]
  torque_constant = \"2.184 lbf*in/A\"
  [[runs]]
  file = \"run-01.csv\"

Columns go by name or number. hold = \"sampled\" is a commanded value held between samples,
\"measured\" one that was measured. A command of unknown unit has unit = \"1\": estimates are then
per unit of command. A torque has unit = \"N*m\". With quantity = \"goal\" the command is the position
goal of a servo, with quantity = \"speed\" the motor's channel is its speed. docs/campaign.md explains
every key.";
