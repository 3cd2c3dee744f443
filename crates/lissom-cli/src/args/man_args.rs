//! Arguments of `lissom man`.

use std::path::PathBuf;

use clap::Args;

/// Writes the manual pages: lissom.1 and one for each subcommand.
#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(crate) struct ManArgs {
    /// Folder for the pages
    #[arg(value_name = "DIR")]
    pub(crate) folder: PathBuf,
}

const HELP: &str = "\
Example:
  lissom man ~/.local/share/man/man1
  man lissom-identify";
