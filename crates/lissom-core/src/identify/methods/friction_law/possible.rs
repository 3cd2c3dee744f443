//! Which models a joint and its drive may have, whatever they predict.

use nalgebra::DVector;

use crate::identify::methods::friction_law::candidates::{Candidate, MissingKind, ModelTerm};
use crate::identify::methods::friction_law::choice::Search;
use crate::identify::methods::friction_law::law_term::LawTerm;
use crate::identify::methods::friction_law::thresholds::LAG_MOST_S;
use crate::identify::methods::regression::{PLACE_COULOMB, PLACE_INERTIA, PLACE_VISCOUS, Solution};
use crate::identify::thresholds::{LAG_HALF_SAMPLE, SIGN_SHOWN};
use crate::record::Hold;

impl Search<'_> {
    /// Whether a joint may have such a model: friction brakes at rest and at speed, Coulomb friction and its standard error are
    /// less than the largest torque, the inertia is positive, and a lag is not longer than a drive's.
    pub(super) fn is_possible(&self, solution: &Solution, terms: &[&Candidate]) -> bool {
        let n = solution.value.len();
        let not_negative = |weight: &DVector<f64>| {
            let (value, std) = known(solution, weight);
            value > -SIGN_SHOWN * std
        };
        let unit = |place: usize| DVector::from_fn(n, |i, _| f64::from(i == place));
        let least = unit(PLACE_COULOMB);
        let (mut at_rest, mut viscous, mut apart) = (least.clone(), unit(PLACE_VISCOUS), None);
        let mut first = self.line;
        let mut possible = true;
        let coulomb = solution.value[PLACE_COULOMB].abs();
        for term in terms {
            let own = &solution.value.rows(first, term.columns.len());
            match term.term {
                ModelTerm::Law(LawTerm::NearRest { .. }) => at_rest[first] = 1.0,
                ModelTerm::Law(LawTerm::ViscousByDirection) => apart = Some(first),
                ModelTerm::Law(LawTerm::WithLoad { .. }) => possible &= own[0] > 0.0,
                ModelTerm::Law(LawTerm::Ripple { .. }) => {
                    possible &= own[0].hypot(own[1]) < coulomb;
                }
                ModelTerm::Law(LawTerm::CommandLag) => {
                    possible &= self.is_lag(-own[0]);
                }
                ModelTerm::Missing(kind @ (MissingKind::WithTorque | MissingKind::BeamDamping)) => {
                    let own: Vec<f64> = own.iter().copied().collect();
                    possible &= self.coefficient(kind, &own, &self.solution) > 0.0;
                }
                ModelTerm::Law(LawTerm::Root | LawTerm::TorqueRipple { .. })
                | ModelTerm::Missing(_) => {}
            }
            first += term.columns.len();
        }
        if let Some(apart) = apart {
            viscous[apart] = -solution.value[apart].signum();
        }
        possible
            && solution.value[PLACE_INERTIA] > 0.0
            && solution.value[PLACE_COULOMB] < self.largest_torque
            && not_negative(&viscous)
            && known(solution, &least).1 < self.largest_torque
            && not_negative(&least)
            && not_negative(&at_rest)
    }

    /// Whether a drive may have a lag of this time. A command that a controller holds acts no earlier than it is logged, but for
    /// the half sample of one that is measured.
    fn is_lag(&self, lag_s: f64) -> bool {
        let held = self.sampled.campaign.channels.command.hold == Hold::Sampled;
        let early = lag_s / self.sample_s + 0.5;
        let possible = lag_s > 0.0 || !held || early.abs() < 0.5 * LAG_HALF_SAMPLE;
        possible && lag_s.abs() < LAG_MOST_S
    }
}

/// A weighted sum of the estimates, with its standard error.
fn known(solution: &Solution, weight: &DVector<f64>) -> (f64, f64) {
    let variance = weight.dot(&(&solution.covariance * weight));
    (weight.dot(&solution.value), variance.max(0.0).sqrt())
}
