//! Arguments of `lissom compare`.

use std::path::PathBuf;

use clap::Args;

use super::stdout_name::STDOUT;

/// Compares two or more results with the first of them, for example before and after maintenance or with another
/// payload.
#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(crate) struct CompareArgs {
    /// Two or more files that `lissom identify CAMPAIGN --json RESULT` wrote
    #[arg(required = true, value_name = "RESULT")]
    pub(crate) results: Vec<PathBuf>,
    /// Write JSON to FILE (without FILE: print only JSON); put it last
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = STDOUT)]
    pub(crate) json: Option<PathBuf>,
    /// Write a self-contained HTML page with the intervals side by side
    #[arg(long, value_name = "FILE")]
    pub(crate) report: Option<PathBuf>,
}

const HELP: &str = "\
Examples:
  lissom identify march/campaign.toml --json march.json
  lissom identify april/campaign.toml --json april.json
  lissom compare march.json april.json --report comparison.html

Each result is compared with the first. A difference is given in percent and in standard errors of
the difference (s.e.); above 3 s.e. it is called clear. The results must come from different logs.
A parameter that a warning affects is marked: its standard error may be too small. The exit code is
0 whether or not the results differ.";
