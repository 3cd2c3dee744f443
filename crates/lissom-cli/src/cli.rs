//! What the user can ask for.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};
use lissom_io::units::{Dimension, parse_quantity};

use crate::equivalent::EquivalentArgs;
use crate::model::ModelArgs;
use crate::payload::PayloadArgs;
use crate::plan::PlanArgs;

/// Models and identifies flexible arms and drives whose joint has friction.
#[derive(Debug, Parser)]
#[command(name = "lissom", version, max_term_width = 100, after_help = AFTER_HELP)]
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
    /// Run the report's experiment on a virtual arm and identify it from its logs
    Demo(DemoArgs),
}

/// The logs are described by a campaign.toml: columns, units, what is known of the drive.
#[derive(Debug, Args)]
#[command(after_help = IDENTIFY_HELP)]
pub(crate) struct IdentifyArgs {
    /// The campaign.toml
    pub(crate) campaign: PathBuf,
    /// Write the result as JSON to FILE, or alone to standard output
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = STDOUT)]
    pub(crate) json: Option<PathBuf>,
    /// Write one self-contained HTML page
    #[arg(long, value_name = "FILE")]
    pub(crate) report: Option<PathBuf>,
    /// Draw the Bode plots into DIR as SVG and PNG
    #[arg(long, value_name = "DIR")]
    pub(crate) plots: Option<PathBuf>,
    /// Length of the regression's window, e.g. "0.3 s"; chosen from the data when absent
    #[arg(long, value_name = "TIME", value_parser = positive_time, allow_hyphen_values = true)]
    pub(crate) window: Option<f64>,
    /// Closed forms only: do not replay the runs through the arm
    #[arg(long)]
    pub(crate) quick: bool,
}

/// A time greater than zero, in seconds.
pub(crate) fn positive_time(text: &str) -> Result<f64, String> {
    let hint = "hint: write a time with its unit, such as \"0.3 s\"";
    match parse_quantity(text, Dimension::TIME) {
        Ok(time_s) if time_s > 0.0 => Ok(time_s),
        Ok(_) => Err(format!("it must be greater than zero\n{hint}")),
        Err(error) => Err(format!("{error}\n{hint}")),
    }
}

const IDENTIFY_HELP: &str = "\
A campaign.toml:

  [signals]
  time    = { column = \"t\", unit = \"s\" }
  current = { column = \"i\", unit = \"A\", hold = \"sampled\" }  # or \"measured\"
  motor   = { column = \"theta_m\", unit = \"rad\" }
  tips    = [{ name = \"tip\", column = \"theta_t\", unit = \"rad\" }]
  [drive]
  torque_constant = \"2.184 lbf*in/A\"
  [[runs]]
  file = \"run-01.csv\"

Columns go by name or number. hold = \"sampled\" is a commanded value held between samples,
\"measured\" one that was measured. A command of unknown unit has unit = \"1\": figures are then
per unit of command. docs/campaign.md explains every key.";

/// RESULT is what `lissom identify CAMPAIGN --json RESULT` wrote; LOG is a run that is not in CAMPAIGN.
#[derive(Debug, Args)]
#[command(after_help = VALIDATE_HELP)]
pub(crate) struct ValidateArgs {
    /// The result.json
    pub(crate) result: PathBuf,
    /// A campaign.toml that describes the log, or with --like the log itself
    pub(crate) log: PathBuf,
    /// Read LOG as this campaign.toml reads its own logs
    #[arg(long, value_name = "CAMPAIGN")]
    pub(crate) like: Option<PathBuf>,
    /// Write what comes of it as JSON to FILE, or alone to standard output
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = STDOUT)]
    pub(crate) json: Option<PathBuf>,
    /// Draw torque, motion, residuals and correlations into DIR as SVG and PNG
    #[arg(long, value_name = "DIR")]
    pub(crate) plots: Option<PathBuf>,
    /// Length of the window that torque is averaged with, e.g. "20 ms"; that of the logs used when absent
    #[arg(long, value_name = "TIME", value_parser = positive_time, allow_hyphen_values = true)]
    pub(crate) window: Option<f64>,
    /// Predict motion over this time alone, e.g. "0.5 s"; whole runs and shorter ones when absent
    #[arg(long, value_name = "TIME", value_parser = positive_time, allow_hyphen_values = true)]
    pub(crate) horizon: Option<f64>,
}

const VALIDATE_HELP: &str = "\
  lissom identify campaign.toml --json result.json
  lissom validate result.json run-09.csv --like campaign.toml --plots plots

Two predictions, and what is left of them:

  torque   from the logged motion: what the figures say it takes, beside what was commanded.
           No figure is better known than this is predicted.
  motion   from the logged command: the arm simulated, sticking and slipping, from one initial
           state for each stretch. Over whole runs an open motor drifts; see the shorter ones.
  left     residuals as large as the sensor's own noise and white: nothing is missing. Beyond
           that, the terms that the residual looks like say what is: a delay, friction, inertia.

docs/validate.md explains every figure. Exit code 3: the torque is not predicted.";

/// The logs come with a campaign.toml that `lissom identify` reads. An interrupted campaign goes on
/// where it stopped; the same ARM and PLAN give the same bytes on any number of threads.
#[derive(Debug, Args)]
#[command(after_help = RIG_HELP)]
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

const RIG_HELP: &str = "\
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
docs/plan.md explains every key, docs/arm.md the arm, its instruments and the world at its tip.";

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

/// Motor and beam by stepped sines (theory, as measured, corrected, fitted), and friction by steady
/// velocities beside friction by sines, on a joint whose friction grows less than in proportion with
/// speed: extrapolated from high speed to rest it comes out too high.
#[derive(Debug, Args)]
pub(crate) struct FiguresArgs {
    /// Folder for the figures and their logs
    #[arg(long, value_name = "DIR", default_value = "lissom-figures")]
    pub(crate) out: PathBuf,
    /// Write the friction figures as JSON to FILE, or alone to standard output
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = STDOUT)]
    pub(crate) json: Option<PathBuf>,
}

/// The file name that stands for standard output.
pub(crate) const STDOUT: &str = "-";
