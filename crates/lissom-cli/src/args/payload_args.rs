//! What `lissom payload` can be asked for.

use std::path::PathBuf;

use clap::Args;
use lissom_io::units::{Dimension, parse_quantity};

use super::stdout_name::STDOUT;

/// The runs of CAMPAIGN are identified with the payload that they were made with; the arm found is then
/// predicted with others at the same point.
#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(crate) struct PayloadArgs {
    /// The campaign.toml
    pub(crate) campaign: PathBuf,
    /// Payload that the runs were made with, e.g. "55 g"
    #[arg(long, value_name = "MASS", value_parser = mass, allow_hyphen_values = true)]
    pub(crate) mass: f64,
    /// Payload to predict, e.g. "0.11 kg"; once for each
    #[arg(long, value_name = "MASS", value_parser = mass, required = true, allow_hyphen_values = true)]
    pub(crate) to: Vec<f64>,
    /// Distance of the payload from the axis, e.g. "0.45 m"; not on linear axes
    #[arg(long, value_name = "LENGTH", value_parser = length, allow_hyphen_values = true)]
    pub(crate) at: Option<f64>,
    /// Tip that carries it; the last of the campaign when absent
    #[arg(long, value_name = "NAME")]
    pub(crate) tip: Option<String>,
    /// Write the prediction as JSON to FILE, or alone to standard output
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = STDOUT)]
    pub(crate) json: Option<PathBuf>,
    /// Draw the tip's responses into FILE.svg or FILE.png
    #[arg(long, value_name = "FILE")]
    pub(crate) plot: Option<PathBuf>,
}

fn mass(text: &str) -> Result<f64, String> {
    let hint = "hint: write a mass with its unit, such as \"55 g\"";
    match parse_quantity(text, Dimension::MASS) {
        Ok(mass_kg) if mass_kg >= 0.0 => Ok(mass_kg),
        Ok(_) => Err(format!("it must not be less than zero\n{hint}")),
        Err(error) => Err(format!("{error}\n{hint}")),
    }
}

fn length(text: &str) -> Result<f64, String> {
    let hint = "hint: write a length with its unit, such as \"0.45 m\"";
    match parse_quantity(text, Dimension::LENGTH) {
        Ok(length_m) if length_m > 0.0 => Ok(length_m),
        Ok(_) => Err(format!("it must be greater than zero\n{hint}")),
        Err(error) => Err(format!("{error}\n{hint}")),
    }
}

const HELP: &str = "\
  lissom payload campaign.toml --mass \"55 g\" --at \"17.8 cm\" --to \"27 g\" --to \"0.11 kg\"

The payload is a point mass: its weight is on the beam's line, and it does not turn on its own. Where a tip is
measured its zeros stay where they are, whatever it carries; its poles move. Modes with the motor held, and the
tip's response to the motor's angle, come with 95 % intervals. What no run has shown is in none of them: modes
above those found bend under a heavy load, too.
docs/src/how-to/payload.md shows how far that goes.";
