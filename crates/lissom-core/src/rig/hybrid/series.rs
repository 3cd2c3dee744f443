//! Taylor series of an arm's state, and the position of the tip in it.

use super::events::{ROUNDING, pushed};
use super::{Hybrid, Torque};
use crate::drive::Coulomb;
use crate::friction::{Mode, PhaseSeries};
use crate::load::TorqueRipple;
use crate::lti::first_root::{ORDER_MOST, value};

/// Relative size of terms that are left out: two orders below rounding.
const LEFT_OUT: f64 = 1e-3 * f64::EPSILON;
/// Steps are not cut below this share.
const SHORTEST: f64 = 1e-14;

impl Hybrid<'_> {
    /// Index of θ_n in the state.
    pub(super) fn tip_index(&self) -> usize {
        1 + self.arm.beam().len()
    }
    /// Index of θ̇_n in the state.
    pub(super) fn tip_rate_index(&self) -> usize {
        self.tip_index() + self.arm.dynamics().len()
    }
    /// θ̈_n per force at the tip \[1/(kg·m)\].
    pub(super) fn tip_force_share(&self) -> f64 {
        self.arm.dynamics().force[self.arm.beam().len() - 1]
    }
    fn tip_radius_m(&self) -> f64 {
        self.arm.beam().position_m().last().copied().unwrap_or(0.0)
    }
    pub(super) fn tip_rubs(&self) -> bool {
        self.world.as_ref().is_some_and(|w| w.coulomb_n > 0.0)
    }

    /// A bound on how fast the state can change, torques of position and the world at the tip included \[1/s\].
    pub(super) fn rate_bound(&self) -> f64 {
        let swing = self.position_torque.stiffness_nm_per_rad();
        let own = self.arm.rate_bound() + (swing / self.arm.motor.inertia_kg_m2()).sqrt();
        let Some(world) = &self.world else { return own };
        let share = self.arm.dynamics().force.abs().max() * self.tip_radius_m();
        let walls: f64 = world.walls.iter().map(|w| w.stiffness_n_per_m).sum();
        let signals = world.force.rate_rad_s().max(world.torque.rate_rad_s());
        own + (walls * share).sqrt() + world.viscous_n_s_per_m * share + signals
    }

    /// The motor's torque now, less that of position and what the tip's torque adds to the coupling torque \[N·m\].
    pub(super) fn torque_at_joint(&self, torque: Torque<'_>) -> f64 {
        let motor = match torque {
            Torque::Held(torque) => torque,
            Torque::Over(signal) => signal.at(self.time_s),
        };
        let tip = self.world.as_ref().map_or(0.0, |w| w.torque.at(self.time_s));
        motor
            - self.arm.dynamics().coupling_torque * tip
            - self.position_torque.torque_nm(self.state[0])
    }

    /// What a rubbing tip does from rest.
    pub(super) fn tip_mode_from_rest(&mut self, torque: Torque<'_>) -> Mode {
        let Some(limit) = self.world.as_ref().map(|w| w.coulomb_n) else { return Mode::Stick };
        let before = self.tip_mode;
        self.tip_mode = Mode::Stick;
        self.begin(torque);
        self.next_term(0);
        self.tip_mode = before;
        let push = self.series.tip_held[0];
        pushed(push, Coulomb::of_limits(limit, limit), ROUNDING * (limit + push.abs()))
    }

    /// Fills `terms` with the Taylor coefficients of the state; gives the order reached and the time
    /// for which they hold, at most `step`.
    pub(super) fn fill(&mut self, torque: Torque<'_>, step: f64) -> (usize, f64) {
        self.begin(torque);
        let largest = |x: &[f64]| x.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        let mut sizes = [f64::MIN_POSITIVE; ORDER_MOST + 1];
        sizes[0] = sizes[0].max(largest(&self.state));
        let bends = self.mode != Mode::Stick && self.bends();
        // The largest term so far: a state at rest has no size of its own.
        let (mut reach, mut size) = (1.0, sizes[0]);
        for k in 0..ORDER_MOST {
            self.next_term(k);
            sizes[k + 1] = largest(&self.terms[k + 1]);
            let before = sizes[k] * reach;
            reach *= step;
            let last = sizes[k + 1] * reach;
            size = size.max(last);
            // Never before the torque has reached every state.
            if !bends && k >= 4 && before + last < size * LEFT_OUT {
                return (k + 1, step);
            }
        }
        if !bends {
            // The rate bound has seen to it that the step is short enough.
            return (ORDER_MOST, step);
        }
        // Terms may leave the range of numbers where friction bends sharply.
        let order = sizes.iter().position(|s| !s.is_finite()).map_or(ORDER_MOST, |k| k.max(3) - 1);
        (order, holds_for(&sizes[..=order], step))
    }

    fn begin(&mut self, torque: Torque<'_>) {
        let s = &mut self.series;
        s.torque = [0.0; ORDER_MOST + 1];
        match torque {
            Torque::Held(torque) => s.torque[0] = torque,
            Torque::Over(signal) => signal.add_taylor(self.time_s, &mut s.torque),
        }
        if let Some(world) = &self.world {
            s.tip_force = [0.0; ORDER_MOST + 1];
            s.tip_torque = [0.0; ORDER_MOST + 1];
            world.force.add_taylor(self.time_s, &mut s.tip_force);
            world.torque.add_taylor(self.time_s, &mut s.tip_torque);
            let direct = self.arm.dynamics().coupling_torque;
            for (torque, tip) in s.torque.iter_mut().zip(&s.tip_torque) {
                *torque -= direct * tip;
            }
        }
        self.terms[0].copy_from_slice(&self.state);
    }

    /// The coefficients of order `k` + 1 from those up to `k`.
    fn next_term(&mut self, k: usize) {
        let (before, after) = self.terms.split_at_mut(k + 1);
        let (term, next) = (&before[k], &mut after[0]);
        let (s, arm) = (&mut self.series, self.arm);
        (s.angle[k], s.velocity[k]) = (term[0], term[1]);
        let waves = s.phases.iter_mut().zip(self.position_torque.waves());
        let torque = |(phase, wave): (&mut PhaseSeries, &TorqueRipple)| {
            let (sine, cosine) = phase.next(wave.per_rad, k, &s.angle);
            wave.sine_nm * sine + wave.cosine_nm * cosine
        };
        let load: f64 = waves.map(torque).sum();
        if self.mode == Mode::Stick {
            arm.derivative_sticking(term, next);
            s.held[k] = s.torque[k] - arm.coupling_torque(term) - load;
        } else {
            arm.derivative_slipping(term, next);
            let sign = self.mode.sign();
            let friction = if self.friction.is_constant() {
                if k == 0 { self.friction.sliding().slipping(sign) } else { 0.0 }
            } else {
                s.friction.next(&self.friction, k, sign, (&s.angle, &s.velocity))
            };
            next[1] += (s.torque[k] - friction - load) / arm.motor.inertia_kg_m2();
        }
        if self.world.is_some() {
            self.add_world(k);
        }
        let scale = 1.0 / (k as f64 + 1.0);
        self.terms[k + 1].iter_mut().for_each(|v| *v *= scale);
    }

    /// What the world at the tip adds to the derivative of order `k`.
    fn add_world(&mut self, k: usize) {
        let Some(world) = &self.world else { return };
        let (tip, rate) = (self.tip_index(), self.tip_rate_index());
        let (radius, share) = (self.tip_radius_m(), self.tip_force_share());
        let (before, after) = self.terms.split_at_mut(k + 1);
        let (term, next) = (&before[k], &mut after[0]);
        let d = self.arm.dynamics();
        let masses = rate + 1 - self.arm.beam().len();
        for (a, torque) in next[masses..].iter_mut().zip(d.torque.iter()) {
            *a += torque * self.series.tip_torque[k];
        }
        let mut force = self.series.tip_force[k] - world.viscous_n_s_per_m * radius * term[rate];
        for (wall, touching) in world.walls.iter().zip(&self.touching) {
            if *touching {
                let at = if k == 0 { wall.angle_rad } else { 0.0 };
                force -= wall.stiffness_n_per_m * radius * (term[tip] - at);
            }
        }
        if world.coulomb_n > 0.0 {
            if self.tip_mode == Mode::Stick {
                // Friction takes whatever keeps the tip where it is.
                let push = next[rate] / share + force;
                self.series.tip_held[k] = push;
                force -= push;
            } else if k == 0 {
                force -= self.tip_mode.sign() * world.coulomb_n;
            }
        }
        for (a, share) in next[masses..].iter_mut().zip(d.force.iter()) {
            *a += share * force;
        }
        if world.coulomb_n > 0.0 && self.tip_mode == Mode::Stick {
            next[rate] = 0.0;
        }
    }

    /// Puts the state where the series is at `time`.
    pub(super) fn evaluate(&mut self, order: usize, time: f64) {
        let mut column = [0.0; ORDER_MOST + 1];
        for i in 0..self.state.len() {
            for (c, term) in column.iter_mut().zip(&self.terms[..=order]) {
                *c = term[i];
            }
            self.state[i] = value(&column[..=order], time);
        }
    }
}

/// How long, at most `step`, a series with terms of these sizes holds to [`Hybrid::BENT`] of the motion that
/// its first terms describe.
fn holds_for(sizes: &[f64], step: f64) -> f64 {
    let order = sizes.len() - 1;
    let mut h = step;
    while h > step * SHORTEST {
        let motion = sizes[0].max(sizes[1] * h).max(sizes[2] * h * h);
        let last = h.powf(order as f64 - 1.0);
        if last * (sizes[order - 1] + h * sizes[order]) <= Hybrid::BENT * motion {
            break;
        }
        h *= 0.8;
    }
    h
}
