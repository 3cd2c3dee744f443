//! Arguments of `lissom studio`.

use std::path::PathBuf;

use clap::Args;

/// Serves a page for your browser, on this machine only: logs, their channels, identification with progress, results,
/// comparison, models for other programs. Nothing leaves the machine. Ctrl-C ends it; the state is kept.
#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(crate) struct StudioArgs {
    /// Logs, or a campaign.toml, read where they are
    #[arg(value_name = "CAMPAIGN|LOG")]
    pub(crate) logs: Vec<PathBuf>,
    /// Folder of the state [default: one for these logs]
    #[arg(long, value_name = "DIR")]
    pub(crate) folder: Option<PathBuf>,
    /// Port [default: a free one]
    #[arg(long, value_name = "PORT", value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) port: Option<u16>,
    /// Do not open the browser; print the address
    #[arg(long)]
    pub(crate) no_browser: bool,
}

const HELP: &str = "\
Examples:
  lissom studio
  lissom studio log.csv
  lissom studio campaign.toml --port 8123 --no-browser
On another machine: ssh -L 8123:localhost:8123 HOST lissom studio --port 8123 --no-browser
The address that is printed opens one page. The file `open.html` in the folder of the state opens
further ones; only you can read it.";
