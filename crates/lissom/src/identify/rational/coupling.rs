//! Inertia, viscous friction and coupling by a beam's poles, with what the poles' errors do to them.

use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

use super::motor::Rows;
use super::{Damping, MotorData, Pole, SharedPoles};

/// J, V and c_k, which have the shape of [`coupled`]: without damping within the beam, of `K/G = J·s² + V·s + Σ c_k(s² + 2ζ_kω_k·s)/(s² + 2ζ_kω_k·s + ω_k²)`.
pub(crate) struct CouplingFit {
    /// J, V, then c_k of each pole.
    pub(crate) value: DVector<f64>,
    /// Their covariance where the poles are known, from the responses' deviations, stretched where more is
    /// left.
    pub(crate) covariance: DMatrix<f64>,
    /// Their slopes by the poles' unknowns, in the order of [`SharedPoles::covariance`].
    pub(crate) by_poles: DMatrix<f64>,
    /// Root mean square of the residuals in the responses' deviations, the unknowns counted.
    pub(crate) weighted_rms: f64,
}

/// Step 6(c): the torque per angle is linear in J, V and c_k once the poles are known. `None` where the
/// frequencies are too few, or a response is zero.
///
/// `beyond` are poles that stand for modes above the frequencies measured: they carry torque within them, and
/// below them turn with the motor, so that J has c/ω² of each.
///
/// # Source
/// `[Feliu1989, Section 4, step 6(c)]`
pub(crate) fn fit_coupling(
    data: &MotorData,
    fit: &SharedPoles,
    beyond: &[Pole],
) -> Option<CouplingFit> {
    let poles: Vec<Pole> = fit.poles.iter().chain(beyond).copied().collect();
    let shape = |k: usize, w: f64| {
        let within = if k < fit.poles.len() { fit.damping_within(k) } else { 0.0 };
        coupled(&poles[k], within, w)
    };
    let rows = Rows::of_shapes(data, poles.len(), 0.0, shape)?;
    let (value, inverse) = rows.solved()?;
    let left = &rows.b - &rows.a * &value;
    let free = rows.b.len() - value.len();
    // Either part of a response has 1/√2 of its deviation.
    let weighted_rms = (2.0 * left.norm_squared() / free as f64).sqrt();
    let covariance = &inverse * (0.5 * weighted_rms.max(1.0).powi(2));
    let unknowns = fit.damping.unknowns();
    let mut by_poles = DMatrix::zeros(value.len(), fit.poles.len() * unknowns);
    for k in 0..fit.poles.len() {
        for unknown in 0..unknowns {
            // q = (AᵀA)⁻¹·Aᵀb: dq = (AᵀA)⁻¹·(dAᵀ·(b − A·q) − Aᵀ·dA·q), dA in column 2 + k alone.
            let slope = slope(data, &rows.weights, fit, k, unknown);
            let mut right = rows.a.tr_mul(&slope) * -value[2 + k];
            right[2 + k] += slope.dot(&left);
            by_poles.set_column(k * unknowns + unknown, &(&inverse * right));
        }
    }
    let figures = 2 + fit.poles.len();
    let within = DMatrix::from_fn(figures, value.len(), |i, j| match j.checked_sub(figures) {
        Some(b) if i == 0 => beyond[b].omega_rad_s.powi(-2),
        _ => f64::from(i == j),
    });
    let (value, by_poles) = (&within * value, &within * by_poles);
    let covariance = &within * covariance * within.transpose();
    let sound = value.iter().chain(&by_poles).all(|v| v.is_finite()) && weighted_rms.is_finite();
    sound.then_some(CouplingFit { value, covariance, by_poles, weighted_rms })
}

/// Torque per angle and c_k of a mode, `(1 + 2ζ_w·s/ω)·(s² + 2(ζ − ζ_w)ω·s)/(s² + 2ζω·s + ω²)`: ζ_w of its damping
/// is within the beam.
pub(crate) fn coupled(pole: &Pole, within: f64, omega_rad_s: f64) -> Complex64 {
    let w = pole.omega_rad_s;
    let through = Complex64::new(1.0, 2.0 * within * omega_rad_s / w);
    through * (1.0 - through * (w * w) / pole.denominator(omega_rad_s))
}

/// Column of pole k by ln ω_k, or by ζ_k.
fn slope(
    data: &MotorData,
    weights: &[f64],
    fit: &SharedPoles,
    k: usize,
    unknown: usize,
) -> DVector<f64> {
    let (pole, square) = (fit.poles[k], fit.poles[k].omega_rad_s.powi(2));
    let at = |omega: f64| {
        let share = square / pole.denominator(omega);
        let turned = Complex64::new(0.0, 2.0 * pole.omega_rad_s * omega) / square;
        match unknown {
            0 => -share * (2.0 - share * (2.0 + pole.damping_ratio * turned)),
            _ => share * share * turned,
        }
    };
    debug_assert!(unknown == 0 || fit.damping != Damping::None);
    let each = data.omega_rad_s.iter().zip(weights);
    let parts = each.flat_map(|(&omega, weight)| {
        let z = at(omega) * *weight;
        [z.re, z.im]
    });
    DVector::from_iterator(2 * weights.len(), parts)
}
