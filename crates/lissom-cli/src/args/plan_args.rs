//! What `lissom plan` can be asked for.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use lissom::plan::{Kinds, Precision, Wishes};
use lissom_io::units::{Dimension, parse_quantity};

use super::positive_time::positive_time;
use super::stdout_name::STDOUT;

/// Motions are made as large as current, travel, bending and sensors allow by simulating the arm in
/// its loop; those are chosen that reach the wanted deviations in the least time. Without --out the
/// plan goes to standard output.
#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(crate) struct PlanArgs {
    /// The arm.toml, with [drive] and [rig]: rough numbers will do
    pub(crate) arm: PathBuf,
    /// Write the plan.toml that `lissom rig` runs to FILE, and show a table
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Write each run as a table of reference angles for hardware into DIR
    #[arg(long, value_name = "DIR")]
    pub(crate) tables: Option<PathBuf>,
    /// Write the plan as JSON to FILE, or alone to standard output
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = STDOUT)]
    pub(crate) json: Option<PathBuf>,
    /// Standard deviation wanted of every figure but damping, e.g. 1%
    #[arg(long, value_name = "SHARE", value_parser = share, allow_hyphen_values = true)]
    precision: Option<f64>,
    /// The same of Coulomb friction alone [0.5% when absent]
    #[arg(long, value_name = "SHARE", value_parser = share, allow_hyphen_values = true)]
    coulomb: Option<f64>,
    /// Of viscous friction [2%]
    #[arg(long, value_name = "SHARE", value_parser = share, allow_hyphen_values = true)]
    viscous: Option<f64>,
    /// Of the inertia [0.5%]
    #[arg(long, value_name = "SHARE", value_parser = share, allow_hyphen_values = true)]
    inertia: Option<f64>,
    /// Of the coupling between motor and beam [0.5%]
    #[arg(long, value_name = "SHARE", value_parser = share, allow_hyphen_values = true)]
    coupling: Option<f64>,
    /// Of the beam's frequencies [0.1%]
    #[arg(long, value_name = "SHARE", value_parser = share, allow_hyphen_values = true)]
    frequency: Option<f64>,
    /// Of the modes' damping [5%]: enough to tell which kind it is
    #[arg(long, value_name = "SHARE", value_parser = share, allow_hyphen_values = true)]
    damping: Option<f64>,
    /// Of the amplitude of gravity [0.5%]
    #[arg(long, value_name = "SHARE", value_parser = share, allow_hyphen_values = true)]
    gravity: Option<f64>,
    /// Longest time of all runs together, with waiting [30 min]
    #[arg(long, value_name = "TIME", value_parser = positive_time, allow_hyphen_values = true)]
    within: Option<f64>,
    /// The motor turns no further from its start [1 rad, and 0.9 of its sensor's range]
    #[arg(long, value_name = "ANGLE", value_parser = angle, allow_hyphen_values = true)]
    travel: Option<f64>,
    /// The tips bend no further from the motor's line [0.5 rad]
    #[arg(long, value_name = "ANGLE", value_parser = angle, allow_hyphen_values = true)]
    bend: Option<f64>,
    /// Share of the current limit that is kept for an arm that is not as the file says [30%]
    #[arg(long, value_name = "SHARE", value_parser = reserve, allow_hyphen_values = true)]
    reserve: Option<f64>,
    /// Which runs
    #[arg(long, value_enum, default_value_t = Runs::Pair)]
    runs: Runs,
}

/// See [`Kinds`].
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Runs {
    /// At least one sine with its triple, which the third-harmonic method needs
    Pair,
    /// Sines alone
    Sines,
    /// Whatever takes the least time
    Any,
}

impl PlanArgs {
    pub(crate) fn wishes(&self) -> Wishes {
        let none = Wishes::default();
        let all = self.precision.map_or(none.precision, Precision::all);
        Wishes {
            precision: Precision {
                coulomb: self.coulomb.unwrap_or(all.coulomb),
                viscous: self.viscous.unwrap_or(all.viscous),
                inertia: self.inertia.unwrap_or(all.inertia),
                coupling: self.coupling.unwrap_or(all.coupling),
                frequency: self.frequency.unwrap_or(all.frequency),
                damping: self.damping.unwrap_or(all.damping),
                gravity: self.gravity.unwrap_or(all.gravity),
            },
            within_s: self.within.unwrap_or(none.within_s),
            travel_rad: self.travel.unwrap_or(none.travel_rad),
            bend_rad: self.bend.unwrap_or(none.bend_rad),
            current_reserve: self.reserve.unwrap_or(none.current_reserve),
            kinds: match self.runs {
                Runs::Pair => Kinds::WithPair,
                Runs::Sines => Kinds::Sines,
                Runs::Any => Kinds::Any,
            },
        }
    }
}

/// A share greater than zero and less than one: a bare 1 means 1% to who types it, and 100 % as a number.
fn share(text: &str) -> Result<f64, String> {
    let hint = "write a share such as 0.5% or 0.005";
    match positive(text, hint)? {
        share if share < 1.0 => Ok(share),
        _ => Err(format!("it must be less than the whole\nhint: {hint}")),
    }
}

/// A share from zero to less than one.
fn reserve(text: &str) -> Result<f64, String> {
    let hint = "hint: write a share such as 30% or 0.3, less than the whole";
    match parse_quantity(text, Dimension::NUMBER) {
        Ok(value) if (0.0..1.0).contains(&value) => Ok(value),
        Ok(_) => Err(format!("it must be from 0 to less than 1\n{hint}")),
        Err(error) => Err(format!("{error}\n{hint}")),
    }
}

/// An angle greater than zero.
fn angle(text: &str) -> Result<f64, String> {
    positive(text, "write an angle such as \"1 rad\" or \"40 deg\"")
}

fn positive(text: &str, hint: &str) -> Result<f64, String> {
    match parse_quantity(text, Dimension::NUMBER) {
        Ok(value) if value > 0.0 => Ok(value),
        Ok(_) => Err(format!("it must be greater than zero\nhint: {hint}")),
        Err(error) => Err(format!("{error}\nhint: {hint}")),
    }
}

const HELP: &str = "\
  lissom plan arm.toml --out plan.toml                 the defaults: 0.5 %, viscous 2 %, frequencies 0.1 %
  lissom plan arm.toml --precision 1% --within \"5 min\" --out plan.toml
  lissom rig arm.toml --campaign plan.toml --out virtual
  lissom identify virtual/campaign.toml

A deviation is a standard deviation, relative to the figure. Where the time does not allow a wish, a
warning says what it does allow, and the exit code is 3. docs/src/how-to/planning.md explains how a plan is made
and what it was measured to be worth.";
