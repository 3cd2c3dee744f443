//! What the user can ask for.

use clap::{Parser, Subcommand};

use super::compare_args::CompareArgs;
use super::completions_args::CompletionsArgs;
use super::demo_args::DemoArgs;
use super::equivalent_args::EquivalentArgs;
use super::figures_args::FiguresArgs;
use super::identify_args::IdentifyArgs;
use super::man_args::ManArgs;
use super::model_args::ModelArgs;
use super::payload_args::PayloadArgs;
use super::plan_args::PlanArgs;
use super::rig_args::RigArgs;
use super::thresholds_args::ThresholdsArgs;
use super::validate_args::ValidateArgs;

/// Models and identifies flexible arms and drives whose joint has friction.
#[derive(Debug, Parser)]
#[command(name = "lissom", version = env!("LISSOM_VERSION"), max_term_width = 100, after_help = AFTER_HELP)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

const AFTER_HELP: &str = "\
Start with `lissom demo`: it runs the experiment on a virtual arm, writes its logs and their
campaign.toml, and identifies them. Then describe your own logs in a campaign.toml like that one,
and an arm's dimensions in an arm.toml for `lissom model`.

Exit codes: 0 done; 1 the input cannot be used; 2 wrong usage; 3 done, but the data refuse a
figure (see the findings), or the time a precision that was wished for.";

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Identify friction, frequency response and parameters from logs
    Identify(IdentifyArgs),
    /// Predict a log that was not used, to see how far a result holds
    Validate(ValidateArgs),
    /// Show the parameters of two or more results side by side, with their differences
    Compare(CompareArgs),
    /// From logs or frequency responses of points of a beam, the lumped arm that behaves the same
    Equivalent(EquivalentArgs),
    /// From logs with one payload, modes and the tip's response with others
    Payload(PayloadArgs),
    /// Turn an arm's dimensions into frequencies, matrices, transfer functions and plots
    Model(ModelArgs),
    /// From rough numbers of an arm, the runs that give a wanted precision in the least time
    Plan(PlanArgs),
    /// Run a campaign of experiments on a virtual arm and write its logs
    Rig(RigArgs),
    /// Remake Figures 6, 7 and 8 of the report on a virtual rig
    Figures(FiguresArgs),
    /// List every number that decides what is accepted, refused, warned of or chosen
    Thresholds(ThresholdsArgs),
    /// Print the completions of a shell
    Completions(CompletionsArgs),
    /// Write the manual pages
    Man(ManArgs),
    /// Run the report's experiment on a virtual arm and identify it from its logs
    Demo(DemoArgs),
}
