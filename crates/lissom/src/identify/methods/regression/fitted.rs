//! A solution of the motor's equation as estimates of the drive.

use crate::identify::drive_estimates::DriveEstimates;
use crate::identify::estimate::Estimate;
use crate::identify::friction_estimates::Friction;
use crate::identify::methods::regression::normal::Solution;
use crate::identify::methods::regression::thresholds::WINDOW_SYSTEMATIC;
use crate::record::Channels;

/// Places of the terms in the equation; that of half the difference of viscous friction follows the couplings.
const PLACE_INERTIA: usize = 0;
pub(super) const PLACE_VISCOUS: usize = 1;
const PLACE_COULOMB: usize = 2;
pub(super) const PLACE_OFFSET: usize = 3;
pub(crate) const COUPLING: usize = 4;

/// A solution of the equation with what its window's length adds to the standard errors.
pub(crate) struct Fitted<'a> {
    pub(crate) solution: &'a Solution,
    /// Change of each term from the next shorter to the next longer window.
    pub(crate) change: &'a [f64],
    /// Tips whose couplings are among the terms.
    pub(crate) tips: &'a [usize],
}

impl Fitted<'_> {
    /// `Σ w_i·q_i` over pairs of a term and its weight; `None` where the logs do not tell a term of it.
    fn combined(&self, weights: &[(usize, f64)]) -> Option<Estimate> {
        let Self { solution: s, change, .. } = self;
        if weights.is_empty() || weights.iter().any(|(i, _)| s.inseparable[*i]) {
            return None;
        }
        let sum = |of: &dyn Fn(usize) -> f64| weights.iter().map(|(i, w)| w * of(*i)).sum::<f64>();
        let variance = sum(&|i| sum(&|k| s.covariance[(i, k)]));
        let systematic = WINDOW_SYSTEMATIC * sum(&|i| change[i]);
        let std = (variance.max(0.0) + systematic * systematic).sqrt();
        Some(Estimate { value: sum(&|i| s.value[i]), std })
    }

    /// All estimates; with viscous friction by direction where the solution has a term for it.
    pub(crate) fn estimates(&self, channels: &Channels) -> DriveEstimates {
        let back_emf = channels.command.back_emf_viscous;
        let without_back_emf = |e: Estimate| Estimate { value: e.value - back_emf, std: e.std };
        let viscous = |weights: &[(usize, f64)]| self.combined(weights).map(without_back_emf);
        let single = |i: usize| self.combined(&[(i, 1.0)]);
        let (count, difference) = (self.tips.len(), COUPLING + self.tips.len());
        let by_direction = (self.solution.value.len() > difference)
            .then(|| [1.0, -1.0].map(|sign| viscous(&[(PLACE_VISCOUS, 1.0), (difference, sign)])));
        let mut coupling_by_tip = vec![None; if count == 0 { 0 } else { channels.tips.len() }];
        for (i, &tip) in self.tips.iter().enumerate() {
            coupling_by_tip[tip] = single(COUPLING + i);
        }
        let coulomb = |sign: f64| self.combined(&[(PLACE_COULOMB, 1.0), (PLACE_OFFSET, sign)]);
        let friction = Friction {
            coulomb: single(PLACE_COULOMB),
            forward: coulomb(1.0),
            backward: coulomb(-1.0),
            offset: single(PLACE_OFFSET),
            viscous: viscous(&[(PLACE_VISCOUS, 1.0)]),
            viscous_by_direction: by_direction.and_then(|[f, b]| f.zip(b)),
            ..Friction::default()
        };
        let all: Vec<(usize, f64)> = (COUPLING..difference).map(|i| (i, 1.0)).collect();
        DriveEstimates {
            friction,
            inertia: single(PLACE_INERTIA),
            coupling: self.combined(&all),
            coupling_by_tip,
        }
    }
}
