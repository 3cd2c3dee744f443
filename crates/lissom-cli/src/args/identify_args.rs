//! Arguments of `lissom identify`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use lissom::identify::Effort;

use super::log_args::LogArgs;
use super::positive_time::positive_time;
use super::stdout_name::STDOUT;

/// Reads the logs that a campaign.toml describes, or logs by themselves. What no option says about a log is taken from
/// it where it is unambiguous; a unit must be stated by the log or by an option.
#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(crate) struct IdentifyArgs {
    /// A campaign.toml, which describes the logs; or logs
    #[arg(required = true, value_name = "CAMPAIGN|LOG")]
    pub(crate) input: Vec<PathBuf>,
    /// Write the result as JSON to FILE (without FILE: print only JSON)
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = STDOUT)]
    pub(crate) json: Option<PathBuf>,
    /// Write a self-contained HTML page
    #[arg(long, value_name = "FILE")]
    pub(crate) report: Option<PathBuf>,
    /// Write the plots into DIR as SVG and PNG
    #[arg(long, value_name = "DIR")]
    pub(crate) plots: Option<PathBuf>,
    /// Window length of the regression, e.g. "0.3 s" [default: from the data]
    #[arg(long, value_name = "TIME", value_parser = positive_time, allow_hyphen_values = true)]
    pub(crate) window: Option<f64>,
    /// Simulated fit: quick (none), normal (10 s), thorough
    #[arg(long, value_name = "EFFORT", default_value = "normal", hide_possible_values = true)]
    pub(crate) effort: EffortArg,
    /// The same as --effort quick
    #[arg(long, conflicts_with = "effort")]
    pub(crate) quick: bool,
    /// Stop after TIME, e.g. "5 s", with the best result so far
    #[arg(long, value_name = "TIME", value_parser = positive_time, allow_hyphen_values = true)]
    pub(crate) time_limit: Option<f64>,
    #[command(flatten)]
    pub(crate) said: LogArgs,
}

/// How far the output-error method refines the estimates.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum EffortArg {
    Quick,
    Normal,
    Thorough,
}

impl IdentifyArgs {
    /// The search effort that the options ask for.
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
Examples:
  lissom identify campaign.toml --report report.html
  lissom identify log.csv --current i:A --motor q:deg --torque-constant \"0.1 N*m/A\"
  lissom identify log.csv --motor counts:rad,scale=0.001534 --tip alpha:deg
A campaign.toml names the columns of your logs, their units and the log files; `lissom init` writes
one. COLUMN is a name or a number from 1; after it come keys of campaign.toml, as in scale=0.01.
Ctrl-C ends the search with the best result so far.";
