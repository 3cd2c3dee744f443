//! Truncated models of a distributed beam, in the form (17)-(18).

use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

use super::modal_form::{ModalForm, completed};
use super::response::BeamResponse;
use super::{BeamError, DistributedBeam, Mode};

/// A truncated model of a distributed beam, its first N_v modes at N_v points: `Θ̈ = Â·Θ + B̂·θ_m` (17),
/// `C_t = Ĥ·Θ + ĥ·θ_m` (18).
///
/// With the share r_ik of mode k in θ_i/θ_m, the exact response is `Σ_k r_ik·ω_k²/(s² + ω_k²)` over all modes, and the
/// shares of a point add up to one. If the sum is cut off, the gain at zero frequency is no longer one: it is 14 % too
/// large for the tip of a uniform cantilever with one mode. Therefore the last mode that is kept receives the shares of
/// all modes that are left out. The gain at zero frequency is then exactly one, poles and residues of the other modes
/// stay exact, and the relative degree stays two (a constant for the missing part would change it). Also Â·1 + B̂ = 0:
/// an arm that turns as one body is not bent.
///
/// The torque keeps the exact residues of the modes that are kept. The part of the inertia that belongs to the other
/// modes follows the motor as a rigid body: add [`residual_inertia_kg_m2`](Self::residual_inertia_kg_m2) to the motor's
/// J, and the torque is exact at low frequencies.
///
/// # Source
/// `[Feliu1989, eqs. (17), (18), Section 4]`
///
/// # Differences from the source
/// The 1989 report does not say how it truncates. The static correction and the residual inertia are added here.
#[derive(Debug, Clone, PartialEq)]
pub struct TruncatedBeam {
    /// Points, as distances from the axis \[m\], ascending.
    pub points_m: Vec<f64>,
    /// ω_k of the modes that are kept \[rad/s\].
    pub natural_frequencies_rad_s: Vec<f64>,
    /// Â, N_v × N_v \[1/s²\].
    pub a: DMatrix<f64>,
    /// B̂, N_v elements \[1/s²\].
    pub b: DVector<f64>,
    /// Ĥ, N_v elements \[N·m/rad\].
    pub h: DVector<f64>,
    /// ĥ_{n+1} \[N·m/rad\]; ΣĤ + ĥ = 0.
    pub h_motor: f64,
    /// Inertia about the axis that does not belong to the modes that are kept \[kg·m²\].
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

    /// Computes θ_i/θ_m of every point, and C_t/θ_m \[N·m/rad\], at the complex frequency `s` \[1/s\]; the torque does
    /// not contain the residual inertia.
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
    /// Truncates to the first `points_m.len()` modes, at as many points: distances from the
    /// axis in ascending order \[m\].
    ///
    /// # Errors
    /// [`BeamError::PointsTooClose`] if the modes look alike at these points; the 1989 report requires that the
    /// numerators be independent.
    pub fn truncated(&self, points_m: &[f64]) -> Result<TruncatedBeam, BeamError> {
        let modes = self.modes(points_m.len(), points_m);
        if modes.is_empty() {
            return Err(BeamError::PointsTooClose { condition: 0.0 });
        }
        TruncatedBeam::new(&modes, points_m.to_vec(), self.inertia_kg_m2())
    }
}
