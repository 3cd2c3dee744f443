//! What the law gives for figures, and the finding that names it.

use crate::identify::drive_estimates::DriveEstimates;
use crate::identify::estimate::Estimate;
use crate::identify::finding::{Finding, Severity, key};
use crate::identify::friction_estimates::{Friction, NearRestEstimate, RippleEstimate};
use crate::identify::judge::{Chosen, Evidence};
use crate::identify::methods::friction_law::LawFit;
use crate::identify::methods::friction_law::law_term::LawTerm;
use crate::identify::methods::friction_law::refine::NEAR_REST_STEP;
use crate::identify::methods::friction_law::thresholds::NEGLIGIBLE_TERM;
use crate::identify::methods::output_error::OutputError;
use crate::record::Axis;

impl LawFit {
    /// All estimates under this law.
    pub fn estimates(&self) -> DriveEstimates {
        DriveEstimates {
            friction: friction(self),
            inertia: self.inertia,
            coupling: self.total_coupling,
            coupling_by_tip: self.coupling.clone(),
        }
    }
}

/// Friction under another law than Coulomb and one viscous constant.
fn friction(law: &LawFit) -> Friction {
    let sum = |a: Option<Estimate>, b: Option<Estimate>, sign: f64| {
        let (a, b) = (a?, b?);
        Some(Estimate { value: a.value + sign * b.value, std: a.std.hypot(b.std) })
    };
    let difference = law.term(|t| *t == LawTerm::ViscousByDirection);
    let by_direction = |sign: f64| sum(law.viscous, difference, sign);
    let near_rest = law.terms.iter().find_map(|(term, amplitude)| match term {
        LawTerm::NearRest { speed, falloff } => {
            let speed = Estimate { value: *speed, std: NEAR_REST_STEP * speed };
            Some(NearRestEstimate { torque: *amplitude.first()?, speed, falloff: *falloff })
        }
        _ => None,
    });
    let ripple = |(term, amplitude): &(LawTerm, Vec<Estimate>)| match (term, &amplitude[..]) {
        (LawTerm::Ripple { per_angle }, [cosine, sine, rate @ ..]) => Some(RippleEstimate {
            torque: Estimate {
                value: cosine.value.hypot(sine.value),
                std: cosine.std.hypot(sine.std),
            },
            per_angle: rate
                .first()
                .copied()
                .unwrap_or(Estimate { value: *per_angle, std: f64::INFINITY }),
        }),
        _ => None,
    };
    Friction {
        near_rest,
        ripples: law.terms.iter().filter_map(ripple).collect(),
        coulomb: law.coulomb,
        forward: sum(law.coulomb, law.offset, 1.0),
        backward: sum(law.coulomb, law.offset, -1.0),
        offset: law.offset,
        viscous: law.viscous,
        viscous_by_direction: by_direction(1.0).zip(by_direction(-1.0)),
    }
}

/// The law of friction that the data call for: that of the replay where it describes the runs.
pub(crate) fn finding(evidence: &Evidence<'_>, chosen: &Chosen) -> Option<Finding> {
    let axis = evidence.campaign.channels.axis;
    let replay = evidence.replay();
    let by_replay = replay.map_or(Vec::new(), OutputError::law_terms);
    if !by_replay.is_empty() {
        let whole = replay.is_some_and(|oe| oe.describes_whole_runs() && !oe.is_in_windows());
        let message = format!(
            "friction is not Coulomb and one viscous constant: {}; with that the replay describes {}",
            in_words(axis, &by_replay),
            if whole { "the runs from end to end" } else { "stretches of the runs" }
        );
        // Of exact logs everything is known, and whatever the simulator or the sensor adds is found.
        if by_replay.iter().all(|term| is_negligible(&chosen.drive.friction, term)) {
            let hint =
                "nothing: all of it is less than a thousandth of Coulomb and viscous friction";
            return Some(told(Severity::Info, message, hint));
        }
        return Some(told(Severity::Warning, message, AT_SPEED));
    }
    let law = evidence.methods.friction_law.as_ref().filter(|law| law.chosen.departs())?;
    let taken = law.candidates.iter().filter(|c| c.taken && c.term != LawTerm::CommandLag);
    let paired = taken.map(|c| c.paired).fold(f64::INFINITY, f64::min);
    let better = if paired.is_finite() {
        format!(
            "; what is left falls to {:.0} % of itself, and slip phases left out are described better by \
             {paired:.0} deviations or more",
            100.0 * law.relative_residual[1] / law.relative_residual[0]
        )
    } else {
        String::new()
    };
    let by_phases = if replay.is_some() { "by slip phases alone, " } else { "" };
    let message = format!(
        "{by_phases}friction is not Coulomb and one viscous constant: {}{better}",
        in_words(axis, &law.chosen.terms)
    );
    Some(match replay {
        // The replay describes whole runs with the simplest law, and its figures are taken.
        Some(_) => {
            let hint = "the replay describes the runs without it: its figures are taken";
            told(Severity::Info, message, hint)
        }
        None if law.chosen.terms.iter().any(|(t, _)| matches!(t, LawTerm::AfterTravel { .. })) => {
            let mut finding = told(Severity::Warning, message, BRISTLES);
            finding.affects.extend([key::INERTIA, key::COUPLING]);
            finding
        }
        None => told(Severity::Warning, message, AT_SPEED),
    })
}

/// Whether a term changes friction by less than [`NEGLIGIBLE_TERM`]; a root of speed is never taken for that little.
fn is_negligible(friction: &Friction, (term, amplitude): &(LawTerm, Vec<Estimate>)) -> bool {
    let of = match term {
        LawTerm::ViscousByDirection => friction.viscous,
        LawTerm::NearRest { .. } | LawTerm::Ripple { .. } => friction.coulomb,
        LawTerm::Root | LawTerm::AfterTravel { .. } => None,
        LawTerm::CommandLag => return true,
    };
    let largest = amplitude.iter().take(2).map(|a| a.value.abs()).fold(0.0, f64::max);
    of.is_some_and(|of| largest < NEGLIGIBLE_TERM * of.value)
}

const AT_SPEED: &str = "Coulomb and viscous friction are those of this law at speed, not at rest: use \
                        the friction curve at the speed that matters; runs at other speeds show \
                        whether the law holds there";

const BRISTLES: &str = "Coulomb and viscous friction are those of this law at speed, not at rest; inertia and \
                        coupling are off by what bristles lag where friction changes with speed: drive \
                        the joint farther and faster to see less of it";

fn told(severity: Severity, message: String, hint: &'static str) -> Finding {
    Finding::new("friction-law", severity, &[key::COULOMB, key::VISCOUS], message, hint)
}

/// Terms of friction with their amplitudes.
fn in_words(axis: Axis, terms: &[(LawTerm, Vec<Estimate>)]) -> String {
    let of_friction = terms.iter().filter(|(term, _)| *term != LawTerm::CommandLag);
    of_friction.map(|term| term_in_words(axis, term)).collect::<Vec<_>>().join(", ")
}

/// A term of the law with its amplitude.
fn term_in_words(axis: Axis, (term, amplitude): &(LawTerm, Vec<Estimate>)) -> String {
    let angle = match axis {
        Axis::Rotary => "rad",
        Axis::Linear => "m",
    };
    let a = amplitude.first().map_or(f64::NAN, |e| e.value);
    match term {
        LawTerm::ViscousByDirection => {
            format!("viscous friction differs by ±{:.3e} by direction", a.abs())
        }
        LawTerm::AfterTravel { travel } => format!(
            "after a reversal it grows over some travel (bristles, presliding), and the first \
             {travel:.3e} {angle} of every slip phase are left out"
        ),
        LawTerm::NearRest { speed, .. } if a > 0.0 => {
            format!("it rises by {a:.3e} towards rest, within {speed:.3e} {angle}/s (Stribeck)")
        }
        LawTerm::NearRest { speed, .. } => {
            format!("it falls by {:.3e} towards rest, within {speed:.3e} {angle}/s", -a)
        }
        LawTerm::Root => format!("it grows with the root of speed, by {a:.3e}"),
        LawTerm::Ripple { per_angle } => {
            let size = amplitude.iter().take(2).map(|e| e.value * e.value).sum::<f64>().sqrt();
            let period = std::f64::consts::TAU / per_angle;
            format!(
                "it changes over the travel by ±{size:.3e} with a period of {period:.4e} {angle}"
            )
        }
        LawTerm::CommandLag => format!("the command acts {:.3} ms later", 1e3 * a),
    }
}
