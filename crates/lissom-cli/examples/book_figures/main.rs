//! Draws the figures of the book's theory pages, as SVG, into the folder named on the command line.
//!
//! Every curve is computed by the library: logs by virtual experiments with fixed seeds, estimates from these logs.

#![expect(clippy::print_stderr, reason = "a program for a terminal")]

mod arms;
mod beams;
mod constant_velocity;
mod equivalent_arm;
mod experiments;
mod friction_curve;
mod friction_laws;
mod output_error;
mod plan_precision;
mod repeated_runs;
mod responses;
mod separability;
mod slip_windows;
mod stick_slip;
mod third_harmonic;

use std::error::Error;
use std::path::PathBuf;

use lissom_report::Figure;

/// Where figures go when no folder is named, from the top of the repository.
const FOLDER: &str = "docs/src/theory/figures";

/// A figure, or why it could not be made.
type Drawn = Result<Box<dyn Figure>, Box<dyn Error>>;
type Draw = fn() -> Drawn;

/// Every figure: its file without extension, and the function that draws it.
const FIGURES: [(&str, Draw); 15] = [
    ("beam-modes", beams::modes),
    ("payload-modes", beams::payload_modes),
    ("arm-bode", responses::arm),
    ("friction-laws", friction_laws::figure),
    ("stick-slip", stick_slip::figure),
    ("slip-windows", slip_windows::figure),
    ("friction-curve", friction_curve::figure),
    ("third-harmonic", third_harmonic::figure),
    ("constant-velocity", constant_velocity::figure),
    ("output-error", output_error::figure),
    ("corrected-response", responses::corrected),
    ("interval", repeated_runs::figure),
    ("separability", separability::figure),
    ("equivalent-arm", equivalent_arm::figure),
    ("plan-precision", plan_precision::figure),
];

fn main() -> Result<(), Box<dyn Error>> {
    let mut args = std::env::args_os().skip(1);
    let folder = PathBuf::from(args.next().unwrap_or_else(|| FOLDER.into()));
    if let Some(more) = args.next() {
        return Err(format!("one folder is taken; what is {}?", more.display()).into());
    }
    std::fs::create_dir_all(&folder)?;
    for (name, draw) in FIGURES {
        let start = std::time::Instant::now();
        let path = folder.join(name).with_extension("svg");
        std::fs::write(&path, draw()?.to_svg()?)?;
        eprintln!("{:.1} s {}", start.elapsed().as_secs_f64(), path.display());
    }
    Ok(())
}
