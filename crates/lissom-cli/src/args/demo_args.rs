//! Arguments of `lissom demo`.

use std::path::PathBuf;

use clap::Args;

use super::stdout_name::STDOUT;

/// Simulates the arm with one mass of the 1989 report: PD loop with a sample time of 3 ms, sensors of 12 bits, a
/// current limit of 4.12 A, sines at frequencies ω0 and 3·ω0 with two amplitudes.
#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(crate) struct DemoArgs {
    /// Folder for the logs, the result and the plots
    #[arg(long, value_name = "DIR", default_value = "lissom-demo")]
    pub(crate) out: PathBuf,
    /// Write truth and result as JSON to FILE (without FILE: print only JSON)
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = STDOUT)]
    pub(crate) json: Option<PathBuf>,
}

const HELP: &str = "\
Examples:
  lissom demo
  lissom identify lissom-demo/campaign.toml --report report.html
The folder has files to start from: arm.toml of the simulated arm, the logs and their campaign.toml,
result.json, report.html and Bode plots.";
