//! Truncated models of a distributed beam, in the form (17)-(18).

use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

use super::modal_form::{ModalForm, completed};
use super::response::BeamResponse;
use super::{BeamError, DistributedBeam, Mode};

/// `Θ̈ = Â·Θ + B̂·θ_m` (17), `C_t = Ĥ·Θ + ĥ·θ_m` (18): the first N_v modes seen at N_v points.
///
/// With r_ik the share of mode k in θ_i/θ_m, the exact response is `Σ_k r_ik·ω_k²/(s² + ω_k²)` over
/// all modes, the shares adding up to one. Cutting the sum off leaves a gain at zero frequency of
/// less or more than one: 14 % too much for the tip of a uniform cantilever with one mode. Here the
/// shares of all modes left out are given to the last one kept. The gain at zero frequency is then
/// one exactly, poles and residues of the other modes stay exact, and the relative degree stays two,
/// which adding the missing part as a constant would lose. Then Â·1 + B̂ = 0: turning the arm as
/// one body strains nothing.
///
/// The torque keeps the exact residues of the modes kept. What the modes left out carry of the
/// inertia follows the motor as one body: [`residual_inertia_kg_m2`](Self::residual_inertia_kg_m2)
/// is to be added to the motor's J, and the torque is then exact at low frequencies.
///
/// # Source
/// `[Feliu1989, eqs. (17), (18), Section 4]`
///
/// # Differences from the source
/// The report truncates without saying how; the static correction and the residual inertia are
/// added.
#[derive(Debug, Clone, PartialEq)]
pub struct TruncatedBeam {
    /// Points measured, distances from the axis \[m\].
    pub points_m: Vec<f64>,
    /// ω_k, the poles kept \[rad/s\].
    pub natural_frequencies_rad_s: Vec<f64>,
    /// Â, N_v × N_v \[1/s²\].
    pub a: DMatrix<f64>,
    /// B̂ \[1/s²\].
    pub b: DVector<f64>,
    /// Ĥ \[N·m/rad\].
    pub h: DVector<f64>,
    /// ĥ_{n+1} \[N·m/rad\]; ΣĤ + ĥ = 0.
    pub h_motor: f64,
    /// Inertia about the axis that the modes kept do not carry \[kg·m²\].
    pub residual_inertia_kg_m2: f64,
    /// Shares r_ik with the correction in the last column, points × modes \[1\].
    shares: DMatrix<f64>,
    /// Γ_k² \[kg·m²\].
    inertias: Vec<f64>,
}

/// Points whose shares are dependent to this are refused.
const DEPENDENT: f64 = 1e-10;

impl TruncatedBeam {
    fn new(modes: &[Mode], points_m: Vec<f64>, inertia: f64) -> Result<Self, BeamError> {
        let n = modes.len();
        let shares = completed(DMatrix::from_fn(n, n, |i, k| modes[k].share[i]));
        let values = shares.singular_values();
        let condition = values.min() / values.max();
        if condition.is_nan() || condition < DEPENDENT {
            return Err(BeamError::PointsTooClose { condition });
        }
        let inverse =
            shares.clone().try_inverse().ok_or(BeamError::PointsTooClose { condition })?;
        let squares = DVector::from_fn(n, |k, _| modes[k].natural_frequency_rad_s.powi(2));
        let coupling = DVector::from_fn(n, |k, _| modes[k].inertia_kg_m2 * squares[k]);
        let ModalForm { a, b, h, h_motor } = ModalForm::new(&shares, &inverse, &squares, &coupling);
        let carried: f64 = modes.iter().map(|m| m.inertia_kg_m2).sum();
        Ok(Self {
            points_m,
            natural_frequencies_rad_s: modes.iter().map(|m| m.natural_frequency_rad_s).collect(),
            a,
            b,
            h,
            h_motor,
            residual_inertia_kg_m2: inertia - carried,
            inertias: modes.iter().map(|m| m.inertia_kg_m2).collect(),
            shares,
        })
    }

    /// θ_i/θ_m of every point and C_t/θ_m, at `s` \[1/s\]; the torque without the residual inertia.
    pub fn response(&self, s: Complex64) -> BeamResponse {
        let n = self.inertias.len();
        let square = |k: usize| self.natural_frequencies_rad_s[k].powi(2);
        let low: Vec<Complex64> = (0..n).map(|k| square(k) / (s * s + square(k))).collect();
        BeamResponse {
            angles: (0..n).map(|i| (0..n).map(|k| low[k] * self.shares[(i, k)]).sum()).collect(),
            coupling_nm_per_rad: (0..n).map(|k| s * s * low[k] * self.inertias[k]).sum(),
        }
    }
}

impl DistributedBeam {
    /// The first `points_m.len()` modes seen at as many points, distances from the axis in
    /// ascending order \[m\].
    ///
    /// # Errors
    /// [`BeamError::PointsTooClose`] where the modes look alike at these points: the report's
    /// condition that the numerators be independent.
    pub fn truncated(&self, points_m: &[f64]) -> Result<TruncatedBeam, BeamError> {
        let modes = self.modes(points_m.len(), points_m);
        if modes.is_empty() {
            return Err(BeamError::PointsTooClose { condition: 0.0 });
        }
        TruncatedBeam::new(&modes, points_m.to_vec(), self.inertia_kg_m2())
    }
}
