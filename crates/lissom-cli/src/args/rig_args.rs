//! What `lissom rig` can be asked for.

use std::path::PathBuf;

use clap::Args;

use super::stdout_name::STDOUT;

/// The logs come with a campaign.toml that `lissom identify` reads. An interrupted campaign goes on
/// where it stopped; the same ARM and PLAN give the same bytes on any number of threads.
#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(crate) struct RigArgs {
    /// The arm.toml, with [drive] and [rig]
    pub(crate) arm: PathBuf,
    /// The plan.toml: the experiments
    #[arg(long, value_name = "PLAN")]
    pub(crate) campaign: PathBuf,
    /// Folder for the logs, campaign.toml and rig.json
    #[arg(long, value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// Runs at a time; all processors when absent
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) jobs: Option<u16>,
    /// Write what rig.json holds to FILE too, or alone to standard output
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = STDOUT)]
    pub(crate) json: Option<PathBuf>,
}

const HELP: &str = "\
A plan.toml:

  settle = \"detected\"              # or a time, \"none\"
  [[runs]]
  sine = { frequency = [\"0.2 Hz\", \"0.6 Hz\"], amplitude = [\"0.5 rad\", \"1 rad\"] }
  periods = 12
  [[runs]]
  multisine = { frequency = \"0.1 Hz\", to = \"5 Hz\", amplitude = \"0.5 rad\" }
  periods = 4
  [[runs]]
  velocity = [\"0.2 rad/s\", \"0.5 rad/s\", \"-0.2 rad/s\", \"-0.5 rad/s\"]
  record = \"5 s\"

Also square, chirp, table (from a file) and release. Lists stand for each with each.
docs/src/reference/plan.md explains every key, docs/src/reference/arm.md the arm, its instruments and the world at its tip.";
