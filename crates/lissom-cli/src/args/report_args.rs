//! Arguments of `lissom report`.

use std::path::PathBuf;

use clap::Args;

use super::stored_args::StoredArgs;

/// Writes the report page of a result that was stored before: the same page as `lissom identify --report`. Motion, torque
/// balance, cycles and residuals need logs, which the arm of the result predicts.
#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(crate) struct ReportArgs {
    #[command(flatten)]
    pub(crate) stored: StoredArgs,
    /// The page [default: the name of RESULT with the ending .html]
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
}

const HELP: &str = "\
Examples:
  lissom report result.json
  lissom report result.json campaign.toml --out report.html
  lissom report result.json run-09.csv --like campaign.toml --out run-09.html
The numbers on the page are those of RESULT. The logs may be others than those of the result, from
the same drive; the page then reports this.";
