//! Arguments of `lissom inspect`.

use std::path::PathBuf;

use clap::Args;

use super::log_args::row;
use super::stdout_name::STDOUT;

/// Shows what is in a log of any supported format: channels, units, clock, and which channel is probably what.
#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(crate) struct InspectArgs {
    /// Logs: text, JSON and others, recognised by their content
    #[arg(required = true, value_name = "LOG")]
    pub(crate) logs: Vec<PathBuf>,
    /// Row of a text with the names, from 1 [default: found]
    #[arg(long, value_name = "ROW", value_parser = row)]
    pub(crate) header_row: Option<usize>,
    /// Rows at the top of a text that do not count
    #[arg(long, value_name = "ROWS", default_value_t = 0, hide_default_value = true)]
    pub(crate) skip_rows: usize,
    /// Write what was found as JSON to FILE (without FILE: print only JSON)
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = STDOUT)]
    pub(crate) json: Option<PathBuf>,
    /// Write a plot of each channel into DIR as SVG and PNG
    #[arg(long, value_name = "DIR")]
    pub(crate) plots: Option<PathBuf>,
}

const HELP: &str = "\
Examples:
  lissom inspect log.csv
  lissom inspect logs/*.csv --json channels.json
Units are those that the file states. A role (time, current, motor) is a guess from units and names,
with its reason. Next: `lissom identify LOG`, or `lissom init LOG` to write a campaign.toml.";
