//! What the law gives for figures, and the finding that names it.

use super::{LawFit, LawTerm};
use crate::identify::finding::{Finding, Severity, key};
use crate::identify::{Estimate, Friction, Identified, OutputError};

/// Friction's figures under another law than Coulomb and one viscous constant.
pub(crate) fn friction(law: &LawFit) -> Friction {
    let sum = |a: Option<Estimate>, b: Option<Estimate>, sign: f64| {
        let (a, b) = (a?, b?);
        Some(Estimate { value: a.value + sign * b.value, std: a.std.hypot(b.std) })
    };
    let difference = law.term(|t| *t == LawTerm::ViscousByDirection);
    let by_direction = |sign: f64| sum(law.viscous, difference, sign);
    Friction {
        coulomb: law.coulomb,
        forward: sum(law.coulomb, law.offset, 1.0),
        backward: sum(law.coulomb, law.offset, -1.0),
        offset: law.offset,
        viscous: law.viscous,
        viscous_by_direction: by_direction(1.0).zip(by_direction(-1.0)),
    }
}

/// The law of friction that the data call for.
pub(crate) fn finding(id: &Identified) -> Option<Finding> {
    let law = id.friction_law.as_ref().filter(|law| law.chosen.departs())?;
    // The replay describes whole runs with its own law, and its figures are taken.
    let replayed = id.output_error.as_ref().is_some_and(OutputError::stands);
    let of_friction = |(term, _): &&(LawTerm, Vec<Estimate>)| *term != LawTerm::CommandLag;
    let terms: Vec<String> = law.chosen.terms.iter().filter(of_friction).map(in_words).collect();
    let taken = law.candidates.iter().filter(|c| c.taken && c.term != LawTerm::CommandLag);
    let paired = taken.map(|c| c.paired).fold(f64::INFINITY, f64::min);
    Some(Finding::new(
        "friction-law",
        if replayed { Severity::Info } else { Severity::Warning },
        &[key::COULOMB, key::VISCOUS],
        format!(
            "friction is not Coulomb and one viscous constant: {}; what is left falls to {:.0} % of \
             itself, and slip phases left out are described better by {paired:.0} deviations or more",
            terms.join(", "),
            100.0 * law.relative_residual[1] / law.relative_residual[0]
        ),
        if replayed {
            "the replay describes the runs without it: its figures are taken"
        } else {
            "Coulomb and viscous friction are those of this law at speed, not at rest: use the friction \
             curve at the speed that matters; runs at other speeds show whether the law holds there"
        },
    ))
}

/// A term of the law with its amplitude.
fn in_words((term, amplitude): &(LawTerm, Vec<Estimate>)) -> String {
    let a = amplitude.first().map_or(f64::NAN, |e| e.value);
    match term {
        LawTerm::ViscousByDirection => format!("viscous friction differs by ±{a:.3e} by direction"),
        LawTerm::NearRest { speed } if a > 0.0 => {
            format!("it rises by {a:.3e} towards rest, within {speed:.3e} per second (Stribeck)")
        }
        LawTerm::NearRest { speed } => {
            format!("it falls by {:.3e} towards rest, within {speed:.3e} per second", -a)
        }
        LawTerm::Root => format!("it grows with the root of speed, by {a:.3e}"),
        LawTerm::Ripple { per_angle } => {
            let size = amplitude.iter().map(|e| e.value * e.value).sum::<f64>().sqrt();
            let period = std::f64::consts::TAU / per_angle;
            format!("it changes over the travel by ±{size:.3e} with a period of {period:.4e}")
        }
        LawTerm::CommandLag => format!("the command acts {:.3} ms later", 1e3 * a),
    }
}
