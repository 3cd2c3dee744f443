//! Arguments of `lissom payload`.

use std::path::PathBuf;

use clap::Args;
use lissom_io::units::{Dimension, parse_quantity};

use super::stdout_name::STDOUT;

/// Identifies the runs of a campaign that were made with one payload, then predicts the arm with other payloads at the
/// same point.
#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(crate) struct PayloadArgs {
    /// The campaign.toml, which describes the logs
    pub(crate) campaign: PathBuf,
    /// Payload in the logged runs, e.g. "55 g"
    #[arg(long, value_name = "MASS", value_parser = mass, allow_hyphen_values = true)]
    pub(crate) mass: f64,
    /// Payload to predict, e.g. "0.11 kg"; repeatable
    #[arg(long, value_name = "MASS", value_parser = mass, required = true, allow_hyphen_values = true)]
    pub(crate) to: Vec<f64>,
    /// Distance of the payload from a rotary axis, e.g. "0.45 m"
    #[arg(long, value_name = "LENGTH", value_parser = length, allow_hyphen_values = true)]
    pub(crate) at: Option<f64>,
    /// Tip at which the payload is fixed [default: the last tip]
    #[arg(long, value_name = "NAME")]
    pub(crate) tip: Option<String>,
    /// Write the prediction as JSON to FILE (without FILE: print only JSON)
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = STDOUT)]
    pub(crate) json: Option<PathBuf>,
    /// Draw the tip's responses to FILE.svg or FILE.png
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
Examples:
  lissom payload campaign.toml --mass \"55 g\" --at \"17.8 cm\" --to \"27 g\" --to \"0.11 kg\"
  lissom payload campaign.toml --mass \"0 g\" --at \"17.8 cm\" --to \"55 g\" --plot tip.svg

The payload is a point mass without rotary inertia. The output has the modes with the motor clamped
and the tip's response per motor angle, with 95 % intervals. The zeros of the tip's response do not
depend on the payload. The intervals do not include modes above those found; a heavy payload changes
these, too.";
