//! The figures of `docs/src/theory/lumped-and-distributed.md`.

use std::error::Error;

use lissom_report::{Axis, LinePlot, Role, Trace, TraceStyle};
use lissom_testmodels::limit::{Masses, cantilever};

use crate::convergence::{COUNTS, Study};
use crate::inertia;

/// Every figure with its name.
pub(crate) fn all() -> Result<Vec<(&'static str, LinePlot)>, Box<dyn Error>> {
    Ok(vec![("lumped-and-distributed", convergence()?), ("rotary-inertia", loci()?)])
}

/// Rows of a study that one kind of mark stands for: the first three frequencies, and so on.
const FREQUENCIES: [usize; 3] = [0, 1, 2];
const ZEROS: [usize; 3] = [3, 4, 5];
const TORQUES: [usize; 4] = [6, 7, 8, 9];

fn convergence() -> Result<LinePlot, Box<dyn Error>> {
    let both = Study::new(&cantilever(), Masses::BothEnds)?;
    let outer = Study::new(&cantilever(), Masses::OuterEnds)?;
    let counts = COUNTS.map(|n| n as f64).to_vec();
    let mut plot = LinePlot::new(
        "Lumped arms tend to the distributed beam",
        Axis::log("number of masses n"),
        Axis::log("relative error"),
    )
    .subtitle(
        "Uniform beam: frequencies 1-3, tip zeros 1-3, C_t/θ_m at three frequencies and towards \
         zero. Half masses at both ends of each span; a whole mass at its outer end.",
    );
    for (label, from, power) in [("1/n, 1/n²", 4.0, -1), ("", 0.2, -2)] {
        let y = counts.iter().map(|n| from * n.powi(power)).collect();
        plot = plot.trace(Trace::line(label, Role::Truth, counts.clone(), y));
    }
    let groups: [(&str, Role, &Study, &[usize]); 5] = [
        ("frequencies, halves", Role::Corrected, &both, &FREQUENCIES),
        ("zeros, both ways", Role::Raw, &both, &ZEROS),
        ("torque, halves", Role::Other(0), &both, &TORQUES),
        ("frequencies, outer ends", Role::Fitted, &outer, &FREQUENCIES),
        ("torque, outer ends", Role::Other(3), &outer, &TORQUES),
    ];
    for (label, role, study, rows) in groups {
        for (k, row) in rows.iter().enumerate() {
            let y: Vec<f64> = study.errors[*row].iter().map(|e| e.abs()).collect();
            let label = if k == 0 { label } else { "" };
            plot = plot.trace(Trace::line("", role, counts.clone(), y.clone())).trace(Trace::new(
                label,
                role,
                TraceStyle::Points,
                counts.clone(),
                y,
            ));
        }
    }
    Ok(plot)
}

/// Inertias per decade, and the decades shown \[kg·m²\].
const PER_DECADE: i32 = 6;
const DECADES: (i32, i32) = (-5, 1);

fn loci() -> Result<LinePlot, Box<dyn Error>> {
    let ends = (10f64.powi(DECADES.0), 10f64.powi(DECADES.1));
    let (mut pair, mut real) = (Vec::new(), vec![Vec::new(); 3]);
    for k in DECADES.0 * PER_DECADE..=DECADES.1 * PER_DECADE {
        let inertia = 10f64.powf(f64::from(k) / f64::from(PER_DECADE));
        let (imaginary, reals) = inertia::tip(inertia)?;
        pair.extend(imaginary.map(|s| (inertia, s)));
        for (line, s) in real.iter_mut().zip(reals) {
            line.push((inertia, s));
        }
    }
    let mut plot = LinePlot::new(
        "Zeros of the tip over the payload's rotary inertia",
        Axis::log("rotary inertia J (kg·m²)").range(ends.0, ends.1),
        Axis::log("|s| of a zero (1/s)"),
    )
    .subtitle("Uniform beam of 1 m, 1 kg, EI 1 N·m²; the payload's mass does not matter.");
    for (label, inertia) in [("J = 0 and J → ∞", 0.0), ("", 1e3)] {
        for (k, s) in inertia::tip(inertia)?.1.into_iter().enumerate() {
            let label = if k == 0 { label } else { "" };
            let line = Trace::line(label, Role::Truth, vec![ends.0, ends.1], vec![s, s]);
            plot = plot.trace(line);
        }
    }
    let (x, y) = pair.into_iter().unzip();
    plot = plot.trace(Trace::line("class a: on the imaginary axis", Role::Corrected, x, y));
    for (k, line) in real.into_iter().enumerate() {
        let label = if k == 0 { "class b: on the real axis" } else { "" };
        let (x, y) = line.into_iter().unzip();
        plot = plot.trace(Trace::line(label, Role::Raw, x, y));
    }
    Ok(plot)
}
