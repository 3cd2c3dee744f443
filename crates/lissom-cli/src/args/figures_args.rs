//! Arguments of `lissom figures`.

use std::path::PathBuf;

use clap::Args;

use super::stdout_name::STDOUT;

/// Figures 6 and 7 are the responses of motor and beam (theory, as measured, corrected, fitted). Figure 8 compares
/// friction from constant velocities with friction from sines. Friction of the simulated joint grows less than in
/// proportion to speed, so its value extrapolated from high speed to rest is too high.
#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(crate) struct FiguresArgs {
    /// Folder for the plots and the logs
    #[arg(long, value_name = "DIR", default_value = "lissom-figures")]
    pub(crate) out: PathBuf,
    /// Write Coulomb friction as JSON to FILE (without FILE: print only JSON)
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = STDOUT)]
    pub(crate) json: Option<PathBuf>,
}

const HELP: &str = "\
Example:
  lissom figures --out figures --json coulomb.json
Figures 6 and 7 are frequency responses of motor and beam: theory, measured, corrected, fitted.
Figure 8 compares friction from constant velocities with friction from sines.";
