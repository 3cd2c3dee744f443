//! The terms of the motor's equation together.

use nalgebra::{DMatrix, DVector};

use crate::identify::methods::regression::fitted::Fitted;
use crate::identify::methods::regression::motor_columns::{
    MotorColumns, PLACE_INERTIA, PLACE_OFFSET, PLACE_VISCOUS,
};
use crate::identify::methods::regression::thresholds::{GRAVITY_CORRELATION, GRAVITY_KNOWN};
use crate::information::correlation;

/// Terms of the motor's equation together.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Terms {
    pub(crate) values: Vec<f64>,
    pub(crate) covariance: DMatrix<f64>,
    /// Changes, up to a factor, that the logs do not show.
    pub(crate) lost: Vec<DVector<f64>>,
    pub(crate) columns: MotorColumns,
}

/// A term that may be mistaken for gravity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GravityPartner {
    /// Inertia: in a single sine of small amplitude, acceleration and angle are in proportion.
    Inertia,
    /// A constant load: over a short arc, gravity is nearly constant.
    Offset,
}

impl Terms {
    /// Those of a solution.
    pub(crate) fn of(fitted: &Fitted<'_>) -> Self {
        let s = fitted.solution;
        Self {
            values: s.value.iter().copied().collect(),
            covariance: s.covariance.clone(),
            lost: s.lost.clone(),
            columns: fitted.columns.clone(),
        }
    }

    /// Correlation of J, V and the coupling to all tips.
    pub(crate) fn drive_correlation(&self) -> DMatrix<f64> {
        let n = self.values.len();
        let couplings = self.columns.couplings();
        let sums = DMatrix::from_fn(n, 3, |i, k| {
            f64::from(match k {
                0 => i == PLACE_INERTIA,
                1 => i == PLACE_VISCOUS,
                _ => couplings.contains(&i),
            })
        });
        correlation(&(sums.transpose() * &self.covariance * &sums))
    }

    /// The terms that gravity can hardly be told from, with their correlation: about the mean angle it is a slope, which
    /// inertia may stand for, and a constant. Gravity that is known to [`GRAVITY_KNOWN`] of `amplitude` gives no pair.
    pub(crate) fn pairs_with_gravity(
        &self,
        mean_rad: f64,
        amplitude: f64,
    ) -> Vec<(GravityPartner, f64)> {
        let Some([sine, cosine]) = self.columns.gravity_places() else { return Vec::new() };
        let (sin, cos) = mean_rad.sin_cos();
        // g_s·sin θ + g_c·cos θ about the mean: slope g_s·cos θ̄ − g_c·sin θ̄, constant g_s·sin θ̄ + g_c·cos θ̄.
        let parts = [
            (GravityPartner::Inertia, PLACE_INERTIA, [cos, -sin]),
            (GravityPartner::Offset, PLACE_OFFSET, [sin, cos]),
        ];
        let covariance = &self.covariance;
        let pair = |(with, place, [by_sine, by_cosine]): (GravityPartner, usize, [f64; 2])| {
            let variance = by_sine * by_sine * covariance[(sine, sine)]
                + by_cosine * by_cosine * covariance[(cosine, cosine)]
                + 2.0 * by_sine * by_cosine * covariance[(sine, cosine)];
            let shared =
                by_sine * covariance[(sine, place)] + by_cosine * covariance[(cosine, place)];
            let correlation = shared / (variance * covariance[(place, place)]).sqrt();
            let hardly = variance.max(0.0).sqrt() > GRAVITY_KNOWN * amplitude
                && correlation.abs() > GRAVITY_CORRELATION;
            hardly.then_some((with, correlation))
        };
        parts.into_iter().filter_map(pair).collect()
    }
}
