//! The command `lissom`: parse, call the library, print.
//!
//! Exit codes: 0 done, 1 the input cannot be used, 2 wrong usage, 3 done but the verdict refuses a
//! figure asked for or a wish of a plan cannot be met.

mod cli;
mod demo;
mod equivalent;
mod failure;
mod figures;
mod friction_curve;
mod geometry;
mod identify;
mod model;
mod output;
mod page;
mod payload;
mod picture;
mod plan;
mod print;
mod progress;
mod reference;
mod report_figures;
mod rig;
mod validate;
mod verdict;

use std::process::ExitCode;

use clap::Parser as _;

fn main() -> ExitCode {
    let outcome = match cli::Cli::parse().command {
        cli::Command::Identify(args) => identify::run(&args),
        cli::Command::Validate(args) => validate::run(&args),
        cli::Command::Equivalent(args) => equivalent::run(&args),
        cli::Command::Payload(args) => payload::run(&args),
        cli::Command::Model(args) => model::run(&args),
        cli::Command::Plan(args) => plan::run(&args),
        cli::Command::Rig(args) => rig::run(&args),
        cli::Command::Figures(args) => report_figures::run(&args),
        cli::Command::Demo(args) => demo::run(&args),
    };
    match outcome {
        Ok(code) => code,
        Err(failure) => {
            print::failure(&failure);
            ExitCode::from(1)
        }
    }
}
