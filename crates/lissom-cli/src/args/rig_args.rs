//! Arguments of `lissom rig`.

use std::path::PathBuf;

use clap::Args;

use super::stdout_name::STDOUT;

/// Writes logs, and a campaign.toml for `lissom identify`. An interrupted campaign continues where it stopped. The same
/// arm.toml and plan.toml give the same bytes on any number of threads.
#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(crate) struct RigArgs {
    /// The arm.toml with [drive] and [rig]
    pub(crate) arm: PathBuf,
    /// The plan.toml, which lists the experiments
    #[arg(long, value_name = "PLAN")]
    pub(crate) campaign: PathBuf,
    /// Folder for logs, campaign.toml, rig.json; an interrupted campaign continues
    #[arg(long, value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// Runs at the same time [default: one for each processor]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) jobs: Option<u16>,
    /// Write the contents of rig.json also to FILE (without FILE: print only JSON)
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = STDOUT)]
    pub(crate) json: Option<PathBuf>,
}

const HELP: &str = "\
Example:
  lissom rig arm.toml --campaign plan.toml --out virtual
A plan.toml with four sines (each frequency with each amplitude) and a multisine:
  [[runs]]
  sine = { frequency = [\"0.2 Hz\", \"0.6 Hz\"], amplitude = [\"0.5 rad\", \"1 rad\"] }
  periods = 12
  [[runs]]
  multisine = { frequency = \"0.1 Hz\", to = \"5 Hz\", amplitude = \"0.5 rad\" }
  periods = 4
Other motions: velocity, square, chirp, table, release. The book explains every key of both files.";
