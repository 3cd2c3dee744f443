//! A stored result, with or without logs.

use std::path::PathBuf;

use clap::Args;

/// A stored result, and logs that its arm predicts.
#[derive(Debug, Args)]
pub(crate) struct StoredArgs {
    /// The result.json of `lissom identify CAMPAIGN --json result.json`
    pub(crate) result: PathBuf,
    /// A campaign.toml that describes logs; with --like the logs themselves
    #[arg(value_name = "LOG")]
    pub(crate) logs: Vec<PathBuf>,
    /// Read LOG with the columns and units of this campaign.toml
    #[arg(long, value_name = "CAMPAIGN", requires = "logs")]
    pub(crate) like: Option<PathBuf>,
}
