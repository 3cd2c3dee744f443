//! The tables of `docs/src/theory/lumped-and-distributed.md`, in markdown.

use std::error::Error;
use std::fmt::Write as _;

use lissom::beam::Payload;
use lissom_testmodels::limit::{Masses, cantilever, hub_and_tip_mass, stepped};
use num_complex::Complex64;

use crate::convergence::{COUNTS, NAMES, Study};
use crate::inertia;

/// Every table with its title.
pub(crate) fn all() -> Result<Vec<(&'static str, String)>, Box<dyn Error>> {
    Ok(vec![
        ("Uniform beam, half of each span's mass at each of its ends", errors()?),
        ("Measured orders, half masses at both ends", orders(Masses::BothEnds, 2)?),
        ("Measured orders, whole masses at outer ends", orders(Masses::OuterEnds, 1)?),
        ("Zeros of the tip over the payload's rotary inertia", over_inertia()?),
        ("Zeros with payloads of several kinds", payloads()?),
    ])
}

fn heading(columns: &[String]) -> String {
    format!("| {} |\n|{}\n", columns.join(" | "), "---|".repeat(columns.len()))
}

/// Counts of the columns.
const SHOWN: [usize; 4] = [8, 32, 128, 512];

fn errors() -> Result<String, Box<dyn Error>> {
    let study = Study::new(&cantilever(), Masses::BothEnds)?;
    let mut columns = vec!["figure".to_owned(), "distributed".to_owned()];
    columns.extend(SHOWN.map(|n| format!("n = {n}")));
    columns.push("order".to_owned());
    let mut table = heading(&columns);
    for (row, name) in NAMES.iter().enumerate() {
        let _ = write!(table, "| {name} | {:.4} |", study.exact[row]);
        for (error, _) in study.errors[row].iter().zip(COUNTS).filter(|(_, n)| SHOWN.contains(n)) {
            let _ = write!(table, " {error:+.2e} |");
        }
        let _ = writeln!(table, " {:.2} |", study.order(row));
    }
    Ok(table)
}

/// Orders, and in brackets the error at the largest count times n to the power `power`.
fn orders(masses: Masses, power: i32) -> Result<String, Box<dyn Error>> {
    let beams = [cantilever(), hub_and_tip_mass(), stepped()];
    let studies: Vec<Study> =
        beams.iter().map(|b| Study::new(b, masses)).collect::<Result<_, _>>()?;
    let columns = ["figure", "uniform", "hub and tip mass", "stepped"].map(str::to_owned);
    let mut table = heading(&columns);
    for (row, name) in NAMES.iter().enumerate() {
        let _ = write!(table, "| {name} |");
        for study in &studies {
            let (order, constant) = (study.order(row), study.constant(row, power));
            let _ = write!(table, " {order:.2} ({constant:+.3}) |");
        }
        table.push('\n');
    }
    Ok(table)
}

/// Rotary inertias of the rows \[kg·m²\].
const INERTIAS: [f64; 7] = [0.0, 1e-3, 1e-2, 1e-1, 1.0, 10.0, 1000.0];

fn over_inertia() -> Result<String, Box<dyn Error>> {
    let columns = ["J", "class a", "class b, first", "second", "third"].map(str::to_owned);
    let mut table = heading(&columns);
    for inertia in INERTIAS {
        let (pair, real) = inertia::tip(inertia)?;
        let pair = pair.map_or("none".to_owned(), |s| format!("±{s:.3}j"));
        let _ = write!(table, "| {inertia} | {pair} |");
        for s in real {
            let _ = write!(table, " ±{s:.3} |");
        }
        table.push('\n');
    }
    Ok(table)
}

/// Mass \[kg\], rotary inertia \[kg·m²\], offset \[m\], and the point where the angle is taken \[m\].
const PAYLOADS: [[f64; 4]; 8] = [
    [0.0, 0.0, 0.0, 1.0],
    [5.0, 0.0, 0.0, 1.0],
    [0.5, 0.04, 0.0, 1.0],
    [5.0, 0.04, 0.0, 1.0],
    [1.0, 0.0, 0.2, 1.0],
    [4.0, 0.03, 0.05, 1.0],
    [1.0, 0.0, -0.2, 1.0],
    [1.0, 0.0, -0.2, 0.8],
];

fn payloads() -> Result<String, Box<dyn Error>> {
    let columns = ["mass", "J", "offset e", "point", "first zeros"].map(str::to_owned);
    let mut table = heading(&columns);
    for [mass_kg, inertia_kg_m2, offset_m, point] in PAYLOADS {
        let zeros = inertia::zeros(Payload { mass_kg, inertia_kg_m2, offset_m }, point)?;
        let zeros: Vec<String> = zeros.into_iter().take(3).map(shown).collect();
        let zeros = zeros.join(", ");
        let _ = writeln!(table, "| {mass_kg} | {inertia_kg_m2} | {offset_m} | {point} | {zeros} |");
    }
    Ok(table)
}

fn shown(s: Complex64) -> String {
    let (re, im) = (s.re.abs(), s.im.abs());
    match (re > 1e-9 * s.norm(), im > 1e-9 * s.norm()) {
        (true, true) => format!("±{re:.3} ± {im:.3}j"),
        (false, true) => format!("±{im:.3}j"),
        _ => format!("±{re:.3}"),
    }
}
