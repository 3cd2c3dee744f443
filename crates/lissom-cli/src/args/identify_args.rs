//! Arguments of `lissom identify`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use lissom::identify::Effort;

use super::positive_time::positive_time;
use super::stdout_name::STDOUT;

/// Reads the logs that a campaign.toml describes: their columns and units, and what is known about the drive.
#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(crate) struct IdentifyArgs {
    /// The campaign.toml, which describes the logs
    pub(crate) campaign: PathBuf,
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
  lissom identify campaign.toml --quick --json result.json
A campaign.toml names the columns of your logs, their units and the log files. `lissom demo` writes
one to start from; the page campaign.toml in the book explains every key. A current that a sensor
measured needs hold = \"measured\"; a current that the controller asked for, hold = \"sampled\".
Ctrl-C ends the search with the best result so far.";
