//! Terms of friction beyond Coulomb and viscous friction, tried if the residual is above the noise.

use crate::drive::Falloff;
use crate::identify::methods::friction_law::LawTerm;
use crate::identify::methods::friction_law::thresholds::NEAR_REST_MOST;
use crate::identify::methods::output_error::engine::windows::{fastest_rad_s, travel};
use crate::identify::methods::output_error::model::fit::{ArmFit, Extension};
use crate::identify::methods::output_error::model::fitting::Fitting;
use crate::identify::methods::output_error::moves::scores::{scores, share};
use crate::identify::methods::output_error::thresholds::{
    NEAR_REST_SPEEDS, RESIDUAL_FAR_ABOVE_NOISE, RIPPLE_PERIODS, RIPPLES_MOST,
};
use crate::replay::{DryTerms, FrictionNumber, Parameter};

/// Periods of ripples whose scores come from one replay.
const AT_ONCE: usize = 8;

/// A term of friction that may be added: the arm's terms with it, still without effect, and the parameters that it
/// adds, its torques and others.
pub(crate) struct LawTrial {
    terms: DryTerms,
    torques: Vec<Parameter>,
    shapes: Vec<Parameter>,
}

impl LawTrial {
    /// `terms` with one more.
    fn of(terms: &DryTerms, term: LawTerm) -> Self {
        let (known, mut terms) = (terms.numbers(), terms.clone());
        term.put_into(&mut terms, term.without_effect());
        let new = terms.numbers().into_iter().filter(|n| !known.contains(n));
        let (torques, shapes): (Vec<_>, Vec<_>) = new.partition(|n| n.is_torque());
        let free = |numbers: Vec<FrictionNumber>| {
            numbers.into_iter().map(Parameter::Friction).collect::<Vec<_>>()
        };
        Self { terms, torques: free(torques), shapes: free(shapes) }
    }

    /// Adds the term to the fit, with all of its parameters free.
    pub(crate) fn put_into(&self, fit: &mut ArmFit) {
        fit.body.arm.dry_terms = self.terms.clone();
        fit.free.extend(&self.torques);
        fit.free.extend(&self.shapes);
    }
}

/// The term whose first step is expected to lower the cost most, with its expected values.
///
/// Ripples at periods that slip phases did not show are tried if no other term is expected to lower the cost by more
/// than the share `least`.
pub(crate) fn best(
    fitting: &Fitting<'_>,
    fit: &ArmFit,
    least: f64,
) -> Option<(LawTrial, Vec<Extension>)> {
    let promise = |trial: LawTrial| {
        let mut with = fit.clone();
        with.body.arm.dry_terms = trial.terms.clone();
        let found = scores(fitting, &with, std::slice::from_ref(&trial.torques)).concat();
        (trial, found)
    };
    let all = trials(fitting, fit).into_iter().map(promise);
    let best = all.max_by(|a, b| share(&a.1).total_cmp(&share(&b.1)));
    if best.as_ref().is_some_and(|b| share(&b.1) > least) {
        return best;
    }
    let terms = &fit.body.arm.dry_terms;
    let open =
        terms.ripples.len() < RIPPLES_MOST && fitting.beyond_noise(fit) > RESIDUAL_FAR_ABOVE_NOISE;
    let found = open.then(|| strongest_ripple(fitting, fit)).flatten()?;
    Some(promise(LawTrial::of(terms, LawTerm::Ripple { per_angle: found })))
}

/// Whether friction near rest falls off within the speeds that the logs contain, as of the law by slip phases.
pub(crate) fn is_within_data(fitting: &Fitting<'_>, fit: &ArmFit) -> bool {
    let most = NEAR_REST_MOST * fastest_rad_s(fitting.campaign);
    fit.body.arm.dry_terms.near_rest.is_none_or(|near| near.speed_rad_s <= most)
}

/// Waves per angle of the ripple that is expected to lower the cost most, among the periods that the travel can
/// distinguish.
fn strongest_ripple(fitting: &Fitting<'_>, fit: &ArmFit) -> Option<f64> {
    let travel = travel(fitting.campaign);
    if travel <= 0.0 {
        return None;
    }
    let half_wave = std::f64::consts::PI / travel;
    let all: Vec<f64> = (2..2 + RIPPLE_PERIODS).map(|waves| waves as f64 * half_wave).collect();
    let affordable = |_: &&[f64]| !fitting.budget.is_spent();
    let promised = all.chunks(AT_ONCE).take_while(affordable).flat_map(|some| {
        let mut with = fit.clone();
        let one = |per_angle: &f64| {
            let terms = &mut with.body.arm.dry_terms;
            let trial = LawTrial::of(terms, LawTerm::Ripple { per_angle: *per_angle });
            *terms = trial.terms;
            trial.torques
        };
        let groups: Vec<_> = some.iter().map(one).collect();
        let found = scores(fitting, &with, &groups);
        some.iter().copied().zip(found).collect::<Vec<_>>()
    });
    promised.max_by(|a, b| share(&a.1).total_cmp(&share(&b.1))).map(|(k, _)| k)
}

/// Terms that slip phases show, and friction near standstill over a few speeds.
fn trials(fitting: &Fitting<'_>, fit: &ArmFit) -> Vec<LawTrial> {
    let terms = &fit.body.arm.dry_terms;
    let fastest = fastest_rad_s(fitting.campaign);
    let falloff = Falloff::Exponential;
    let listed =
        NEAR_REST_SPEEDS.map(|share| LawTerm::NearRest { speed: share * fastest, falloff });
    let open = |term: &LawTerm| term.may_join(terms, RIPPLES_MOST);
    let seen = fitting.law.iter().map(|term| match *term {
        LawTerm::NearRest { speed, .. } => LawTerm::NearRest { speed, falloff },
        term => term,
    });
    let all = seen.chain(listed).filter(open);
    all.map(|term| LawTrial::of(terms, term)).collect()
}
