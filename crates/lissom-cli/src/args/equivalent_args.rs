//! What `lissom equivalent` can be asked for.

use std::path::PathBuf;

use clap::Args;
use lissom_io::units::{Dimension, parse_quantity};

use super::stdout_name::STDOUT;

/// INPUT is a campaign.toml whose tips are angles, or tables of frequency responses on one grid.
#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(crate) struct EquivalentArgs {
    /// A campaign.toml, or one table or more
    #[arg(required = true, value_name = "INPUT")]
    pub(crate) inputs: Vec<PathBuf>,
    /// Write the arm as JSON to FILE, or alone to standard output
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = STDOUT)]
    pub(crate) json: Option<PathBuf>,
    /// Draw data and fit into FILE.svg or FILE.png, the motor's beside it
    #[arg(long, value_name = "FILE")]
    pub(crate) plot: Option<PathBuf>,
    /// Write the arm into an arm.toml that `lissom model` and `lissom rig` take
    #[arg(long, value_name = "FILE")]
    pub(crate) save_arm: Option<PathBuf>,
    /// Keep the lowest N modes; all that are found when absent
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=100))]
    pub(crate) modes: Option<u16>,
    /// Of tables: the motor's torque per command, e.g. "0.25 N*m/A"
    #[arg(long, value_name = "CONSTANT", allow_hyphen_values = true)]
    pub(crate) torque_constant: Option<String>,
    /// The beam's arm.toml, to say where a point that moves like another should sit
    #[arg(long, value_name = "ARM", requires = "at")]
    pub(crate) arm: Option<PathBuf>,
    /// Where a point sits, its distance from the axis, e.g. tip="0.45 m"; once for each point
    #[arg(long, value_name = "NAME=LENGTH", value_parser = place, requires = "arm", allow_hyphen_values = true)]
    pub(crate) at: Vec<(String, f64)>,
    /// Of a campaign: closed forms only, do not replay the runs through the arm
    #[arg(long)]
    pub(crate) quick: bool,
}

/// A name and a length in m.
fn place(text: &str) -> Result<(String, f64), String> {
    let hint = "hint: write a point's name and its distance from the axis, such as tip=\"0.45 m\"";
    let (name, length) = text.split_once('=').ok_or_else(|| format!("there is no =\n{hint}"))?;
    match parse_quantity(length, Dimension::LENGTH) {
        Ok(length_m) if length_m > 0.0 => Ok((name.trim().to_owned(), length_m)),
        Ok(_) => Err(format!("it must be greater than zero\n{hint}")),
        Err(error) => Err(format!("{error}\n{hint}")),
    }
}

const HELP: &str = "\
  lissom equivalent campaign.toml
  lissom equivalent responses.csv --torque-constant \"0.25 N*m/A\" --plot bode.svg
  lissom equivalent tip.csv elbow.csv motor.csv --json arm.json

A table has a header and one row a frequency; names say what a column is:

  omega_rad_s  frequency_hz  f [Hz]       the frequency
  tip_re tip_im                           a response to the motor's angle, of the point `tip`
  tip_db tip_deg  tip_mag tip_phase [rad] the same by size and phase
  tip_std                                 its standard deviation, may be absent
  motor_re [rad/A] motor_im [rad/A]       the motor's to its command, friction taken out

Where a file has one response, re and im will do: the file's name is the point's. With as many points as
modes the arm is complete; with the motor's response it has its torque, inertia and viscous friction too.
docs/src/how-to/equivalent.md explains every figure.";
