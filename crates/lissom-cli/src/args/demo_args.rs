//! What `lissom demo` can be asked for.

use std::path::PathBuf;

use clap::Args;

use super::stdout_name::STDOUT;

/// The single-mass arm of the report: PD loop, 3 ms, 12 bits, 4.12 A, stepped sines at
/// frequencies and their triples, two amplitudes.
#[derive(Debug, Args)]
pub(crate) struct DemoArgs {
    /// Folder for the logs, the campaign, the result and the plots
    #[arg(long, value_name = "DIR", default_value = "lissom-demo")]
    pub(crate) out: PathBuf,
    /// Write truth and result as JSON to FILE, or alone to standard output
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = STDOUT)]
    pub(crate) json: Option<PathBuf>,
}
