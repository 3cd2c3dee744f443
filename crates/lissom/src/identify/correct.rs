//! Correction of the motor's response for Coulomb friction, (30).

use std::f64::consts::PI;

use num_complex::Complex64;

use super::Estimate;
use crate::spectrum::Phasor;

/// A response with its standard deviation, `√E|Ĝ − G|²`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Response {
    /// Output per input.
    pub value: Complex64,
    /// Standard deviation, same unit.
    pub std: f64,
}

/// Ratio of two phasors with the deviation that theirs give it, taken as independent.
pub fn ratio(output: Phasor, input: Phasor) -> Response {
    let value = output.value / input.value;
    let relative =
        (output.std / output.value.norm()).powi(2) + (input.std / input.value.norm()).powi(2);
    Response { value, std: value.norm() * relative.sqrt() }
}

/// `G(ω) = θ_m/(i − j·4c/π·e^{j∠θ_m})`, with c = CF/K in the command's unit.
///
/// G in rad (or m) per command; θ_m and i are phasors at ω. The deviation counts that of both
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
/// `[Feliu1989, eq. (30)]`. It takes friction for a square wave in phase with the velocity: where
/// the joint sticks for a part of the cycle it is wrong by per cents.
pub fn corrected(motor: Phasor, command: Phasor, coulomb_command: Estimate) -> Response {
    let phase = Complex64::from_polar(1.0, motor.value.arg());
    let unit = Complex64::I * (4.0 / PI) * phase;
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
}
