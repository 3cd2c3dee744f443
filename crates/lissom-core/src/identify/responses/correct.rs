//! Correction of the motor's response for Coulomb friction (30).

use std::f64::consts::PI;

use num_complex::Complex64;

use crate::identify::estimate::Estimate;
use crate::spectrum::{Harmonics, Phasor};

/// Instants of a period at which the velocity's sign is taken.
const SAMPLES: usize = 2048;

/// A complex response with its standard error, `√E|Ĝ − G|²`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Response {
    /// Response: output per input.
    pub value: Complex64,
    /// Standard error, in the same unit.
    pub std: f64,
}

/// Ratio of two phasors; its standard error follows from theirs, which are assumed to be independent.
pub fn ratio(output: Phasor, input: Phasor) -> Response {
    let value = output.value / input.value;
    let relative =
        (output.std / output.value.norm()).powi(2) + (input.std / input.value.norm()).powi(2);
    Response { value, std: value.norm() * relative.sqrt() }
}

/// Corrects the motor's response for Coulomb friction, `G(ω) = θ_m/(i − j·4c/π·e^{j∠θ_m})`, with c = CF/K in the unit
/// of the command.
///
/// G is in rad (or m) per unit of command; θ_m and i are phasors at ω. The standard error includes those of both
/// phasors and of c.
///
/// ```
/// # use {lissom::identify::{Estimate, corrected}, lissom::spectrum::Phasor, num_complex::Complex64};
/// let g = Complex64::new(-0.3, -0.2);
/// let motor = Phasor { value: Complex64::new(0.5, 0.0), std: 0.0 };
/// let friction = Complex64::new(0.0, 4.0 * 0.1 / std::f64::consts::PI); // leads by a quarter turn
/// let command = Phasor { value: motor.value / g + friction, std: 0.0 };
/// assert!((corrected(motor, command, Estimate { value: 0.1, std: 0.0 }).value - g).norm() < 1e-14);
/// ```
///
/// # Source
/// `[Feliu1989, eq. (30)]`. It assumes that friction is a square wave in phase with the velocity. If the joint sticks
/// for part of the cycle, the result is wrong by a few percent.
pub fn corrected(motor: Phasor, command: Phasor, coulomb_command: Estimate) -> Response {
    let phase = Complex64::from_polar(1.0, motor.value.arg());
    without(Complex64::I * (4.0 / PI) * phase, motor, command, coulomb_command)
}

/// The same with the friction of a motion that is no sinusoid: of the sign of its velocity, from all
/// harmonics of the motor. `None` without a fundamental.
///
/// # Source
/// `[Feliu1989, eq. (30)]`, whose square wave changes its sign where the fundamental alone reverses.
pub(crate) fn corrected_by_harmonics(
    motor: &Harmonics,
    command: Phasor,
    coulomb_command: Estimate,
) -> Option<Response> {
    Some(without(fundamental_of_sign(motor), motor.get(1)?, command, coulomb_command))
}

/// Fundamental of the velocity's sign, of a motor with these harmonics.
fn fundamental_of_sign(motor: &Harmonics) -> Complex64 {
    let sample = |k: usize| {
        let turn =
            Complex64::from_polar(1.0, std::f64::consts::TAU * (k as f64 + 0.5) / SAMPLES as f64);
        let (mut velocity, mut wave) = (0.0, turn);
        for (h, p) in (1..).zip(&motor.phasors) {
            velocity += (Complex64::I * f64::from(h) * p.value * wave).re;
            wave *= turn;
        }
        velocity.signum() * turn.conj()
    };
    (0..SAMPLES).map(sample).sum::<Complex64>() * (2.0 / SAMPLES as f64)
}

fn without(unit: Complex64, motor: Phasor, command: Phasor, coulomb_command: Estimate) -> Response {
    let input = command.value - unit * coulomb_command.value;
    let spread = (command.std.powi(2) + (unit.norm() * coulomb_command.std).powi(2)).sqrt();
    ratio(motor, Phasor { value: input, std: spread })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn takes_the_fundamental_of_a_square_wave_away() {
        let g = Complex64::new(-0.3, -0.2);
        let motor = Phasor { value: Complex64::from_polar(0.5, 0.7), std: 0.0 };
        let friction = Complex64::I * (4.0 * 0.1 / PI) * Complex64::from_polar(1.0, 0.7);
        let command = Phasor { value: motor.value / g + friction, std: 0.0 };
        let found = corrected(motor, command, Estimate { value: 0.1, std: 0.0 });
        assert!((found.value - g).norm() < 1e-14);
    }

    #[test]
    fn further_reversals_in_a_cycle_count() {
        let phasor = |x: f64| Phasor { value: Complex64::new(0.0, -x), std: 0.0 };
        let zero = phasor(0.0);
        let of = |third: f64| Harmonics {
            omega_rad_s: 1.0,
            phasors: vec![phasor(1.0), zero, phasor(third)],
            mean: 0.0,
            drift: 0.0,
            residual_rms: 0.0,
            signal_rms: 1.0,
        };
        // The velocity cos x + 2.7·cos 3x = cos x·(10.8·cos²x − 7.1) has the sign of
        // cos x·(cos²x − cos²a), cos²a = 7.1/10.8.
        let a = (7.1f64 / 10.8).sqrt().acos();
        let expected = 4.0 / PI * (2.0 * a.sin() - 1.0);
        assert!((fundamental_of_sign(&of(0.9)) - expected).norm() < 1e-2);
        assert!((fundamental_of_sign(&of(0.0)) - 4.0 / PI).norm() < 1e-5);
    }
}
