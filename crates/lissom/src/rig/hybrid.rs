//! Exact motion of an arm between samples: stick, slip and the events between them.

use super::polynomial::{ORDER_MOST, first_nonpositive, value};
use crate::arm::Arm;

/// Largest (rate bound × step) for which a Taylor series of order [`ORDER_MOST`] is exact to
/// rounding: 0.5²⁴/24! is 1e-31.
const STEP_RATE: f64 = 0.5;

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
/// # let arm = Arm::new(beam, Motor::new(6e-4, 1e-3, 0.25).unwrap(), Coulomb::symmetric(0.03).unwrap());
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
    arm: &'a Arm,
    state: Vec<f64>,
    mode: Mode,
    step_most_s: f64,
    terms: Vec<Vec<f64>>,
    sticks: usize,
    stuck_s: f64,
}

impl<'a> Hybrid<'a> {
    /// An arm at rest at angle zero.
    pub fn at_rest(arm: &'a Arm) -> Self {
        let len = arm.state_len();
        Self {
            arm,
            state: vec![0.0; len],
            mode: Mode::Stick,
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

    /// Moves on by at most `step`, ending early at an event; gives the time that passed.
    fn step(&mut self, torque: f64, step: f64) -> f64 {
        if self.mode == Mode::Stick {
            self.step_sticking(torque, step)
        } else {
            self.step_slipping(torque, step)
        }
    }

    fn step_sticking(&mut self, torque: f64, step: f64) -> f64 {
        let net = torque - self.arm.coupling_torque(&self.state);
        let (forward, backward) = (self.arm.coulomb.forward, self.arm.coulomb.backward);
        if net > forward {
            self.mode = Mode::Forward;
            return 0.0;
        }
        if net < -backward {
            self.mode = Mode::Backward;
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
        let up = first_nonpositive(&room_forward[..=order], step);
        let down = first_nonpositive(&room_backward[..=order], step);
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
        for k in 0..=order {
            velocity[k] = sign * self.terms[k][1];
        }
        let from_rest = self.state[1] == 0.0;
        // From rest the root at the start is divided out.
        let polynomial = &velocity[usize::from(from_rest)..=order];
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
        let net = torque - self.arm.coupling_torque(&self.state);
        if net > self.arm.coulomb.forward {
            self.mode = Mode::Forward;
        } else if net < -self.arm.coulomb.backward {
            self.mode = Mode::Backward;
        } else {
            self.mode = Mode::Stick;
            self.sticks += 1;
        }
        time
    }

    /// At rest with a net torque exactly at the friction limit: the velocity's next terms decide.
    fn leave_rest(&mut self, torque: f64, sign: f64, step: f64) -> f64 {
        let net = torque - self.arm.coupling_torque(&self.state);
        if net > self.arm.coulomb.forward && sign < 0.0 {
            self.mode = Mode::Forward;
            return 0.0;
        }
        if net < -self.arm.coulomb.backward && sign > 0.0 {
            self.mode = Mode::Backward;
            return 0.0;
        }
        // The limit is just met. With the beam moving, the coupling torque goes on changing and
        // the joint starts; move the beam alone until it does, by the smallest useful time.
        let order = self.series_of_beam();
        let pause = step.min(self.step_most_s * 1e-9).max(f64::MIN_POSITIVE);
        self.evaluate(order, pause);
        self.stuck_s += pause;
        let net = torque - self.arm.coupling_torque(&self.state);
        self.mode = if net > self.arm.coulomb.forward {
            Mode::Forward
        } else if net < -self.arm.coulomb.backward {
            Mode::Backward
        } else {
            Mode::Stick
        };
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
            next.iter_mut().for_each(|v| *v *= scale);
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
