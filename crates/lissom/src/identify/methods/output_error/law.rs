//! What friction has beyond Coulomb's, where the residual calls for it.

use std::f64::consts::SQRT_2;

use crate::drive::Falloff;
use crate::identify::methods::friction_law::LawTerm;
use crate::identify::methods::output_error::fit::{Extension, Fit};
use crate::identify::methods::output_error::fitting::Fitting;
use crate::identify::methods::output_error::scores::{scores, share};
use crate::identify::methods::output_error::windows::{fastest_rad_s, travel};
use crate::replay::{DryTerms, NearRest, Parameter, Ripple};

/// Speeds over which friction near rest is tried to change, as shares of the fastest.
const NEAR_REST: [f64; 4] = [0.02, 0.06, 0.2, 0.6];
/// Most ripples.
const MOST_RIPPLES: usize = 2;
/// Residual beside the noise from which on ripples are looked for at all periods: a mode that is missing
/// leaves less.
const FAR: f64 = 3.0;
/// Half waves over the travel, from two on, at which ripples are looked for, and how many at once.
const RIPPLES: usize = 46;
const AT_ONCE: usize = 8;

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
///
/// Ripples at frequencies that slip phases did not show are looked for where nothing else promises more
/// than the share `least`.
pub(super) fn best(
    fitting: &Fitting<'_>,
    fit: &Fit,
    least: f64,
) -> Option<(LawTrial, Vec<Extension>)> {
    let promise = |trial: LawTrial| {
        let mut with = fit.clone();
        with.body.arm.dry_terms = trial.terms.clone();
        let found = scores(fitting, &with, std::slice::from_ref(&trial.amplitude)).concat();
        (trial, found)
    };
    let all = trials(fitting, fit).into_iter().map(promise);
    let best = all.max_by(|a, b| share(&a.1).total_cmp(&share(&b.1)));
    if best.as_ref().is_some_and(|b| share(&b.1) > least) {
        return best;
    }
    let terms = &fit.body.arm.dry_terms;
    let open = terms.ripples.len() < MOST_RIPPLES && fitting.beyond_noise(fit) > FAR;
    let found = open.then(|| strongest_ripple(fitting, fit)).flatten()?;
    Some(promise(rippled(terms, found)))
}

/// Waves per angle at which a ripple promises most, over the frequencies that the travel tells apart.
fn strongest_ripple(fitting: &Fitting<'_>, fit: &Fit) -> Option<f64> {
    let travel = travel(fitting.campaign);
    if travel <= 0.0 {
        return None;
    }
    let half_wave = std::f64::consts::PI / travel;
    let all: Vec<f64> = (2..2 + RIPPLES).map(|waves| waves as f64 * half_wave).collect();
    let promised = all.chunks(AT_ONCE).flat_map(|some| {
        let mut with = fit.clone();
        let ripples = &mut with.body.arm.dry_terms.ripples;
        let first = ripples.len();
        ripples.extend(some.iter().map(|k| still(*k)));
        let groups: Vec<_> = (first..first + some.len()).map(amplitude).collect();
        let found = scores(fitting, &with, &groups);
        some.iter().copied().zip(found).collect::<Vec<_>>()
    });
    promised.max_by(|a, b| share(&a.1).total_cmp(&share(&b.1))).map(|(k, _)| k)
}

/// A ripple without effect.
fn still(per_rad: f64) -> Ripple {
    Ripple { per_rad, cosine_nm: 0.0, sine_nm: 0.0 }
}

fn amplitude(ripple: usize) -> Vec<Parameter> {
    vec![Parameter::RippleCosine(ripple), Parameter::RippleSine(ripple)]
}

/// One more ripple.
fn rippled(terms: &DryTerms, per_rad: f64) -> LawTrial {
    let new = terms.ripples.len();
    let mut terms = terms.clone();
    terms.ripples.push(still(per_rad));
    LawTrial { terms, amplitude: amplitude(new), shape: Parameter::RippleRate(new) }
}

fn trials(fitting: &Fitting<'_>, fit: &Fit) -> Vec<LawTrial> {
    let terms = &fit.body.arm.dry_terms;
    let mut found = Vec::new();
    if terms.near_rest.is_none() {
        let fastest = fastest_rad_s(fitting.campaign);
        let seen = fitting.law.iter().filter_map(|term| match term {
            LawTerm::NearRest { speed, .. } => Some(*speed),
            _ => None,
        });
        let speeds = seen.chain(NEAR_REST.map(|share| share * fastest));
        for speed_rad_s in speeds.filter(|speed| *speed > 0.0) {
            let falloff = Falloff::Exponential;
            let near_rest = Some(NearRest { torque_nm: 0.0, speed_rad_s, falloff });
            found.push(LawTrial {
                terms: DryTerms { near_rest, ..terms.clone() },
                amplitude: vec![Parameter::NearRest],
                shape: Parameter::NearRestSpeed,
            });
        }
    }
    let known = |k: f64| terms.ripples.iter().any(|r| (r.per_rad / k).ln().abs() < SQRT_2.ln());
    if terms.ripples.len() < MOST_RIPPLES {
        found.extend(fitting.law.iter().filter_map(|term| match *term {
            LawTerm::Ripple { per_angle } if !known(per_angle) => Some(rippled(terms, per_angle)),
            _ => None,
        }));
    }
    found
}
