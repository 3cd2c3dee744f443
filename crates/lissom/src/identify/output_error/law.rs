//! What friction has beyond Coulomb's, where the residual calls for it.

use std::f64::consts::SQRT_2;

use super::evidence::{self, Extension};
use super::stages::{Fit, Fitting};
use super::windows::fastest_rad_s;
use crate::identify::LawTerm;
use crate::replay::{DryTerms, NearRest, Parameter, Ripple};

/// Speeds over which friction near rest is tried to change, as shares of the fastest.
const NEAR_REST: [f64; 4] = [0.02, 0.06, 0.2, 0.6];
/// Most ripples.
const MOST_RIPPLES: usize = 2;

/// A term of friction that may be added: the arm's terms with it, still without effect, and the numbers
/// that it makes free: its amplitude first, and what else it has.
pub(super) struct LawTrial {
    terms: DryTerms,
    amplitude: Vec<Parameter>,
    shape: Parameter,
}

impl LawTrial {
    /// Puts the term into the fit, all of it free.
    pub(super) fn put_into(&self, fit: &mut Fit) {
        fit.body.arm.dry_terms = self.terms.clone();
        fit.free.extend(&self.amplitude);
        fit.free.push(self.shape);
    }
}

/// The trial that one step of a search promises to take most of the cost with, and that promise.
pub(super) fn best(fitting: &Fitting<'_>, fit: &Fit) -> Option<(LawTrial, Vec<Extension>)> {
    let promise = |trial: LawTrial| {
        let mut with = fit.clone();
        with.body.arm.dry_terms = trial.terms.clone();
        let found = evidence::promise(fitting, &with, &trial.amplitude);
        (trial, found)
    };
    let share = |found: &[Extension]| found.first().map_or(0.0, |e| e.share);
    let all = trials(fitting, fit).into_iter().map(promise);
    all.max_by(|a, b| share(&a.1).total_cmp(&share(&b.1)))
}

fn trials(fitting: &Fitting<'_>, fit: &Fit) -> Vec<LawTrial> {
    let terms = &fit.body.arm.dry_terms;
    let mut found = Vec::new();
    if terms.near_rest.is_none() {
        let fastest = fastest_rad_s(fitting.campaign);
        let seen = fitting.law.iter().filter_map(|term| match term {
            LawTerm::NearRest { speed } => Some(*speed),
            _ => None,
        });
        for speed_rad_s in seen.chain(NEAR_REST.map(|share| share * fastest)) {
            let near_rest = Some(NearRest { torque_nm: 0.0, speed_rad_s });
            found.push(LawTrial {
                terms: DryTerms { near_rest, ..terms.clone() },
                amplitude: vec![Parameter::NearRest],
                shape: Parameter::NearRestSpeed,
            });
        }
    }
    let new = terms.ripples.len();
    let known = |k: f64| terms.ripples.iter().any(|r| (r.per_rad / k).ln().abs() < SQRT_2.ln());
    for term in fitting.law.iter().filter(|_| new < MOST_RIPPLES) {
        let LawTerm::Ripple { per_angle } = *term else { continue };
        if known(per_angle) {
            continue;
        }
        let mut terms = terms.clone();
        terms.ripples.push(Ripple { per_rad: per_angle, cosine_nm: 0.0, sine_nm: 0.0 });
        found.push(LawTrial {
            terms,
            amplitude: vec![Parameter::RippleCosine(new), Parameter::RippleSine(new)],
            shape: Parameter::RippleRate(new),
        });
    }
    found
}
