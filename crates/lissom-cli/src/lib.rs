//! The command `lissom`: parse, call the library, print. The program and the Python package call [`run`].
//!
//! Exit codes: 0 done, 1 the input cannot be used, 2 wrong usage, 3 done but a parameter
//! asked for is refused or a wish of a plan cannot be met, 5 a
//! parameter is outside its limits, 4 stopped by Ctrl-C or a time limit, with the best result so far
//! (130 after a second Ctrl-C, without one).

mod args;
mod commands;
mod shared;
mod tasks;
mod views;

use std::ffi::OsString;

use clap::Parser as _;

use crate::args::command_line::{Cli, Command};
#[cfg(feature = "fleet")]
use crate::commands::fleet_command;
#[cfg(feature = "studio")]
use crate::commands::studio_command;
use crate::commands::{
    check_command, compare_command, completions_command, demo, equivalent, export_command,
    identify_command, init_command, inspect_command, man_command, model_command, payload_command,
    plan, plot_command, report_command, report_figures, rig, thresholds_command, validate_command,
};
use crate::shared::exit_codes::ExitCode;
use crate::views::printer;

/// Runs the command with its arguments, of which the first is the name of the program. `own` starts this command in a
/// process of its own: a program, and its arguments before those of the command. Returns the exit code; ends the program
/// if the arguments are wrong, if they ask for help, and after a second Ctrl-C.
pub fn run(arguments: impl IntoIterator<Item = OsString>, own: &[OsString]) -> u8 {
    #[cfg(not(feature = "fleet"))]
    let _ = own;
    let outcome = match Cli::parse_from(arguments).command {
        Command::Inspect(args) => inspect_command::run(&args),
        Command::Init(args) => init_command::run(&args),
        Command::Identify(args) => identify_command::run(&args),
        #[cfg(feature = "studio")]
        Command::Studio(args) => studio_command::run(&args),
        Command::Validate(args) => validate_command::run(&args),
        Command::Check(args) => check_command::run(&args),
        #[cfg(feature = "fleet")]
        Command::Fleet(args) => fleet_command::run(&args, own),
        Command::Plot(args) => plot_command::run(&args),
        Command::Report(args) => report_command::run(&args),
        Command::Compare(args) => compare_command::run(&args),
        Command::Export(args) => export_command::run(&args),
        Command::Equivalent(args) => equivalent::run(&args),
        Command::Payload(args) => payload_command::run(&args),
        Command::Model(args) => model_command::run(&args),
        Command::Plan(args) => plan::run(&args),
        Command::Rig(args) => rig::run(&args),
        Command::Thresholds(args) => thresholds_command::run(&args),
        Command::Figures(args) => report_figures::run(&args),
        Command::Completions(args) => Ok(completions_command::run(&args)),
        Command::Man(args) => man_command::run(&args),
        Command::Demo(args) => demo::run(&args),
    };
    let code = outcome.unwrap_or_else(|failure| {
        printer::failure(&failure);
        ExitCode::FAILURE
    });
    code.number()
}
