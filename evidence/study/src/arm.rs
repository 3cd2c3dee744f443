//! Random arms with sizes similar to those of real rigs.

use lissom::Error;
use lissom::beam::{Damping, LumpedBeam, Roots, Span};
use lissom::drive::Motor;
use num_complex::Complex64;

use crate::draw::Draw;

/// First frequency, motor clamped \[rad/s\].
const FIRST_RAD_S: (f64, f64) = (3.0, 40.0);
/// Inertia of the beam about the axis relative to that of the motor. The rig of the 1989 report has 2.8.
const INERTIA_RATIO: (f64, f64) = (0.3, 6.0);
/// Mass of the beam \[kg\]. The rigs of the 1989 report have 0.05 and 0.11.
const MASS_KG: (f64, f64) = (0.02, 0.3);
/// V/J, the rate at which the motor alone would run down \[1/s\]. The rig of the 1989 report has 2.2.
const RUN_DOWN_PER_S: (f64, f64) = (0.3, 10.0);
/// Torque constant \[N·m/A\]. The rig of the 1989 report has 0.25.
const TORQUE_CONSTANT: (f64, f64) = (0.05, 1.0);
/// Length of the beam \[m\]. The rigs of the 1989 report have 0.18 and 0.30.
const LENGTH_M: (f64, f64) = (0.15, 0.6);

/// A beam and a motor. With `beam_damping` the modes are damped within the beam, otherwise by dampers
/// between the masses and the fixed frame.
pub(crate) fn random_arm(
    draw: &mut Draw,
    masses: usize,
    damping_ratio: f64,
    beam_damping: bool,
) -> Result<(LumpedBeam, Motor), Error> {
    let first = draw.decade(FIRST_RAD_S.0, FIRST_RAD_S.1);
    let mut spans = random_spans(draw, masses);
    let found = LumpedBeam::new(&spans)?.natural_frequencies_rad_s()[0];
    for span in &mut spans {
        span.flexural_rigidity_n_m2 *= (first / found).powi(2);
    }
    let beam_inertia = LumpedBeam::new(&spans)?.inertia_kg_m2();
    let inertia = beam_inertia / draw.decade(INERTIA_RATIO.0, INERTIA_RATIO.1);
    let viscous = inertia * draw.decade(RUN_DOWN_PER_S.0, RUN_DOWN_PER_S.1);
    let constant = draw.decade(TORQUE_CONSTANT.0, TORQUE_CONSTANT.1);
    let motor = Motor::new(inertia, viscous, constant)?;
    if beam_damping {
        let beam = LumpedBeam::new(&spans)?;
        return Ok((beam.with_damping(Damping::Modal { ratios: vec![damping_ratio] })?, motor));
    }
    // c_i = 2ζω·m_i would damp the first mode by ζ; the dampers of a real arm differ from each other.
    for span in &mut spans {
        span.damping_n_s_per_m = 2.0 * damping_ratio * first * span.mass_kg * draw.decade(0.5, 2.0);
    }
    let found = clamped_modes(LumpedBeam::new(&spans)?.poles())[0].1;
    for span in &mut spans {
        span.damping_n_s_per_m *= damping_ratio / found;
    }
    Ok((LumpedBeam::new(&spans)?, motor))
}

/// Spans that differ from each other; their total length and mass are those of a real beam, their
/// stiffness is relative.
fn random_spans(draw: &mut Draw, masses: usize) -> Vec<Span> {
    let (length, mass) = (draw.decade(LENGTH_M.0, LENGTH_M.1), draw.decade(MASS_KG.0, MASS_KG.1));
    let mut spans: Vec<Span> = (0..masses)
        .map(|_| Span {
            length_m: draw.uniform(0.7, 1.3),
            flexural_rigidity_n_m2: draw.decade(0.7, 1.4),
            mass_kg: draw.decade(0.5, 2.0),
            damping_n_s_per_m: 0.0,
        })
        .collect();
    let lengths: f64 = spans.iter().map(|s| s.length_m).sum();
    let masses: f64 = spans.iter().map(|s| s.mass_kg).sum();
    for span in &mut spans {
        span.length_m *= length / lengths;
        span.mass_kg *= mass / masses;
    }
    spans
}

/// Natural frequency |s| \[rad/s\] and damping ratio −Re s/|s| of each mode, from the poles with the motor
/// clamped, ascending.
pub(crate) fn clamped_modes(poles: Roots) -> Vec<(f64, f64)> {
    let mut upper: Vec<Complex64> = poles.s.into_iter().filter(|s| s.im > 0.0).collect();
    upper.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
    upper.iter().map(|s| (s.norm(), -s.re / s.norm())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arms_have_the_requested_damping_and_sizes() {
        for index in 0..60 {
            let mut draw = Draw::of(5, index);
            let masses = 1 + index % 3;
            let inside = index % 2 == 0;
            let (beam, motor) = random_arm(&mut draw, masses, 0.03, inside).unwrap();
            let modes = clamped_modes(beam.poles());
            assert_eq!(modes.len(), masses);
            let (first, ratio) = modes[0];
            assert!((FIRST_RAD_S.0 * 0.99..FIRST_RAD_S.1 * 1.01).contains(&first), "{first}");
            // Unequal dampers couple the modes a little.
            assert!((ratio / 0.03 - 1.0).abs() < 0.01, "{ratio}");
            let inertia = beam.inertia_kg_m2() / motor.inertia_kg_m2();
            assert!((INERTIA_RATIO.0..INERTIA_RATIO.1).contains(&inertia), "{inertia}");
        }
    }
}
