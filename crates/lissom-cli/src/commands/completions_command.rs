//! `lissom completions SHELL`.

use clap::CommandFactory as _;

use crate::args::command_line::Cli;
use crate::args::completions_args::CompletionsArgs;
use crate::shared::exit_codes::ExitCode;
use crate::views::printer;

pub(crate) fn run(args: &CompletionsArgs) -> ExitCode {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "lissom", &mut script);
    printer::line(String::from_utf8_lossy(&script).trim_end());
    ExitCode::SUCCESS
}
