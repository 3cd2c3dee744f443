//! Arguments of `lissom equivalent`.

use std::path::PathBuf;

use clap::Args;
use lissom_io::units::{Dimension, parse_quantity};

use super::stdout_name::STDOUT;

/// Takes a campaign.toml whose tips are angles, or tables of frequency responses at the same frequencies.
#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(crate) struct EquivalentArgs {
    /// A campaign.toml, or one or more tables of frequency responses
    #[arg(required = true, value_name = "INPUT")]
    pub(crate) inputs: Vec<PathBuf>,
    /// Write the arm as JSON to FILE (without FILE: print only JSON)
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = STDOUT)]
    pub(crate) json: Option<PathBuf>,
    /// Draw data and fit to FILE (.svg, .png), the motor to FILE-motor
    #[arg(long, value_name = "FILE")]
    pub(crate) plot: Option<PathBuf>,
    /// Write the arm as an arm.toml for `lissom model` and `lissom rig`
    #[arg(long, value_name = "FILE")]
    pub(crate) save_arm: Option<PathBuf>,
    /// Keep the lowest N modes [default: all that are found]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=100))]
    pub(crate) modes: Option<u16>,
    /// For tables: torque per unit of command, e.g. "0.25 N*m/A"
    #[arg(long, value_name = "CONSTANT", allow_hyphen_values = true)]
    pub(crate) torque_constant: Option<String>,
    /// The beam's arm.toml, to find a better place for a point
    #[arg(long, value_name = "ARM", requires = "at")]
    pub(crate) arm: Option<PathBuf>,
    /// Distance of a point from the axis, e.g. tip="0.45 m"; repeatable
    #[arg(long, value_name = "NAME=LENGTH", value_parser = place, requires = "arm", allow_hyphen_values = true)]
    pub(crate) at: Vec<(String, f64)>,
    /// For a campaign: no output-error method
    #[arg(long)]
    pub(crate) quick: bool,
}

/// Parses a name and a length \[m\].
fn place(text: &str) -> Result<(String, f64), String> {
    let hint = "hint: write a point's name and its distance from the axis, such as tip=\"0.45 m\"";
    let (name, length) =
        text.split_once('=').ok_or_else(|| format!("\"{text}\" has no =\n{hint}"))?;
    match parse_quantity(length, Dimension::LENGTH) {
        Ok(length_m) if length_m > 0.0 => Ok((name.trim().to_owned(), length_m)),
        Ok(_) => Err(format!("it must be greater than zero\n{hint}")),
        Err(error) => Err(format!("{error}\n{hint}")),
    }
}

const HELP: &str = "\
Examples:
  lissom equivalent campaign.toml --save-arm arm.toml
  lissom equivalent responses.csv --torque-constant \"0.25 N*m/A\" --plot bode.svg
A table has one row for each frequency (omega_rad_s, frequency_hz). Column names: tip_re and tip_im
or tip_db and tip_deg for point `tip` per motor angle, tip_std (optional) for its standard error;
motor_re [rad/A] and motor_im [rad/A] for the motor without friction (gives torque and inertia).";
