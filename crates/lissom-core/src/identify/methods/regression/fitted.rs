//! A solution of the motor's equation as estimates of the drive.

use crate::identify::drive_estimates::DriveEstimates;
use crate::identify::estimate::Estimate;
use crate::identify::friction_estimates::Friction;
use crate::identify::gravity_estimate::Gravity;
use crate::identify::methods::regression::motor_columns::{
    MotorColumns, PLACE_COULOMB, PLACE_INERTIA, PLACE_OFFSET, PLACE_VISCOUS,
};
use crate::identify::methods::regression::normal::Solution;
use crate::identify::methods::regression::thresholds::{TELLS_SUM, WINDOW_SYSTEMATIC};
use crate::record::Channels;

/// A solution of the equation with what its window's length adds to the standard errors.
pub(crate) struct Fitted<'a> {
    pub(crate) solution: &'a Solution,
    /// Change of each term from the next shorter to the next longer window.
    pub(crate) change: &'a [f64],
    pub(crate) columns: &'a MotorColumns,
}

impl Fitted<'_> {
    /// `Σ w_i·q_i` over pairs of a term and its weight; `None` where the logs do not tell it.
    pub(crate) fn combined(&self, weights: &[(usize, f64)]) -> Option<Estimate> {
        if weights.is_empty() || !self.is_told(weights) {
            return None;
        }
        let value = weights.iter().map(|(i, w)| w * self.solution.value[*i]).sum();
        Some(Estimate { value, std: self.covariance(weights, weights).max(0.0).sqrt() })
    }

    /// Covariance of two sums of terms.
    fn covariance(&self, a: &[(usize, f64)], b: &[(usize, f64)]) -> f64 {
        let Self { solution: s, change, .. } = self;
        let systematic = |of: &[(usize, f64)]| {
            WINDOW_SYSTEMATIC * of.iter().map(|(i, w)| w * change[*i]).sum::<f64>()
        };
        let pairs = a.iter().flat_map(|(i, v)| b.iter().map(move |(k, w)| (*i, *k, v * w)));
        let scatter: f64 = pairs.map(|(i, k, weight)| weight * s.covariance[(i, k)]).sum();
        scatter + systematic(a) * systematic(b)
    }

    /// Whether no change that the logs do not show moves the sum: each term alone may be lost and their sum not.
    fn is_told(&self, weights: &[(usize, f64)]) -> bool {
        let s = self.solution;
        let lost = weights.iter().any(|(i, _)| s.inseparable[*i]);
        let moved = |change: &nalgebra::DVector<f64>| {
            let parts = weights.iter().map(|(i, w)| w * change[*i]);
            let (sum, all) = parts.fold((0.0, 0.0), |(sum, all), p| (sum + p, all + p.abs()));
            f64::abs(sum) > TELLS_SUM * all
        };
        !lost || !s.lost.iter().any(moved)
    }

    /// All estimates.
    pub(crate) fn estimates(&self, channels: &Channels) -> DriveEstimates {
        let back_emf = channels.command.back_emf_viscous;
        let without_back_emf = |e: Estimate| Estimate { value: e.value - back_emf, std: e.std };
        let viscous = |weights: &[(usize, f64)]| self.combined(weights).map(without_back_emf);
        let single = |i: usize| self.combined(&[(i, 1.0)]);
        let columns = self.columns;
        let couplings = columns.couplings();
        let mut coupling_by_tip =
            vec![None; if couplings.is_empty() { 0 } else { channels.tips.len() }];
        for (place, &tip) in couplings.clone().zip(&columns.tips) {
            coupling_by_tip[tip] = single(place);
        }
        let coulomb = |sign: f64| self.combined(&[(PLACE_COULOMB, 1.0), (PLACE_OFFSET, sign)]);
        let friction = Friction {
            coulomb: single(PLACE_COULOMB),
            forward: coulomb(1.0),
            backward: coulomb(-1.0),
            offset: single(PLACE_OFFSET),
            viscous: viscous(&[(PLACE_VISCOUS, 1.0)]),
            ..Friction::default()
        };
        let all: Vec<(usize, f64)> = couplings.map(|i| (i, 1.0)).collect();
        DriveEstimates {
            friction,
            inertia: single(PLACE_INERTIA),
            coupling: self.combined(&all),
            coupling_by_tip,
            gravity: columns.gravity_places().and_then(|places| self.gravity(places)),
        }
    }

    fn gravity(&self, places: [usize; 2]) -> Option<Gravity> {
        let [sine, cosine] = places.map(|i| self.combined(&[(i, 1.0)]));
        let [s, c] = places.map(|i| [(i, 1.0)]);
        Some(Gravity::new(sine?, cosine?, self.covariance(&s, &c)))
    }
}
