//! What `lissom compare` can be asked for.

use std::path::PathBuf;

use clap::Args;

use super::stdout_name::STDOUT;

/// The parameters of two or more results side by side, with their differences to the first result: before and after
/// maintenance, or with another payload.
#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(crate) struct CompareArgs {
    /// Two or more files that `lissom identify CAMPAIGN --json RESULT` wrote
    #[arg(required = true, value_name = "RESULT")]
    pub(crate) results: Vec<PathBuf>,
    /// Write the comparison as JSON to FILE, or alone to standard output; after the results
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = STDOUT)]
    pub(crate) json: Option<PathBuf>,
}

const HELP: &str = "\
  lissom identify march/campaign.toml --json march.json
  lissom identify april/campaign.toml --json april.json
  lissom compare march.json april.json

Each value has its standard error. A difference is given in percent of the first value, and in standard
errors of the difference (s.e.), the root of the sum of both squared standard errors: the results must be
of different logs. A difference of more than 3 standard errors is called clear. Parameters that a warning
of a result affects are marked: their standard errors may be too small.
docs/src/how-to/compare.md explains the table. Exit code 0, whether the results differ or not.";
