//! Terms that a model does not have: what they would change, and what follows for the estimates.

use crate::identify::estimate::Estimate;
use crate::identify::methods::friction_law::candidates::{MissingKind, ModelTerm};
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

/// A term that is not known to be absent, with the change of each estimate of the line when it is added.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PossibleTerm {
    pub(crate) term: ModelTerm,
    pub(crate) change: Vec<f64>,
}

/// A term that is not known to be absent and would change estimates by many of their standard errors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MovingTerm {
    /// The term.
    pub term: ModelTerm,
    /// Changes of the estimates of inertia, viscous and Coulomb friction when the term is added; the standard errors are those
    /// without it.
    pub moves: [Moved; 3],
}

impl MovingTerm {
    /// Of estimates of inertia, viscous and Coulomb friction.
    pub(crate) fn of(possible: &PossibleTerm, estimates: [Option<Estimate>; 3]) -> Self {
        let places = [PLACE_INERTIA, PLACE_VISCOUS, PLACE_COULOMB];
        let moved = |i: usize| {
            let change = possible.change[places[i]];
            estimates[i].map_or_else(Moved::default, |e| Moved {
                share: change / e.value,
                standard_errors: change / e.std,
            })
        };
        Self { term: possible.term, moves: [0, 1, 2].map(moved) }
    }
}

/// An estimate that terms which are not known to be absent would change: `by` gives the change of it by those of the line. The
/// largest that is more than one standard error widens the interval, up to [`WIDENED_MOST`] of the value, or of a larger `size`.
pub(crate) fn widened(
    e: Estimate,
    size: f64,
    possible: &[PossibleTerm],
    by: impl Fn(&[f64]) -> f64,
) -> Estimate {
    let most = possible.iter().map(|p| by(&p.change).abs()).fold(0.0, f64::max);
    let std = if most > e.std { e.std.hypot(most) } else { e.std };
    Estimate { std: e.std.max(std.min(WIDENED_MOST * size.max(e.value.abs()))), ..e }
}
