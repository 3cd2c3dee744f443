//! The linear part of an arm over a time and its halves, quarters, and so on, as matrices.

use nalgebra::DMatrix;

use crate::arm::Arm;

/// Most halvings of a time.
pub(super) const HALVINGS: usize = 50;
/// Times whose steps are kept: samples, and the parts that delays cut them into.
const TIMES: usize = 8;

/// `x(h) = Φ·x + γ·w(0) + ρ·(w(h) − w(0))` for a torque w on the motor that is linear in time.
#[derive(Debug, Clone)]
pub(super) struct ArmStep {
    pub(super) duration_s: f64,
    /// Φ by rows.
    rows: Vec<f64>,
    /// γ.
    pub(super) push: Vec<f64>,
    /// ρ.
    pub(super) ramp: Vec<f64>,
}

impl ArmStep {
    /// `out = Φ·x + γ·torque`.
    pub(super) fn apply(&self, x: &[f64], torque_nm: f64, out: &mut [f64]) {
        for ((row, push), out) in self.rows.chunks_exact(x.len()).zip(&self.push).zip(out) {
            let own: f64 = row.iter().zip(x).map(|(a, x)| a * x).sum();
            *out = own + torque_nm * push;
        }
    }
}

/// Steps of an arm, made when they are first asked for.
#[derive(Debug, Clone)]
pub(super) struct ArmSteps {
    /// ∂ẋ/∂x, velocities divided by `rate_per_s`.
    scaled: DMatrix<f64>,
    /// Acceleration of the motor per torque.
    per_torque: f64,
    rate_per_s: f64,
    /// Times and their steps by halvings, the last used first.
    kept: Vec<(f64, Vec<Option<ArmStep>>)>,
}

impl ArmSteps {
    /// Of an arm whose motor is held by a spring \[N·m/rad\] and a damper \[N·m·s/rad\].
    pub(super) fn new(arm: &Arm, [stiffness, damping]: [f64; 2]) -> Self {
        let len = arm.state_len();
        let per_torque = 1.0 / arm.motor.inertia_kg_m2();
        let swing = (stiffness * per_torque).sqrt();
        let rate_per_s = arm.rate_bound() + swing + damping * per_torque;
        let size = |i: usize| if is_velocity(i, len) { rate_per_s } else { 1.0 };
        let mut scaled = DMatrix::zeros(len, len);
        let (mut unit, mut column) = (vec![0.0; len], vec![0.0; len]);
        for c in 0..len {
            unit[c] = 1.0;
            arm.derivative_slipping(&unit, &mut column);
            unit[c] = 0.0;
            for (r, entry) in column.iter().enumerate() {
                scaled[(r, c)] = entry * size(c) / size(r);
            }
        }
        scaled[(1, 0)] -= stiffness * per_torque / rate_per_s;
        scaled[(1, 1)] -= damping * per_torque;
        Self { scaled, per_torque, rate_per_s, kept: Vec::new() }
    }

    /// Makes ready for steps over shares of `duration_s`.
    pub(super) fn begin(&mut self, duration_s: f64) {
        let found = self.kept.iter().position(|(d, _)| d.to_bits() == duration_s.to_bits());
        let first = match found {
            Some(at) => self.kept.remove(at),
            None => (duration_s, vec![None; HALVINGS + 1]),
        };
        self.kept.insert(0, first);
        self.kept.truncate(TIMES);
    }

    /// The step over the time begun with, halved `halvings` times.
    pub(super) fn step(&mut self, halvings: usize) -> Option<&ArmStep> {
        let (duration_s, steps) = self.kept.first_mut()?;
        let duration_s = *duration_s / (1_u64 << halvings) as f64;
        let place = steps.get_mut(halvings)?;
        let (scaled, rate) = (&self.scaled, self.rate_per_s);
        Some(place.get_or_insert_with(|| made(scaled, rate, self.per_torque, duration_s)))
    }
}

/// Whether a number of a state of `len` is a velocity.
pub(super) fn is_velocity(i: usize, len: usize) -> bool {
    i == 1 || i >= 2 + (len - 2) / 2
}

/// By the exponential of the matrix, with the torque and its change as two more states.
fn made(scaled: &DMatrix<f64>, rate_per_s: f64, per_torque: f64, duration_s: f64) -> ArmStep {
    let len = scaled.nrows();
    let size = |i: usize| if is_velocity(i, len) { rate_per_s } else { 1.0 };
    let mut whole = DMatrix::zeros(len + 2, len + 2);
    whole.view_mut((0, 0), (len, len)).copy_from(&(scaled * duration_s));
    // In shares of what the torque would change the velocity by.
    let torque = per_torque * duration_s / rate_per_s;
    whole[(1, len)] = 1.0;
    whole[(len, len + 1)] = 1.0;
    let exponential = whole.exp();
    let mut rows = Vec::with_capacity(len * len);
    for r in 0..len {
        rows.extend((0..len).map(|c| exponential[(r, c)] * size(r) / size(c)));
    }
    let column = |c: usize| (0..len).map(|r| torque * exponential[(r, c)] * size(r)).collect();
    ArmStep { duration_s, rows, push: column(len), ramp: column(len + 1) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::beam::{LumpedBeam, Span};
    use crate::drive::{Coulomb, Motor};
    use crate::rig::Hybrid;

    /// Largest difference of a state of order one.
    const ERROR: f64 = 1e-12;

    #[test]
    fn steps_are_those_of_the_event_engine_without_friction() {
        let span = Span {
            length_m: 0.2,
            flexural_rigidity_n_m2: 0.05,
            mass_kg: 0.05,
            damping_n_s_per_m: 0.1,
        };
        let beam = LumpedBeam::new(&[span, span]).unwrap();
        let motor = Motor::new(6e-4, 1e-3, 0.25).unwrap();
        let arm = Arm::new(beam, motor, Coulomb::symmetric(0.0).unwrap()).unwrap();
        let mut steps = ArmSteps::new(&arm, [0.0; 2]);
        let start = [0.0, 0.3, 0.1, -0.2, 0.5, -0.4];
        for duration_s in [1e-4, 3e-3, 0.5] {
            steps.begin(duration_s);
            for halvings in [0, 3, 12] {
                let step = steps.step(halvings).unwrap();
                let mut exact = Hybrid::with_state(&arm, start.to_vec());
                exact.advance(0.02, step.duration_s);
                let mut out = [0.0; 6];
                step.apply(&start, 0.02, &mut out);
                for (found, exact) in out.iter().zip(exact.state()) {
                    assert!((found - exact).abs() < ERROR, "{duration_s} {halvings}: {out:?}");
                }
            }
        }
    }
}
