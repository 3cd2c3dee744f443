//! Arguments of `lissom plan`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use lissom::plan::{Kinds, Precision, Wishes};
use lissom_io::units::{Dimension, parse_quantity};

use super::positive_time::positive_time;
use super::stdout_name::STDOUT;

/// Simulates the arm in its position loop, makes each motion as large as current, travel, bending and sensors allow,
/// and chooses the motions that reach the wanted standard errors in the least time. Without `--out` the plan goes to
/// standard output.
#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(crate) struct PlanArgs {
    /// The arm.toml with [drive] and [rig]; rough numbers are enough
    pub(crate) arm: PathBuf,
    /// Write a plan.toml for `lissom rig` to FILE, and show a table
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Write each run into DIR as a table of reference angles for hardware
    #[arg(long, value_name = "DIR")]
    pub(crate) tables: Option<PathBuf>,
    /// Write the plan as JSON to FILE (without FILE: print only JSON)
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = STDOUT)]
    pub(crate) json: Option<PathBuf>,
    /// Relative standard error of all parameters except damping, e.g. 1%
    #[arg(long, value_name = "SHARE", value_parser = share, allow_hyphen_values = true)]
    precision: Option<f64>,
    /// The same for Coulomb friction [default: 0.5%]
    #[arg(long, value_name = "SHARE", value_parser = share, allow_hyphen_values = true)]
    coulomb: Option<f64>,
    /// For viscous friction [default: 2%]
    #[arg(long, value_name = "SHARE", value_parser = share, allow_hyphen_values = true)]
    viscous: Option<f64>,
    /// For inertia [default: 0.5%]
    #[arg(long, value_name = "SHARE", value_parser = share, allow_hyphen_values = true)]
    inertia: Option<f64>,
    /// For the coupling between motor and beam [default: 0.5%]
    #[arg(long, value_name = "SHARE", value_parser = share, allow_hyphen_values = true)]
    coupling: Option<f64>,
    /// For the natural frequencies [default: 0.1%]
    #[arg(long, value_name = "SHARE", value_parser = share, allow_hyphen_values = true)]
    frequency: Option<f64>,
    /// For the damping of modes [default: 5%, which separates its kinds]
    #[arg(long, value_name = "SHARE", value_parser = share, allow_hyphen_values = true)]
    damping: Option<f64>,
    /// For the amplitude of gravity [default: 0.5%]
    #[arg(long, value_name = "SHARE", value_parser = share, allow_hyphen_values = true)]
    gravity: Option<f64>,
    /// Allowed time of all runs with waiting [default: 30 min]
    #[arg(long, value_name = "TIME", value_parser = positive_time, allow_hyphen_values = true)]
    within: Option<f64>,
    /// Largest motor angle [default: 1 rad, or 0.9 of the sensor's range]
    #[arg(long, value_name = "ANGLE", value_parser = angle, allow_hyphen_values = true)]
    travel: Option<f64>,
    /// Largest bending of the tips [default: 0.5 rad]
    #[arg(long, value_name = "ANGLE", value_parser = angle, allow_hyphen_values = true)]
    bend: Option<f64>,
    /// Share of the current limit that is not used [default: 30%]
    #[arg(long, value_name = "SHARE", value_parser = reserve, allow_hyphen_values = true)]
    reserve: Option<f64>,
    /// pair (with a sine and its triple), sines (only), or any
    #[arg(long, value_enum, default_value_t = Runs::Pair, hide_possible_values = true)]
    runs: Runs,
}

/// Kinds of runs to choose from; see [`Kinds`].
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Runs {
    /// At least one sine and another at three times its frequency, for the third-harmonic method
    Pair,
    /// Sines only
    Sines,
    /// The kinds that take the least time
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

/// Parses a share greater than zero and less than one. A bare 1 is rejected, as it could mean 1 % or 100 %.
fn share(text: &str) -> Result<f64, String> {
    let hint = "write a share such as 0.5% or 0.005";
    match positive(text, hint)? {
        share if share < 1.0 => Ok(share),
        _ => Err(format!("it must be less than 100 %\nhint: {hint}")),
    }
}

/// Parses a share from zero to less than one.
fn reserve(text: &str) -> Result<f64, String> {
    let hint = "hint: write a share such as 30% or 0.3";
    match parse_quantity(text, Dimension::NUMBER) {
        Ok(value) if (0.0..1.0).contains(&value) => Ok(value),
        Ok(_) => Err(format!("it must be at least 0 % and less than 100 %\n{hint}")),
        Err(error) => Err(format!("{error}\n{hint}")),
    }
}

/// Parses an angle greater than zero.
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
Examples:
  lissom plan arm.toml --precision 1% --within \"5 min\" --out plan.toml
  lissom rig arm.toml --campaign plan.toml --out virtual
If the time is too short for a wanted standard error, a warning gives the one that it allows, and
the exit code is 3. The runs are then those that come closest.";
