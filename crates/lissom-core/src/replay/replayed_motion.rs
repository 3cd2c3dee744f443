//! The replayed arm in motion: whole pieces of samples stuck or slipping, and their tangents.

use super::friction::{Ends, Friction, Held, sign};
use super::parameter::Parameter;
use super::rates::{Phases, Rates};
use super::series::{Ramp, add};
use super::tangents::Tangents;
use super::transition::Transition;
use crate::friction::Mode;

/// Halvings of a piece, at most, where friction changes with speed or angle.
const HALVINGS: usize = 6;

/// Places of the unknowns that the torque depends on whatever the motor does: the command's lag, g_s and g_c.
pub(super) const BY_LAG: usize = 0;
pub(super) const BY_SINE: usize = 1;
pub(super) const BY_COSINE: usize = 2;
pub(super) const INPUTS: usize = 3;

/// Unknowns whose tangents the torque on the motor moves.
#[derive(Debug, Clone)]
pub(super) struct Columns {
    /// Those that friction changes with, and the parameters of its own among them.
    pub(super) friction: Vec<(usize, Option<Parameter>)>,
    /// Those that the torque itself depends on: [`BY_LAG`] and so on.
    pub(super) inputs: [Option<usize>; INPUTS],
}

/// The motor's torque over a piece of a sample, linear in time \[N·m\].
#[derive(Debug, Clone, Copy)]
pub(super) struct Torque {
    pub(super) from: f64,
    pub(super) to: f64,
    /// Derivatives of both by the command's lag \[N·m/s\], g_s and g_c.
    pub(super) by: [[f64; 2]; INPUTS],
}

impl Torque {
    pub(super) fn held(torque: f64) -> Self {
        Self { from: torque, to: torque, by: [[0.0; 2]; INPUTS] }
    }
    pub(super) fn ramp(self, duration_s: f64) -> Ramp {
        Ramp { from: self.from, slope: (self.to - self.from) / duration_s }
    }
    /// Between two shares of its duration.
    pub(super) fn part(self, from: f64, to: f64) -> Self {
        let between = |[a, b]: [f64; 2]| [from, to].map(|share| a + share * (b - a));
        let [from_nm, to_nm] = between([self.from, self.to]);
        Self { from: from_nm, to: to_nm, by: self.by.map(between) }
    }
}

/// The arm at one set of parameters, ready to move over pieces of given durations.
#[derive(Debug, Clone)]
pub(super) struct Mover<const D: usize> {
    pub(super) phases: Phases<D>,
    pub(super) friction: Friction,
    pub(super) columns: Columns,
    /// Forward, backward, stuck: for each duration, and for its halves where friction needs them.
    pub(super) pieces: Vec<[Transition<D>; 3]>,
}

/// What moves the motor over a piece in which it slips.
struct Slip {
    direction: usize,
    /// The torque that friction leaves at the beginning, and its change \[N·m\].
    net: f64,
    change: f64,
    /// [`Torque::by`].
    by: [[f64; 2]; INPUTS],
    /// Friction at both ends, where it changes.
    ends: Option<Ends>,
}

/// State, mode and tangents.
#[derive(Debug, Clone)]
pub(super) struct ReplayedMotion<const D: usize> {
    pub(super) x: [f64; D],
    pub(super) tangents: Tangents<D>,
    pub(super) mode: Mode,
    /// Time spent stuck \[s\].
    pub(super) stuck_s: f64,
    /// ∫ friction's torque dt \[N·m·s\], where it is wanted.
    pub(super) friction_impulse: Option<f64>,
}

impl<const D: usize> ReplayedMotion<D> {
    pub(super) fn rub(&mut self, mean_torque: f64, duration_s: f64) {
        if let Some(impulse) = &mut self.friction_impulse {
            *impulse += mean_torque * duration_s;
        }
    }
}

/// Which way it slips: 0 forward, 1 backward.
pub(super) fn direction(mode: Mode) -> Option<usize> {
    match mode {
        Mode::Forward => Some(0),
        Mode::Backward => Some(1),
        Mode::Stick => None,
    }
}

impl<const D: usize> Mover<D> {
    /// Adds the transitions for one more duration and gives its number; those of its halves follow.
    pub(super) fn prepare(&mut self, duration_s: f64) -> usize {
        let first = self.pieces.len();
        for halvings in 0..=self.halvings() {
            let part_s = duration_s / f64::from(1_u32 << halvings);
            let of = |rates: &Rates<D>| Transition::new(rates, part_s);
            let [forward, backward] = &self.phases.slip;
            self.pieces.push([of(forward), of(backward), of(&self.phases.stick)]);
        }
        first
    }

    pub(super) fn halvings(&self) -> usize {
        if self.friction.terms.is_empty() { 0 } else { HALVINGS }
    }

    /// Acceleration that the motor has, or would have, slipping in `direction` under `torque`.
    pub(super) fn acceleration(&self, x: &[f64; D], torque: f64, direction: usize) -> f64 {
        let rates = &self.phases.slip[direction];
        let pull: f64 = rates.a[1].iter().zip(x).map(|(a, x)| a * x).sum();
        pull + rates.b[1] * (torque - self.friction.torque(x, direction))
    }

    /// Friction's torque on the motor now: what holds it, or what it slips against.
    pub(super) fn friction_torque(&self, motion: &ReplayedMotion<D>, torque: f64) -> f64 {
        match motion.mode {
            Mode::Forward => self.friction.torque(&motion.x, 0),
            Mode::Backward => self.friction.torque(&motion.x, 1),
            Mode::Stick => self.held(&motion.x, torque),
        }
    }

    /// The torque that holds a stuck motor.
    fn held(&self, x: &[f64; D], torque: f64) -> f64 {
        self.acceleration(x, torque, 0) / self.phases.slip[0].b[1] + self.friction.torque(x, 0)
    }

    /// The motor's acceleration now.
    pub(super) fn motor_acceleration(&self, motion: &ReplayedMotion<D>, torque: f64) -> f64 {
        let Some(direction) = direction(motion.mode) else { return 0.0 };
        self.acceleration(&motion.x, torque, direction)
    }

    /// Moves on over prepared piece number `piece`, in parts where friction changes on the way.
    pub(super) fn advance(&self, motion: &mut ReplayedMotion<D>, piece: usize, torque: Torque) {
        if self.halvings() == 0 {
            self.part(motion, piece, torque);
            return;
        }
        let all = 1_usize << HALVINGS;
        let share = |parts: usize| parts as f64 / all as f64;
        let mut done = 0;
        while done < all {
            self.settle(motion, torque.part(share(done), 1.0).from);
            let halvings = (0..HALVINGS).find(|h| {
                let duration_s = self.pieces[piece + h][2].duration_s;
                let now = torque.part(share(done), 1.0).from;
                done % (all >> h) == 0 && duration_s <= self.step_s(motion, now, duration_s)
            });
            let halvings = halvings.unwrap_or(HALVINGS);
            let next = done + (all >> halvings);
            self.part(motion, piece + halvings, torque.part(share(done), share(next)));
            done = next;
        }
    }

    /// Longest step within `within_s` over which friction may be taken for linear in time.
    pub(super) fn step_s(&self, motion: &ReplayedMotion<D>, torque: f64, within_s: f64) -> f64 {
        let Some(direction) = direction(motion.mode) else { return f64::INFINITY };
        let acceleration = self.acceleration(&motion.x, torque, direction);
        let pushed = (acceleration, self.phases.slip[direction].b[1]);
        self.friction.step_s(&motion.x, direction, pushed, within_s)
    }

    fn part(&self, motion: &mut ReplayedMotion<D>, piece: usize, torque: Torque) {
        self.settle(motion, torque.from);
        let transitions = &self.pieces[piece];
        let done = match motion.mode {
            Mode::Stick => self.stays(motion, &transitions[2], torque),
            Mode::Forward => self.slips(motion, &transitions[0], torque, 0),
            Mode::Backward => self.slips(motion, &transitions[1], torque, 1),
        };
        if !done {
            self.through_events(motion, torque, transitions[2].duration_s);
        }
    }

    /// A motor at rest under a torque that has just changed: held or let go.
    fn settle(&self, motion: &mut ReplayedMotion<D>, torque: f64) {
        if motion.x[1] == 0.0 {
            motion.mode = self.mode_at_rest(&motion.x, torque);
        }
    }

    pub(super) fn mode_at_rest(&self, x: &[f64; D], torque: f64) -> Mode {
        if self.acceleration(x, torque, 0) > 0.0 {
            Mode::Forward
        } else if self.acceleration(x, torque, 1) < 0.0 {
            Mode::Backward
        } else {
            Mode::Stick
        }
    }

    /// Tries a whole piece without leaving the stick.
    fn stays(&self, motion: &mut ReplayedMotion<D>, piece: &Transition<D>, torque: Torque) -> bool {
        let next = piece.own.apply(&motion.x, 0.0, 0.0);
        let held = self.acceleration(&next, torque.to, 0) <= 0.0
            && self.acceleration(&next, torque.to, 1) >= 0.0;
        if held {
            self.move_tangents(motion, piece, None);
            if motion.friction_impulse.is_some() {
                let ends = self.held(&motion.x, torque.from) + self.held(&next, torque.to);
                motion.rub(0.5 * ends, piece.duration_s);
            }
            motion.x = next;
            motion.stuck_s += piece.duration_s;
        }
        held
    }

    /// Tries a whole piece without a reversal.
    fn slips(
        &self,
        motion: &mut ReplayedMotion<D>,
        piece: &Transition<D>,
        torque: Torque,
        direction: usize,
    ) -> bool {
        let sign = sign(direction);
        let first = self.friction.torque(&motion.x, direction);
        let change = torque.to - torque.from;
        let mut next = piece.own.apply(&motion.x, torque.from - first, change);
        let mut slip =
            Slip { direction, net: torque.from - first, change, by: torque.by, ends: None };
        let mut mean = first;
        if !self.friction.terms.is_empty() {
            let ends = self.friction.over(
                &Held {
                    from: &motion.x,
                    to: next,
                    push: &piece.own.push,
                    ramp: &piece.own.ramp,
                    acceleration: self.acceleration(&motion.x, torque.from, direction),
                    duration_s: piece.duration_s,
                },
                direction,
            );
            let rises = ends.to - ends.from;
            add(&mut next, first - ends.from, &piece.own.push);
            add(&mut next, -rises, &piece.own.ramp);
            mean = 0.5 * (ends.from + ends.to);
            slip = Slip { net: torque.from - ends.from, change: change - rises, ..slip };
            slip.ends = Some(ends);
        }
        let keeps = sign * next[1] > 0.0 && sign * motion.x[1] > 0.0;
        // It may dip below zero and come back where it falls first and rises last.
        let dips = || {
            sign * self.acceleration(&motion.x, torque.from, direction) < 0.0
                && sign * self.acceleration(&next, torque.to, direction) > 0.0
        };
        if !keeps || dips() {
            return false;
        }
        self.move_tangents(motion, piece, Some(&slip));
        motion.rub(mean, piece.duration_s);
        motion.x = next;
        true
    }

    /// Tangents over a whole piece, stuck or slipping.
    fn move_tangents(
        &self,
        motion: &mut ReplayedMotion<D>,
        piece: &Transition<D>,
        slip: Option<&Slip>,
    ) {
        let (net, change) = slip.map_or((0.0, 0.0), |s| (s.net, s.change));
        motion.tangents.over(piece, &motion.x, net, change);
        let Some(slip) = slip.filter(|_| !motion.tangents.is_empty()) else {
            return;
        };
        let (push, ramp) = (&piece.own.push, &piece.own.ramp);
        for (k, [from, to]) in self.columns.inputs.iter().zip(slip.by) {
            if let Some(k) = *k
                && (from != 0.0 || to != 0.0)
            {
                motion.tangents.add(k, from, push);
                motion.tangents.add(k, to - from, ramp);
            }
        }
        for (k, own) in &self.columns.friction {
            let Some(ends) = &slip.ends else {
                let by = own.map_or(0.0, |p| self.friction.by(p, &motion.x, slip.direction));
                motion.tangents.add(*k, -by, push);
                continue;
            };
            let (start, end) = (motion.tangents.before(*k), motion.tangents.motor(*k));
            let [from, to] = self.friction.tangent(ends, *own, &start, |from| {
                [0, 1].map(|i| end[i] - from * (push[i] - ramp[i]))
            });
            motion.tangents.add(*k, -from, push);
            motion.tangents.add(*k, from - to, ramp);
        }
    }

    /// Under a torque that jumps from `before` to `after` at an instant that the lag moves.
    pub(super) fn jump(&self, motion: &mut ReplayedMotion<D>, before: f64, after: f64) {
        let Some(k) = self.columns.inputs[BY_LAG] else { return };
        let old = self.motor_acceleration(motion, before);
        self.settle(motion, after);
        let new = self.motor_acceleration(motion, after);
        *motion.tangents.entry(1, k) += old - new;
    }
}
