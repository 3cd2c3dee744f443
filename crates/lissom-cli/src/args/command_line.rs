//! The command line: global options and the list of subcommands.

use clap::{Parser, Subcommand};

use super::check_args::CheckArgs;
use super::compare_args::CompareArgs;
use super::completions_args::CompletionsArgs;
use super::demo_args::DemoArgs;
use super::equivalent_args::EquivalentArgs;
use super::export_args::ExportArgs;
use super::figures_args::FiguresArgs;
#[cfg(feature = "fleet")]
use super::fleet_args::FleetArgs;
use super::identify_args::IdentifyArgs;
use super::init_args::InitArgs;
use super::inspect_args::InspectArgs;
use super::man_args::ManArgs;
use super::model_args::ModelArgs;
use super::payload_args::PayloadArgs;
use super::plan_args::PlanArgs;
use super::plot_args::PlotArgs;
use super::report_args::ReportArgs;
use super::rig_args::RigArgs;
#[cfg(feature = "studio")]
use super::studio_args::StudioArgs;
use super::thresholds_args::ThresholdsArgs;
use super::validate_args::ValidateArgs;

/// Model and identify drives with friction, with a rigid load or a flexible arm.
#[derive(Debug, Parser)]
#[command(name = "lissom", version = env!("LISSOM_VERSION"), max_term_width = 100, after_help = AFTER_HELP)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

const AFTER_HELP: &str = "\
Start with `lissom demo`. `lissom help COMMAND` shows examples of each command.

Exit codes:
  0    done
  1    the input cannot be used
  2    wrong usage
  3    done, but a parameter could not be identified (see the findings), or the wanted precision
       does not fit into the allowed time
  4    stopped by Ctrl-C or a time limit, with the best result so far
  5    a parameter of `check` is outside its limits
  130  stopped by a second Ctrl-C, without a result";

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Show what is in a log: channels, units, clock, and which channel is probably what
    Inspect(InspectArgs),
    /// Write a campaign.toml for logs, with comments
    Init(InitArgs),
    /// Open logs, identify and see results in your browser
    #[cfg(feature = "studio")]
    Studio(StudioArgs),
    /// Identify friction, inertia, coupling, modes and frequency responses from logs
    Identify(IdentifyArgs),
    /// Check a result: predict a log that was not used for it
    Validate(ValidateArgs),
    /// Compare the parameters of a log with limits: pass or fail
    Check(CheckArgs),
    /// Identify the logs of many machines; summarise them
    #[cfg(feature = "fleet")]
    Fleet(FleetArgs),
    /// Write the report page of a stored result
    Report(ReportArgs),
    /// Draw one figure of a stored result as SVG, PNG or PDF
    Plot(PlotArgs),
    /// Show the parameters of two or more results side by side
    Compare(CompareArgs),
    /// Write a model for python-control, MATLAB, MuJoCo, URDF or C
    Export(ExportArgs),
    /// Find the lumped arm that behaves as a beam does at its measured points
    Equivalent(EquivalentArgs),
    /// Predict an identified arm with other payloads
    Payload(PayloadArgs),
    /// Compute frequencies, zeros, matrices and transfer functions from an arm's dimensions
    Model(ModelArgs),
    /// Choose the runs that give a wanted precision in the least time
    Plan(PlanArgs),
    /// Simulate a campaign of experiments and write its logs
    Rig(RigArgs),
    /// Simulate the experiments behind Figures 6, 7 and 8 of the 1989 report and draw them
    Figures(FiguresArgs),
    /// List every number that decides which estimates are given and which findings are reported
    Thresholds(ThresholdsArgs),
    /// Print a script that lets a shell complete commands of lissom
    Completions(CompletionsArgs),
    /// Write manual pages for `man`
    Man(ManArgs),
    /// Simulate the experiment of the 1989 report and identify the arm from its logs
    Demo(DemoArgs),
}
