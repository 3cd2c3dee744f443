//! The residual torque of the motor's equation, and its likely origin.

use nalgebra::DVector;

use crate::identify::methods::regression::motor_columns::{DRY, PLACE_COULOMB};
use crate::identify::methods::regression::normal::{Cluster, Solution, Term};
use crate::identify::methods::regression::thresholds::{
    BETWEEN_OVER_NOISE, LEFT_BETWEEN_PHASES, LEFT_BY_NOISE, VARIATION_REPORTED,
};

/// Neighbouring windows overlap: the noise of so many rows is the same.
const ROWS_ALIKE: f64 = 4.0;

/// Composition of the residual torque of the motor's equation. Shares are of its squares, summed over the windows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LeftTorque {
    /// Expected share of sensor noise, including that of a measured command \[1\]; at most 1.
    pub by_noise: f64,
    /// Expected share of the noise of the command alone \[1\]. It may be above 1 if a control
    /// loop causes a part of that noise.
    pub by_command: f64,
    /// Share of the remainder that is constant within each slip phase \[1\].
    pub between_phases: f64,
    /// Squares of these constants, relative to the expected contribution of noise \[1\].
    pub between_over_noise: f64,
    /// Root mean square of these constants, weighted with time, as a share of Coulomb friction \[1\].
    pub varies_by: f64,
}

impl LeftTorque {
    /// Of the `solution` for `terms`.
    pub(super) fn of(clusters: &[Cluster], terms: &[Term], solution: &Solution) -> Self {
        let (mut all, mut by_noise, mut between, mut noise_between, mut time) =
            (0.0, 0.0, 0.0, 0.0, 0.0);
        let mut by_command = 0.0;
        for cluster in clusters.iter().filter(|c| c.rows > 0) {
            let left = Left::of(cluster, terms, &solution.value);
            all += left.square;
            by_noise += left.noise;
            by_command += left.noise_of_command;
            between += left.with_dry * left.with_dry / left.dry.max(f64::MIN_POSITIVE);
            noise_between += left.noise * (ROWS_ALIKE / cluster.rows as f64).min(1.0);
            time += left.dry;
        }
        let all = all.max(f64::MIN_POSITIVE);
        let coulomb = solution.value[PLACE_COULOMB].abs().max(f64::MIN_POSITIVE);
        let beyond = (all - by_noise).max(0.01 * all);
        Self {
            by_noise: (by_noise / all).min(1.0),
            by_command: by_command / all,
            between_phases: (between / beyond).min(1.0),
            between_over_noise: between / noise_between.max(f64::MIN_POSITIVE),
            varies_by: (between / time.max(f64::MIN_POSITIVE)).sqrt() / coulomb,
        }
    }

    /// Whether most of the residual is sensor noise.
    pub fn is_noise(&self) -> bool {
        self.by_noise > LEFT_BY_NOISE && !self.is_between_phases()
    }

    /// Whether a large part of the residual is friction, or a load, that changes from one slip phase to the next.
    pub fn is_between_phases(&self) -> bool {
        self.between_phases > LEFT_BETWEEN_PHASES
            && self.between_over_noise > BETWEEN_OVER_NOISE
            && self.varies_by > VARIATION_REPORTED
    }
}

/// What a cluster's rows leave: its square, what noise adds to that, and its product with the column of a constant torque.
struct Left {
    square: f64,
    noise: f64,
    noise_of_command: f64,
    with_dry: f64,
    dry: f64,
}

impl Left {
    fn of(cluster: &Cluster, terms: &[Term], value: &DVector<f64>) -> Self {
        let right = cluster.products.ncols() - 1;
        // The coefficient of each column, −1 of the right side.
        let mut by_column = DVector::zeros(right + 1);
        by_column[right] = -1.0;
        for (term, value) in terms.iter().zip(value.iter()) {
            by_column[term.column()] += term.factor(cluster.sign) * value;
        }
        let square = |of: &nalgebra::DMatrix<f64>| by_column.dot(&(of * &by_column));
        Self {
            square: square(&cluster.products).max(0.0),
            noise: square(&cluster.noise).max(0.0),
            noise_of_command: cluster.noise[(right, right)],
            with_dry: cluster.products.row(DRY).transpose().dot(&by_column),
            dry: cluster.products[(DRY, DRY)],
        }
    }
}
