//! Rational models fitted to responses, with any number of modes: the beam as (36), the motor as (35).

mod at_once;
mod beam;
#[cfg(test)]
mod beam_tests;
mod columns;
mod coupling;
mod evidence;
mod fit_covariance;
mod motor;
#[cfg(test)]
mod motor_tests;
mod origin;
mod pole_damping;
mod products;
mod refine;
mod relocate;
mod shared_poles;
mod shared_poles_error;
mod weighted;

pub(crate) use at_once::fit_at_once;
pub use beam::{BeamFit, TipData, TipForm, fit_beam};
pub(crate) use coupling::{CouplingFit, coupled, fit_coupling};
pub use evidence::fit_shared_poles_by_evidence;
pub(crate) use evidence::fit_shared_poles_with_delays;
pub(crate) use motor::fit_motor_at;
pub use motor::{MotorData, MotorFit, fit_motor};
pub use origin::without_origin;
pub use pole_damping::Damping;
pub use shared_poles::{SharedPoles, Spurious, fit_shared_poles};
pub use shared_poles_error::SharedPolesError;

use num_complex::Complex64;

use crate::identify::estimate::ModeEstimate;

/// A pair of poles, `s² + 2ζω·s + ω²`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pole {
    /// Undamped natural frequency ω \[rad/s\].
    pub omega_rad_s: f64,
    /// Damping ratio ζ \[1\].
    pub damping_ratio: f64,
}

impl Pole {
    /// Of a mode.
    pub(crate) fn of_mode(mode: &ModeEstimate) -> Self {
        Self {
            omega_rad_s: mode.natural_frequency_rad_s.value,
            damping_ratio: mode.damping_ratio.value,
        }
    }

    /// Value of `s² + 2ζω·s + ω²` at `s = jω_0`, with ω_0 = `omega_rad_s`.
    pub fn denominator(&self, omega_rad_s: f64) -> Complex64 {
        let w = self.omega_rad_s;
        Complex64::new(
            w * w - omega_rad_s * omega_rad_s,
            2.0 * self.damping_ratio * w * omega_rad_s,
        )
    }

    /// Coefficients in descending powers of s.
    pub fn polynomial(&self) -> [f64; 3] {
        let w = self.omega_rad_s;
        [1.0, 2.0 * self.damping_ratio * w, w * w]
    }
}

/// Standard error of the real and of the imaginary part of a response, relative to the standard error of the response.
///
/// It is the root mean square of the weighted residuals, `weighted_rms`, but at least 1/√2, which follows from the standard
/// error of the response alone.
pub(crate) fn part_error(weighted_rms: f64) -> f64 {
    weighted_rms.max(std::f64::consts::FRAC_1_SQRT_2)
}

/// Product of all pole pairs, descending powers.
pub(crate) fn common_denominator(poles: &[Pole]) -> Vec<f64> {
    poles.iter().fold(vec![1.0], |p, pole| crate::lti::multiply(&p, &pole.polynomial()))
}

/// Product of all pole pairs but the one at `left_out`.
pub(crate) fn others(poles: &[Pole], left_out: usize) -> Vec<f64> {
    let rest: Vec<Pole> =
        poles.iter().enumerate().filter(|(k, _)| *k != left_out).map(|(_, p)| *p).collect();
    common_denominator(&rest)
}

/// Frequencies tried as the start of a new pole, logarithmic over the data and by a factor of 1.5
/// beyond either end.
pub(crate) fn trial_frequencies(omega: &[f64]) -> Vec<f64> {
    const TRIALS: i32 = 160;
    let low = omega.iter().copied().fold(f64::INFINITY, f64::min) / 1.5;
    let high = omega.iter().copied().fold(0.0, f64::max) * 1.5;
    (0..=TRIALS).map(|k| low * (high / low).powf(f64::from(k) / f64::from(TRIALS))).collect()
}

/// Bayesian information criterion for `n` real residuals of sum of squares `cost` and `p`
/// parameters, the noise level unknown.
pub(crate) fn information(n: usize, p: usize, cost: f64) -> f64 {
    let n = n as f64;
    n * (cost.max(f64::MIN_POSITIVE) / n).ln() + p as f64 * n.ln()
}
