//! Terms that a model does not have: what they would change, and what follows for the estimates.

use crate::identify::estimate::Estimate;
use crate::identify::methods::friction_law::candidates::MissingKind;
use crate::identify::methods::friction_law::thresholds::WIDENED_MOST;
use crate::identify::methods::regression::{PLACE_COULOMB, PLACE_INERTIA, PLACE_VISCOUS, Solution};

/// An effect that the logs show and the model does not contain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MissingTerm {
    /// The effect.
    pub kind: MissingKind,
    /// Its coefficient: stiffness \[N·m/rad or N/m\]; m·g·l of gravity \[N·m\]; time of the beam's damping \[s\]; half the
    /// relative difference of the torque constant for positive and negative commands \[1\]; friction per torque of the motor
    /// \[1\]; change of friction from the middle of the travel to its ends \[N·m or N\]; change of Coulomb friction \[N·m or N\]
    /// or viscous friction \[N·m·s/rad or N·s/m\] from the beginning of the campaign to its end, with the runs one after the
    /// other.
    pub value: f64,
    /// Changes of the estimates of inertia, viscous and Coulomb friction when the term is added.
    pub moves: [Moved; 3],
    /// Improvement of the prediction of blocks that were left out, in standard errors \[1\].
    pub standard_errors: f64,
    /// Residual with the term divided by the residual without it \[1\].
    pub residual_ratio: f64,
}

/// Change of an estimate when a term is added.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Moved {
    /// Change as a share of the estimate without the term \[1\].
    pub share: f64,
    /// Change in standard errors of the estimate without the term \[1\].
    pub standard_errors: f64,
}

impl Moved {
    /// Of inertia, viscous and Coulomb friction, from a solution to one with further terms.
    pub(crate) fn between(without: &Solution, with: &[f64]) -> [Self; 3] {
        [PLACE_INERTIA, PLACE_VISCOUS, PLACE_COULOMB].map(|i| {
            let change = with[i] - without.value[i];
            let std = without.covariance[(i, i)].max(0.0).sqrt();
            Self { share: change / without.value[i], standard_errors: change / std }
        })
    }
}

/// An estimate that terms which are not known to be absent would change: `by` gives the change by each of `moves`. The largest
/// that is more than one standard error widens the interval, up to [`WIDENED_MOST`] of the value.
pub(crate) fn widened(e: Estimate, moves: &[Vec<f64>], by: impl Fn(&Vec<f64>) -> f64) -> Estimate {
    let most = moves.iter().map(|m| by(m).abs()).fold(0.0, f64::max);
    let std = if most > e.std { e.std.hypot(most) } else { e.std };
    Estimate { std: e.std.max(std.min(WIDENED_MOST * e.value.abs())), ..e }
}
