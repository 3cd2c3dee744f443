//! Events of a motion: what sticks, breaks loose, reverses, meets a wall or changes.

use super::slip::{Contact, slip_ends};
use super::{Hybrid, STEP_RATE, Torque};
use crate::drive::Coulomb;
use crate::friction::Mode;
use crate::lti::first_root::{ORDER_MOST, first_used_up};

/// Accelerations below this share of what the torques give are rounding.
pub(in crate::rig) const ROUNDING: f64 = 1e-13;

/// What ends a step.
#[derive(Debug, Clone, Copy)]
enum Event {
    Joint(Mode),
    Tip(Mode),
    Wall(usize),
}

impl Hybrid<'_> {
    /// Moves on by at most `most_s`, ending early at an event; gives the time that passed.
    pub(super) fn step(&mut self, torque: Torque<'_>, most_s: f64) -> f64 {
        let (step, stop_at) = self.to_next_break(torque, most_s.min(self.step_most_s));
        self.leave_rest(torque);
        let (order, reached) = self.fill(torque, step);
        let mut first: (f64, Option<Event>) = (reached, None);
        for event in [self.joint_event(order, reached), self.tip_event(order, reached)] {
            match event {
                Contact::Ends(time, event) if time < first.0 || first.1.is_none() => {
                    first = (time, Some(event));
                }
                Contact::Lasts | Contact::Ends(..) => {}
                Contact::Undecided(event) => return self.decide(event, torque, step),
            }
        }
        if let Some((time, wall)) = self.wall_event(order, reached, first.0) {
            first = (time, Some(Event::Wall(wall)));
        }
        let (time, event) = first;
        self.evaluate(order, time);
        if self.mode == Mode::Stick && !self.friction.is_zero() {
            self.stuck_s += time;
        }
        self.time_s += time;
        match event {
            Some(event) => self.apply(event, torque),
            None if time >= step => {
                if let Some(at) = stop_at {
                    self.time_s = at;
                    self.change_arm();
                }
            }
            None => {}
        }
        time
    }

    /// `step`, shortened to the next time at which torque or world are not smooth or the arm
    /// changes, and that time.
    fn to_next_break(&self, torque: Torque<'_>, step: f64) -> (f64, Option<f64>) {
        let signals = self.world.iter().flat_map(|w| [&w.force, &w.torque]);
        let driven = match torque {
            Torque::Held(_) => None,
            Torque::Over(signal) => Some(signal),
        };
        let breaks = signals.chain(driven).filter_map(|s| s.next_break_s(self.time_s));
        let change = self.changes.last().map(|c| c.0);
        match breaks.chain(change).min_by(f64::total_cmp) {
            Some(at) if at - self.time_s <= step => ((at - self.time_s).max(0.0), Some(at)),
            _ => (step, None),
        }
    }

    fn change_arm(&mut self) {
        while let Some((_, arm)) = self.changes.pop_if(|c| c.0 <= self.time_s) {
            self.state = arm.take_over(self.arm, &self.state);
            self.terms = vec![vec![0.0; self.state.len()]; ORDER_MOST + 1];
            self.arm = arm;
            self.coupling_size = arm.dynamics().coupling.abs().sum();
            self.step_most_s = STEP_RATE / self.rate_bound();
        }
    }

    fn apply(&mut self, event: Event, torque: Torque<'_>) {
        self.events += 1;
        match event {
            // What slipped has come to rest.
            Event::Joint(Mode::Stick) => {
                self.state[1] = 0.0;
                self.mode = self.mode_from_rest(torque);
                if self.mode == Mode::Stick {
                    self.sticks += 1;
                }
            }
            Event::Joint(mode) => self.mode = mode,
            Event::Tip(Mode::Stick) => {
                let at = self.tip_rate_index();
                self.state[at] = 0.0;
                self.tip_mode = self.tip_mode_from_rest(torque);
            }
            Event::Tip(mode) => self.tip_mode = mode,
            Event::Wall(wall) => self.touching[wall] = !self.touching[wall],
        }
    }

    /// Lets go what is at rest and pushed too hard to stay.
    fn leave_rest(&mut self, torque: Torque<'_>) {
        if self.friction.is_zero() {
            // Without friction there are no events.
            self.mode = Mode::Forward;
        } else if self.mode == Mode::Stick {
            self.mode = self.mode_from_rest(torque);
            self.events += usize::from(self.mode != Mode::Stick);
        }
        if self.tip_mode == Mode::Stick && self.tip_rubs() {
            self.tip_mode = self.tip_mode_from_rest(torque);
        }
    }

    fn joint_event(&self, order: usize, step: f64) -> Contact<Event> {
        if self.friction.is_zero() {
            return Contact::Lasts;
        }
        let rounding = self.rounding(self.series.torque[0]);
        if self.mode == Mode::Stick {
            let limits = self.friction.at(0.0, self.state[0]);
            return leaves(&self.series.held[..=order], limits, step, rounding).map(Event::Joint);
        }
        let velocity = self.signed(order, 1, self.mode);
        let rounding = rounding / self.arm.motor.inertia_kg_m2();
        slip_ends(&velocity[..=order], step, rounding, Event::Joint(Mode::Stick))
    }

    fn tip_event(&self, order: usize, step: f64) -> Contact<Event> {
        let Some(world) = self.world.as_ref().filter(|w| w.coulomb_n > 0.0) else {
            return Contact::Lasts;
        };
        let limits = Coulomb::of_limits(world.coulomb_n, world.coulomb_n);
        let rounding = ROUNDING * (world.coulomb_n + self.series.tip_held[0].abs());
        if self.tip_mode == Mode::Stick {
            return leaves(&self.series.tip_held[..=order], limits, step, rounding).map(Event::Tip);
        }
        let rounding = rounding * self.tip_force_share();
        let velocity = self.signed(order, self.tip_rate_index(), self.tip_mode);
        slip_ends(&velocity[..=order], step, rounding, Event::Tip(Mode::Stick))
    }

    /// The first wall that the tip meets or leaves before `end`.
    fn wall_event(&self, order: usize, step: f64, end: f64) -> Option<(f64, usize)> {
        let tip = self.tip_index();
        let mut first: Option<(f64, usize)> = None;
        for (i, wall) in self.world.iter().flat_map(|w| &w.walls).enumerate() {
            let sign = if self.touching[i] == wall.ahead { 1.0 } else { -1.0 };
            let mut room = [0.0; ORDER_MOST + 1];
            for (r, term) in room.iter_mut().zip(&self.terms[..=order]) {
                *r = sign * term[tip];
            }
            room[0] -= sign * wall.angle_rad;
            let rounding = ROUNDING * (wall.angle_rad.abs() + self.state[0].abs());
            let before = first.map_or(end, |f| f.0);
            if let Some(time) = first_used_up(&room[..=order], step, rounding)
                && time < before
            {
                first = Some((time, i));
            }
        }
        first
    }

    fn signed(&self, order: usize, index: usize, mode: Mode) -> [f64; ORDER_MOST + 1] {
        let mut out = [0.0; ORDER_MOST + 1];
        for (v, term) in out.iter_mut().zip(&self.terms[..=order]) {
            *v = mode.sign() * term[index];
        }
        out
    }

    /// What the joint does from rest: friction holds up to its limit, rounding left out.
    fn mode_from_rest(&self, torque: Torque<'_>) -> Mode {
        let torque = self.torque_at_joint(torque);
        let net = torque - self.arm.coupling_torque(&self.state);
        pushed(net, self.friction.at(0.0, self.state[0]), self.rounding(torque))
    }

    /// Torques below this are rounding of those that act \[N·m\].
    pub(in crate::rig) fn rounding(&self, torque: f64) -> f64 {
        let at_rest = self.friction.at(0.0, self.state[0]);
        let sliding = self.friction.sliding();
        let most = at_rest.forward().max(at_rest.backward());
        // The coupling torque of a stiff beam is a difference of angles that are nearly equal.
        let k = self.arm.dynamics().len();
        let angle = self.state[2..2 + k].iter().fold(self.state[0].abs(), |m, q| m.max(q.abs()));
        let coupling = 4.0 * f64::EPSILON * self.coupling_size * angle;
        let load = self.position_torque.largest_nm();
        coupling
            + ROUNDING * (torque.abs() + load + most.max(sliding.forward()).max(sliding.backward()))
    }

    /// Something at rest that was let go and does not start, as what pushes it is exactly at the
    /// limit, or was turned by a jump of the torque: decides anew.
    fn decide(&mut self, event: Event, torque: Torque<'_>, step: f64) -> f64 {
        let of_tip = matches!(event, Event::Tip(_));
        let at = if of_tip { self.tip_rate_index() } else { 1 };
        self.state[at] = 0.0;
        let again =
            if of_tip { self.tip_mode_from_rest(torque) } else { self.mode_from_rest(torque) };
        let mode = if of_tip { &mut self.tip_mode } else { &mut self.mode };
        if again != Mode::Stick && again != *mode {
            *mode = again;
            return 0.0;
        }
        *mode = Mode::Stick;
        self.pause(torque, step)
    }

    /// With the rest moving, what pushes goes on changing and what is at rest starts: holds it and
    /// moves on by the smallest useful time.
    pub(super) fn pause(&mut self, torque: Torque<'_>, step: f64) -> f64 {
        if self.state[1] == 0.0 && !self.friction.is_zero() {
            self.mode = Mode::Stick;
        }
        if self.state[self.tip_rate_index()] == 0.0 {
            self.tip_mode = Mode::Stick;
        }
        let pause = step.min(self.step_most_s * 1e-9).max(f64::MIN_POSITIVE);
        let (order, _) = self.fill(torque, pause);
        self.evaluate(order, pause);
        if self.mode == Mode::Stick {
            self.stuck_s += pause;
        }
        self.time_s += pause;
        self.leave_rest(torque);
        pause
    }
}

/// Where a push \[N·m or N\] moves what is at rest.
pub(super) fn pushed(push: f64, limits: Coulomb, rounding: f64) -> Mode {
    if push > limits.forward() + rounding {
        Mode::Forward
    } else if push < -limits.backward() - rounding {
        Mode::Backward
    } else {
        Mode::Stick
    }
}

/// When what sticks is let go: `push` as a polynomial in time leaves the limits.
fn leaves(push: &[f64], limits: Coulomb, step: f64, rounding: f64) -> Contact<Mode> {
    let room = |limit: f64, sign: f64| {
        let mut room = [0.0; ORDER_MOST + 1];
        for (r, p) in room.iter_mut().zip(push) {
            *r = -sign * p;
        }
        room[0] += limit;
        first_used_up(&room[..push.len()], step, rounding)
    };
    match (room(limits.forward(), 1.0), room(limits.backward(), -1.0)) {
        (Some(a), Some(b)) if b < a => Contact::Ends(b, Mode::Backward),
        (Some(a), _) => Contact::Ends(a, Mode::Forward),
        (None, Some(b)) => Contact::Ends(b, Mode::Backward),
        (None, None) => Contact::Lasts,
    }
}
