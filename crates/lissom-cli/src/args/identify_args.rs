//! What `lissom identify` can be asked for.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use lissom::identify::Effort;

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
    /// How far to refine: quick (not at all), normal (some 10 s), thorough
    #[arg(long, value_name = "EFFORT", default_value = "normal", hide_possible_values = true)]
    pub(crate) effort: EffortArg,
    /// The same as --effort quick
    #[arg(long, conflicts_with = "effort")]
    pub(crate) quick: bool,
    /// Take the best result after TIME, e.g. "5 s"; it then depends on the machine's speed
    #[arg(long, value_name = "TIME", value_parser = positive_time, allow_hyphen_values = true)]
    pub(crate) time_limit: Option<f64>,
}

/// How far the output-error method refines the estimates.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum EffortArg {
    Quick,
    Normal,
    Thorough,
}

impl IdentifyArgs {
    /// The effort asked for.
    pub(crate) fn effort(&self) -> Effort {
        match self.effort {
            EffortArg::Normal if self.quick => Effort::Quick,
            EffortArg::Quick => Effort::Quick,
            EffortArg::Normal => Effort::Normal,
            EffortArg::Thorough => Effort::Thorough,
        }
    }
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
goal of a servo, with quantity = \"speed\" the motor's channel is its speed. docs/src/reference/campaign.md explains
every key.";
