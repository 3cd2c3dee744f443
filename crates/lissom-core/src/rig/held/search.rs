//! From event to event within a sample: breaking loose, coming to rest, reversing.

use super::flow::step;
use super::held_arm::{Duration, Modes};
use super::held_motion::{HeldMotion, rounding};
use crate::friction::Mode;

/// Events within one duration after which the event engine takes the rest.
const MOST_EVENTS: usize = 64;
/// A motor that starts, and wanders off from zero by less than this share of what moves, is left to
/// the event engine: roundings would decide.
const SMALL: f64 = 1e-12;

impl HeldMotion<'_> {
    /// Moves on by `duration_s` from event to event.
    #[cold]
    pub(in crate::rig) fn search(&mut self, modes: &Modes, torque: f64, duration_s: f64) {
        self.work.searched += 1;
        let Some(mut room) = self.other.take() else { return };
        let mut left = duration_s;
        for _ in 0..MOST_EVENTS {
            let passed = if self.mode == Mode::Stick {
                self.stick_phase(modes, torque, left, &mut room)
            } else {
                self.slip_phase(modes, torque, left, &mut room)
            };
            let Some(passed) = passed else { break };
            left -= passed;
            if left <= f64::EPSILON * duration_s {
                left = 0.0;
                break;
            }
        }
        self.other = Some(room);
        if left > 0.0 {
            self.hand_over(modes, torque, left);
        }
    }

    /// The event engine moves on.
    fn hand_over(&mut self, modes: &Modes, torque: f64, left: f64) {
        self.work.handed_over += 1;
        self.leave(modes);
        modes.modal.state(self.angle, &self.z, &mut self.events.state);
        self.events.state[1] = self.motor_velocity_rad_s();
        self.events.mode = self.mode;
        let (sticks, stuck_s) = (self.events.sticks(), self.events.stuck_s());
        self.events.advance(torque, left);
        self.sticks += self.events.sticks() - sticks;
        self.stuck_s += self.events.stuck_s() - stuck_s;
        self.take_over(modes);
    }

    /// From rest until the joint breaks loose, `left` at most; gives the time that passed, `None`
    /// where roundings would decide.
    fn stick_phase(
        &mut self,
        modes: &Modes,
        torque: f64,
        left: f64,
        room: &mut Duration,
    ) -> Option<f64> {
        let coulomb = self.held.arm.coulomb;
        let rounding = rounding(coulomb, torque);
        let forward = coulomb.forward() + self.watched - torque;
        let backward = coulomb.backward() - self.watched + torque;
        if forward < -rounding || backward < -rounding {
            let mode = if forward < -rounding { Mode::Forward } else { Mode::Backward };
            self.change(modes, mode, 0.0);
            return Some(0.0);
        }
        if forward <= 2.0 * rounding || backward <= 2.0 * rounding {
            return None;
        }
        let blocks = &modes.stick.blocks;
        let y = &self.y[..blocks.len()];
        self.wave.set(forward, 1.0, blocks, y, 0.0);
        let up = self.wave.first_zero(0.0, left);
        self.wave.set(backward, -1.0, blocks, y, 0.0);
        let down = self.wave.first_zero(0.0, up.unwrap_or(left));
        let (time, mode) = match (up, down) {
            (Some(a), Some(b)) if b < a => (b, Mode::Backward),
            (Some(a), _) => (a, Mode::Forward),
            (None, Some(b)) => (b, Mode::Backward),
            (None, None) => (left, Mode::Stick),
        };
        room.set_stick(modes, time);
        let moved = step(&room.stick, &self.y, 0.0, &mut self.next);
        std::mem::swap(&mut self.y, &mut self.next);
        self.watched = moved.watched;
        self.stuck_s += time;
        if mode != Mode::Stick {
            self.change(modes, mode, 0.0);
        }
        Some(time)
    }

    /// Slips until the motor comes to rest, `left` at most; gives the time that passed, `None`
    /// where roundings would decide.
    fn slip_phase(
        &mut self,
        modes: &Modes,
        torque: f64,
        left: f64,
        room: &mut Duration,
    ) -> Option<f64> {
        let coulomb = self.held.arm.coulomb;
        let sign = if self.mode == Mode::Forward { 1.0 } else { -1.0 };
        let net = torque - coulomb.slipping(sign);
        self.wave.set(sign * self.watched, sign, &modes.slip.blocks, &self.y, net);
        let from = if self.watched == 0.0 { self.clear_of_rest(torque, left)? } else { 0.0 };
        let found = if from < left { self.wave.first_zero(from, left) } else { None };
        if found.is_some_and(|time| time <= from) {
            return None;
        }
        let time = found.unwrap_or(left);
        room.set_slip(modes, time);
        let moved = step(&room.slip, &self.y, net, &mut self.next);
        std::mem::swap(&mut self.y, &mut self.next);
        self.angle = (self.angle + moved.sum) + room.turned * net;
        self.watched = moved.watched;
        if found.is_some() {
            self.come_to_rest(modes, torque);
        } else if sign * self.watched <= 0.0 {
            // The search saw it end above zero: roundings.
            self.watched = sign * f64::MIN_POSITIVE;
        }
        Some(time)
    }

    /// A time, `left` at most, up to which a motor that starts from rest is surely under way:
    /// with `f = a·t + …`, `|f̈| ≤ m`, it is until 2a/m, and where a is nothing but rounding and
    /// `f = b·t²/2 + …`, `|f⃛| ≤ m`, until 3b/m. `None` where it does not start in its direction.
    fn clear_of_rest(&self, torque: f64, left: f64) -> Option<f64> {
        let arm = self.held.arm;
        let (slope, bound) = (self.wave.slope(), self.wave.bound(2));
        if slope > rounding(arm.coulomb, torque) / arm.motor.inertia_kg_m2() {
            return (slope * slope > SMALL * self.wave.bound(1) * bound * left.min(slope / bound))
                .then(|| left.min(slope / bound));
        }
        let (bend, bound) = (self.wave.bend(), self.wave.bound(3));
        let surely = slope.abs() <= rounding(arm.coulomb, torque) / arm.motor.inertia_kg_m2()
            && bend > 0.0
            && bend * bend > SMALL * self.wave.bound(2) * bound;
        surely.then(|| left.min(1.5 * bend / bound))
    }

    /// The motor has come to rest: what follows.
    fn come_to_rest(&mut self, modes: &Modes, torque: f64) {
        modes.slip.leave(&self.y, &mut self.z);
        let coupling: f64 = self.z.iter().zip(&modes.coupling).skip(1).map(|(z, c)| z * c).sum();
        let coulomb = self.held.arm.coulomb;
        let (net, rounding) = (torque - coupling, rounding(coulomb, torque));
        self.mode = if net > coulomb.forward() + rounding {
            Mode::Forward
        } else if net < -coulomb.backward() - rounding {
            Mode::Backward
        } else {
            self.sticks += 1;
            Mode::Stick
        };
        self.z[0] = 0.0;
        self.enter(modes);
        if self.mode != Mode::Stick {
            self.watched = 0.0;
        }
    }

    /// Leaves the stick.
    pub(in crate::rig) fn change(&mut self, modes: &Modes, mode: Mode, velocity: f64) {
        self.leave(modes);
        self.mode = mode;
        self.enter(modes);
        self.watched = velocity;
    }
}
