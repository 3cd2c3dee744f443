//! Arguments of `lissom model`.

use std::path::PathBuf;

use clap::Args;
use lissom_io::units::{Dimension, parse_quantity};

use super::stdout_name::STDOUT;

/// Computes natural frequencies, zeros, the matrices of the 1989 report, transfer functions and frequency responses
/// from a beam's dimensions. With a `[drive]` also those of the whole arm, without Coulomb friction.
#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(crate) struct ModelArgs {
    /// The arm.toml, which has the dimensions
    pub(crate) arm: PathBuf,
    /// Write JSON to FILE (without FILE: print only JSON)
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = STDOUT)]
    pub(crate) json: Option<PathBuf>,
    /// Frequencies of responses: logarithmic range [rad/s] or file
    #[arg(long, value_name = "FILE|START:STOP:COUNT", value_parser = omega, allow_hyphen_values = true)]
    pub(crate) omega: Option<Omega>,
    /// Check the properties of Section 3 of the 1989 report
    #[arg(long)]
    pub(crate) properties: bool,
    /// Other loads at the tip: factors or masses, as in 2x,"0.3 kg"
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = load, allow_hyphen_values = true)]
    pub(crate) payload: Vec<Load>,
    /// Natural frequencies and zeros to show
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = modes)]
    pub(crate) modes: usize,
    /// Responses of all masses for up to 200 masses, not 20
    #[arg(long)]
    pub(crate) all: bool,
    /// Write Bode plots and mode shapes into DIR as SVG and PNG
    #[arg(long, value_name = "DIR")]
    pub(crate) plots: Option<PathBuf>,
}

const HELP: &str = "\
Examples:
  lissom model arm.toml --omega 0.1:100:200 --payload 0.5x,2x,5x
  lissom model arm.toml --json model.json --plots plots
An arm.toml of two lines (the page arm.toml in the book explains every key):
  beam.flexural_rigidity = \"0.02 N*m^2\"
  beam.spans = [{ length = \"15 cm\", mass = \"55 g\" }, { length = \"15 cm\", mass = \"55 g\" }]
Classes of zeros: a imaginary pair, b real pair, c quadruple. With b or c the inverse is unstable.";

/// Frequencies at which responses are computed.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Omega {
    /// Logarithmic steps from the first to the last, both included \[rad/s\].
    Range { start: f64, stop: f64, count: usize },
    /// The first column of a file.
    File(PathBuf),
}

/// A load at the tip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Load {
    /// The load in the file times this factor.
    Times(f64),
    /// A mass \[kg\].
    Mass(f64),
}

/// Largest number of frequencies in a range.
const MOST_FREQUENCIES: usize = 1_000_000;
/// Largest number of natural frequencies that are shown or searched for.
const MOST_MODES: usize = 1000;
/// Allowed range of loads and frequencies, in SI: their products stay finite.
const SIZE: std::ops::RangeInclusive<f64> = 1e-30..=1e30;

fn omega(text: &str) -> Result<Omega, String> {
    let hint = "hint: give START:STOP:COUNT in rad/s, such as 0.1:100:200, or a file";
    let failed = |reason: String| Err(format!("{reason}\n{hint}"));
    let parts: Vec<&str> = text.split(':').collect();
    // A path may begin with a drive letter and a colon.
    let path = parts.len() == 2 && parts[0].len() == 1 && parts[0].parse::<f64>().is_err();
    if parts.len() == 1 && text.trim().parse::<f64>().is_ok() {
        return failed("one frequency is not a range".to_owned());
    }
    if parts.len() == 1 || path {
        return Ok(Omega::File(PathBuf::from(text)));
    }
    let [start, stop, count] = parts[..] else {
        return failed("a range must have three parts".to_owned());
    };
    let (start, stop) = match (frequency(start), frequency(stop)) {
        (Ok(start), Ok(stop)) => (start, stop),
        (Err(reason), _) | (_, Err(reason)) => return failed(reason),
    };
    if stop <= start {
        return failed("STOP must be greater than START".to_owned());
    }
    match count.trim().parse::<usize>() {
        Ok(count) if (2..=MOST_FREQUENCIES).contains(&count) => {
            Ok(Omega::Range { start, stop, count })
        }
        _ => failed(format!(
            "COUNT is \"{count}\", but must be a whole number from 2 to {MOST_FREQUENCIES}"
        )),
    }
}

/// Parses a number in rad/s, or a frequency with its unit.
fn frequency(text: &str) -> Result<f64, String> {
    let number = text.trim().parse::<f64>().ok();
    let value = match number {
        Some(value) => value,
        None => parse_quantity(text, Dimension::RATE).map_err(|error| error.to_string())?,
    };
    if SIZE.contains(&value) {
        Ok(value)
    } else {
        Err(format!("\"{text}\" must be positive and finite"))
    }
}

fn load(text: &str) -> Result<Load, String> {
    let hint = "hint: write factors such as 2x or masses such as \"0.3 kg\", separated by commas";
    let text = text.trim();
    let found = match text.strip_suffix(['x', '×']).map(|factor| factor.trim().parse::<f64>()) {
        Some(Ok(factor)) => Ok(Load::Times(factor)),
        Some(Err(_)) => Err(format!("\"{text}\" is not a factor")),
        None => parse_quantity(text, Dimension::MASS).map(Load::Mass).map_err(|e| e.to_string()),
    };
    match found {
        Ok(load @ (Load::Times(size) | Load::Mass(size))) if SIZE.contains(&size) => Ok(load),
        Ok(_) => Err(format!("it must be greater than zero and finite\n{hint}")),
        Err(reason) => Err(format!("{reason}\n{hint}")),
    }
}

fn modes(text: &str) -> Result<usize, String> {
    match text.parse::<usize>() {
        Ok(count) if (1..=MOST_MODES).contains(&count) => Ok(count),
        _ => Err(format!("it must be a whole number from 1 to {MOST_MODES}")),
    }
}

impl Omega {
    /// The frequencies of a range in logarithmic steps, with exact ends.
    pub(crate) fn range(start: f64, stop: f64, count: usize) -> Vec<f64> {
        let last = count.max(2) - 1;
        let at = |k: usize| match k {
            0 => start,
            k if k == last => stop,
            k => start * (stop / start).powf(k as f64 / last as f64),
        };
        (0..=last).map(at).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frequencies_are_a_range_or_a_file() {
        let range = |start, stop, count| Ok(Omega::Range { start, stop, count });
        assert_eq!(omega("0.1:100:200"), range(0.1, 100.0, 200));
        assert_eq!(omega("1 rad/s:5 rad/s:3"), range(1.0, 5.0, 3));
        assert_eq!(omega("grid.csv"), Ok(Omega::File("grid.csv".into())));
        assert_eq!(omega("c:\\grid.csv"), Ok(Omega::File("c:\\grid.csv".into())));
        for wrong in ["1:2", "1:2:3:4", "0:1:5", "2:1:5", "1:2:1", "1:2:x", "-1:2:5", "1:inf:5", ""]
        {
            assert!(wrong.is_empty() || omega(wrong).is_err(), "{wrong}");
        }
        assert_eq!(Omega::range(1.0, 100.0, 3), [1.0, 10.0, 100.0]);
    }

    #[test]
    fn loads_are_factors_or_masses() {
        assert_eq!(load("0.5x"), Ok(Load::Times(0.5)));
        assert_eq!(load(" 300 g"), Ok(Load::Mass(0.3)));
        for wrong in ["0x", "-1x", "x", "0.3", "0 kg", "1 m", "nanx", ""] {
            assert!(load(wrong).is_err(), "{wrong}");
        }
    }
}
