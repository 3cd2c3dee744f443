//! Exact motion of an arm between samples: stick, slip and the events between them.

use super::polynomial::{ORDER_MOST, first_nonpositive, first_used_up, value};
use super::{Motion, RigError};
use crate::arm::Arm;

/// Largest (rate bound × step) for which a Taylor series of order [`ORDER_MOST`] is exact to
/// rounding: 0.5²⁴/24! is 1e-31.
const STEP_RATE: f64 = 0.5;

/// Accelerations below this share of what the torques give are rounding.
pub(super) const ROUNDING: f64 = 1e-13;

/// What the joint does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    /// At rest, held by friction.
    Stick,
    /// Moving forward.
    Forward,
    /// Moving backward.
    Backward,
}

/// An arm in motion.
///
/// Between events the arm is linear with constant input; its state is a Taylor series in time
/// whose terms follow from one another by the state matrix, summed until they vanish. The
/// velocity is then a polynomial whose first root is the event. Nothing is smoothed and no
/// tolerance enters but rounding.
///
/// ```
/// # use lissom::{arm::Arm, beam::{LumpedBeam, Span}, drive::{Coulomb, Motor}, rig::Hybrid};
/// # let span = Span { length_m: 0.2, flexural_rigidity_n_m2: 0.004, mass_kg: 0.05, damping_n_s_per_m: 0.0 };
/// # let beam = LumpedBeam::new(&[span]).unwrap();
/// # let arm = Arm::new(beam, Motor::new(6e-4, 1e-3, 0.25).unwrap(), Coulomb::symmetric(0.03).unwrap()).unwrap();
/// let mut hybrid = Hybrid::at_rest(&arm);
/// hybrid.advance(0.029, 1.0); // N·m and s: below the friction of 0.03 N·m
/// assert_eq!(hybrid.state()[0], 0.0);
/// hybrid.advance(0.031, 1.0);
/// assert!(hybrid.state()[0] > 0.0);
/// ```
///
/// # Source
/// `[Feliu1989, eqs. (13)-(15), Section 5]`.
///
/// # Differences from the source
/// Section 5 says nothing of θ̇_m = 0: here the joint sticks while the drive torque less the
/// coupling torque lies between −backward and forward.
#[derive(Debug, Clone)]
pub struct Hybrid<'a> {
    pub(super) arm: &'a Arm,
    pub(super) state: Vec<f64>,
    pub(super) mode: Mode,
    step_most_s: f64,
    /// Taylor coefficients of the state; the first also serves as a state that is tried.
    pub(super) terms: Vec<Vec<f64>>,
    sticks: usize,
    pub(super) stuck_s: f64,
}

impl<'a> Hybrid<'a> {
    /// An arm at rest at angle zero.
    pub fn at_rest(arm: &'a Arm) -> Self {
        Self::with_state(arm, vec![0.0; arm.state_len()])
    }

    /// An arm in `state`, `[θ_m, θ̇_m, θ_i.., θ̇_i..]`; missing entries are zero, further ones are
    /// left out.
    pub fn with_state(arm: &'a Arm, mut state: Vec<f64>) -> Self {
        let len = arm.state_len();
        state.resize(len, 0.0);
        let mode = match state[1] {
            v if v > 0.0 => Mode::Forward,
            v if v < 0.0 => Mode::Backward,
            _ => Mode::Stick,
        };
        Self {
            arm,
            state,
            mode,
            step_most_s: STEP_RATE / arm.rate_bound(),
            terms: vec![vec![0.0; len]; ORDER_MOST + 1],
            sticks: 0,
            stuck_s: 0.0,
        }
    }

    /// Current state `[θ_m, θ̇_m, θ_i.., θ̇_i..]`.
    pub fn state(&self) -> &[f64] {
        &self.state
    }
    /// What the joint does now.
    pub fn mode(&self) -> Mode {
        self.mode
    }
    /// How many times the joint came to stick.
    pub fn sticks(&self) -> usize {
        self.sticks
    }
    /// Total time spent sticking \[s\].
    pub fn stuck_s(&self) -> f64 {
        self.stuck_s
    }

    /// Moves on by `duration_s` under a constant motor torque \[N·m\].
    pub fn advance(&mut self, torque_nm: f64, duration_s: f64) {
        let mut left = duration_s;
        while left > 0.0 {
            let step = left.min(self.step_most_s);
            left -= self.step(torque_nm, step);
            // A remainder of rounding only.
            if left <= f64::EPSILON * duration_s {
                break;
            }
        }
    }

    /// Moves on by at most `duration_s` under a constant motor torque \[N·m\], ending where the joint
    /// sticks, breaks loose or reverses; gives the time that passed \[s\].
    ///
    /// ```
    /// # use lissom::{arm::Arm, beam::{LumpedBeam, Span}, drive::{Coulomb, Motor}, rig::{Hybrid, Mode}};
    /// # let span = Span { length_m: 0.2, flexural_rigidity_n_m2: 0.004, mass_kg: 0.05, damping_n_s_per_m: 0.0 };
    /// # let beam = LumpedBeam::new(&[span]).unwrap();
    /// # let arm = Arm::new(beam, Motor::new(6e-4, 1e-3, 0.25).unwrap(), Coulomb::symmetric(0.03).unwrap()).unwrap();
    /// let mut hybrid = Hybrid::with_state(&arm, vec![0.0, 1.0]); // coasting at 1 rad/s
    /// let time_s = hybrid.advance_to_event(0.0, 1.0);
    /// assert!(time_s < 0.02 && hybrid.mode() != Mode::Forward);
    /// ```
    pub fn advance_to_event(&mut self, torque_nm: f64, duration_s: f64) -> f64 {
        let (mut passed, mode) = (0.0, self.mode);
        while passed < duration_s {
            let left = duration_s - passed;
            passed += self.step(torque_nm, left.min(self.step_most_s));
            if self.mode != mode || left <= f64::EPSILON * duration_s {
                break;
            }
        }
        passed.min(duration_s)
    }

    /// Moves on with the motor held, whatever the torques.
    pub(super) fn advance_stuck(&mut self, duration_s: f64) {
        self.mode = Mode::Stick;
        let parts = (duration_s / self.step_most_s).ceil().max(1.0);
        for _ in 0..parts as usize {
            let order = self.series(0.0);
            self.evaluate(order, duration_s / parts);
        }
    }

    /// Moves on by at most `step`, ending early at an event; gives the time that passed.
    fn step(&mut self, torque: f64, step: f64) -> f64 {
        let coulomb = self.arm.coulomb;
        if coulomb.forward == 0.0 && coulomb.backward == 0.0 {
            // Without friction there are no events.
            self.mode = Mode::Forward;
            let order = self.series(torque);
            self.evaluate(order, step);
            step
        } else if self.mode == Mode::Stick {
            self.step_sticking(torque, step)
        } else {
            self.step_slipping(torque, step)
        }
    }

    fn step_sticking(&mut self, torque: f64, step: f64) -> f64 {
        let (forward, backward) = (self.arm.coulomb.forward, self.arm.coulomb.backward);
        self.mode = self.mode_from_rest(torque);
        if self.mode != Mode::Stick {
            return 0.0;
        }
        let order = self.series(0.0);
        // Room left before the drive overcomes friction, as polynomials in time.
        let mut room_forward = [0.0; ORDER_MOST + 1];
        let mut room_backward = [0.0; ORDER_MOST + 1];
        for k in 0..=order {
            let coupling = self.arm.coupling_torque(&self.terms[k]);
            room_forward[k] = coupling;
            room_backward[k] = -coupling;
        }
        room_forward[0] += forward - torque;
        room_backward[0] += backward + torque;
        let rounding = self.rounding(torque);
        let up = first_used_up(&room_forward[..=order], step, rounding);
        let down = first_used_up(&room_backward[..=order], step, rounding);
        let (time, next) = match (up, down) {
            (Some(a), Some(b)) if b < a => (b, Mode::Backward),
            (Some(a), _) => (a, Mode::Forward),
            (None, Some(b)) => (b, Mode::Backward),
            (None, None) => (step, Mode::Stick),
        };
        self.evaluate(order, time);
        self.mode = next;
        self.stuck_s += time;
        time
    }

    fn step_slipping(&mut self, torque: f64, step: f64) -> f64 {
        let sign = if self.mode == Mode::Forward { 1.0 } else { -1.0 };
        let friction = self.arm.coulomb.slipping(sign);
        let order = self.series(torque - friction);
        let mut velocity = [0.0; ORDER_MOST + 1];
        for (v, term) in velocity.iter_mut().zip(&self.terms[..=order]) {
            *v = sign * term[1];
        }
        // From rest the root at the start is divided out. Released between samples, the motor
        // starts with no acceleration but rounding, and that root is double.
        let rounding = self.rounding(torque) / self.arm.motor.inertia_kg_m2;
        let roots = match (self.state[1] == 0.0, velocity[1].abs() <= rounding) {
            (false, _) => 0,
            (true, false) => 1,
            (true, true) => 2,
        };
        let polynomial = &velocity[roots..=order];
        if polynomial[0] <= 0.0 {
            // Released with no acceleration, or turned by a jump of the torque: decide anew.
            self.state[1] = 0.0;
            return self.leave_rest(torque, sign, step);
        }
        let Some(time) = first_nonpositive(polynomial, step) else {
            self.evaluate(order, step);
            return step;
        };
        self.evaluate(order, time);
        self.state[1] = 0.0;
        self.mode = self.mode_from_rest(torque);
        if self.mode == Mode::Stick {
            self.sticks += 1;
        }
        time
    }

    /// What the joint does from rest: friction holds up to its limit, rounding left out.
    fn mode_from_rest(&self, torque: f64) -> Mode {
        let net = torque - self.arm.coupling_torque(&self.state);
        let rounding = self.rounding(torque);
        if net > self.arm.coulomb.forward + rounding {
            Mode::Forward
        } else if net < -self.arm.coulomb.backward - rounding {
            Mode::Backward
        } else {
            Mode::Stick
        }
    }

    /// Torques below this are rounding of those that act \[N·m\].
    pub(super) fn rounding(&self, torque: f64) -> f64 {
        let coulomb = self.arm.coulomb.forward.max(self.arm.coulomb.backward);
        ROUNDING * (torque.abs() + coulomb)
    }

    /// At rest with a net torque exactly at the friction limit and no sign of where it goes.
    fn leave_rest(&mut self, torque: f64, sign: f64, step: f64) -> f64 {
        let mode = self.mode_from_rest(torque);
        let turned = match mode {
            Mode::Forward => sign < 0.0,
            Mode::Backward => sign > 0.0,
            Mode::Stick => false,
        };
        if turned {
            self.mode = mode;
            return 0.0;
        }
        // With the beam moving, the coupling torque goes on changing and the joint starts; move
        // the beam alone until it does, by the smallest useful time.
        let order = self.series_of_beam();
        let pause = step.min(self.step_most_s * 1e-9).max(f64::MIN_POSITIVE);
        self.evaluate(order, pause);
        self.stuck_s += pause;
        self.mode = self.mode_from_rest(torque);
        pause
    }

    fn series_of_beam(&mut self) -> usize {
        let mode = self.mode;
        self.mode = Mode::Stick;
        let order = self.series(0.0);
        self.mode = mode;
        order
    }

    /// Fills `terms` with the Taylor coefficients of the state; gives the order reached.
    fn series(&mut self, net_torque: f64) -> usize {
        self.terms[0].copy_from_slice(&self.state);
        let mut reach = 1.0;
        let size = self.state.iter().fold(f64::MIN_POSITIVE, |m, v| m.max(v.abs()));
        for k in 0..ORDER_MOST {
            let (before, after) = self.terms.split_at_mut(k + 1);
            let (term, next) = (&before[k], &mut after[0]);
            if self.mode == Mode::Stick {
                self.arm.derivative_sticking(term, next);
            } else {
                self.arm.derivative_slipping(term, next);
                if k == 0 {
                    next[1] += net_torque / self.arm.motor.inertia_kg_m2;
                }
            }
            let scale = 1.0 / (k as f64 + 1.0);
            for v in next.iter_mut() {
                *v *= scale;
            }
            reach *= self.step_most_s;
            let largest = next.iter().fold(0.0, |m: f64, v| m.max(v.abs())) * reach;
            // Two orders below rounding, and never before the torque has reached every state.
            if k >= 4 && largest < size * f64::EPSILON * 1e-3 {
                return k + 1;
            }
        }
        ORDER_MOST
    }

    fn evaluate(&mut self, order: usize, time: f64) {
        let mut column = [0.0; ORDER_MOST + 1];
        for i in 0..self.state.len() {
            for (c, term) in column.iter_mut().zip(&self.terms[..=order]) {
                *c = term[i];
            }
            self.state[i] = value(&column[..=order], time);
        }
    }
}

impl Motion for Hybrid<'_> {
    fn state(&self) -> &[f64] {
        Hybrid::state(self)
    }
    fn advance(&mut self, torque_nm: f64, duration_s: f64) -> Result<(), RigError> {
        Hybrid::advance(self, torque_nm, duration_s);
        Ok(())
    }
    fn stuck_s(&self) -> f64 {
        Hybrid::stuck_s(self)
    }
    fn tolerance(&self) -> Option<f64> {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::beam::{LumpedBeam, Span};
    use crate::drive::{Coulomb, Motor};

    fn arm(coulomb: f64) -> Arm {
        let span = Span {
            length_m: 0.2,
            flexural_rigidity_n_m2: 0.005,
            mass_kg: 0.05,
            damping_n_s_per_m: 0.0,
        };
        let motor = Motor::new(6e-4, 1e-3, 0.25).unwrap();
        let beam = LumpedBeam::new(&[span]).unwrap();
        Arm::new(beam, motor, Coulomb::symmetric(coulomb).unwrap()).unwrap()
    }

    #[test]
    fn a_torque_exactly_at_the_limit_holds() {
        let arm = arm(0.033);
        let mut hybrid = Hybrid::at_rest(&arm);
        for torque in [0.033, -0.033, 0.033 * (1.0 - f64::EPSILON)] {
            hybrid.advance(torque, 1.0);
            assert_eq!(hybrid.mode(), Mode::Stick);
        }
        assert!((hybrid.stuck_s() - 3.0).abs() < 1e-12);
    }

    #[test]
    fn without_friction_nothing_sticks() {
        let arm = arm(0.0);
        let mut hybrid = Hybrid::at_rest(&arm);
        hybrid.advance(0.0, 1.0);
        assert_eq!((hybrid.sticks(), hybrid.state()[0]), (0, 0.0));
        hybrid.advance(1e-3, 1.0);
        assert!(hybrid.state()[1] > 0.0);
    }

    #[test]
    fn free_motion_of_a_frictionless_arm_keeps_its_momentum() {
        let mut arm = arm(0.0);
        arm.motor.viscous_nm_s_per_rad = 0.0;
        let mut hybrid = Hybrid::with_state(&arm, vec![0.0, 1.0, 0.1, -2.0]);
        let inertia = 0.05 * 0.2 * 0.2;
        let momentum = |x: &[f64]| 6e-4 * x[1] + inertia * x[3];
        let before = momentum(hybrid.state());
        hybrid.advance(0.0, 100.0);
        assert!((momentum(hybrid.state()) - before).abs() < 1e-12 * inertia);
    }
}
