//! The replayed arm in motion: stick, slip, the events between them, and the tangents.

use super::rates::{Phases, Rates};
use super::series::{Ramp, Terms, add, reach_s, tangent, terms, times, value};
use super::transition::Transition;
use crate::lti::first_root::{ORDER_MOST, first_used_up};
use crate::rig::Mode;

/// Events within one piece of a sample after which the joint is held until its end: it chatters.
const MOST_EVENTS: usize = 50;
/// Rounding of an acceleration, relative to the terms it is a sum of.
const ROUNDING: f64 = 1e-13;

/// Which tangent is which: those of the matrices' parameters come first, then those of the torque,
/// the lag, and the initial state.
#[derive(Debug, Clone, Copy)]
pub(super) struct Columns {
    pub(super) coulomb: Option<usize>,
    pub(super) offset: Option<usize>,
    pub(super) lag: Option<usize>,
    /// First column of the initial state.
    pub(super) initial: usize,
}

/// The motor's torque over a piece of a sample, linear in time \[N·m\].
#[derive(Debug, Clone, Copy)]
pub(super) struct Torque {
    pub(super) from: f64,
    pub(super) to: f64,
    /// d/dlag of both \[N·m/s\].
    pub(super) by_lag: [f64; 2],
}

impl Torque {
    pub(super) fn held(torque: f64) -> Self {
        Self { from: torque, to: torque, by_lag: [0.0; 2] }
    }
    fn ramp(self, duration_s: f64) -> Ramp {
        Ramp { from: self.from, slope: (self.to - self.from) / duration_s }
    }
}

/// The arm at one set of parameters, ready to move over pieces of given durations.
#[derive(Debug, Clone)]
pub(super) struct Mover<const D: usize> {
    pub(super) phases: Phases<D>,
    pub(super) coulomb: f64,
    pub(super) offset: f64,
    pub(super) columns: Columns,
    /// Forward, backward, stuck: for each duration.
    pub(super) pieces: Vec<[Transition<D>; 3]>,
}

/// State, mode and tangents.
#[derive(Debug, Clone)]
pub(super) struct Motion<const D: usize> {
    pub(super) x: [f64; D],
    pub(super) tangents: Vec<[f64; D]>,
    pub(super) mode: Mode,
    /// Time spent stuck \[s\].
    pub(super) stuck_s: f64,
    /// ∫ friction's torque dt \[N·m·s\], where it is wanted.
    pub(super) friction_impulse: Option<f64>,
}

impl<const D: usize> Motion<D> {
    fn rub(&mut self, mean_torque: f64, duration_s: f64) {
        if let Some(impulse) = &mut self.friction_impulse {
            *impulse += mean_torque * duration_s;
        }
    }
}

/// Forward is +1, backward −1.
fn sign(direction: usize) -> f64 {
    if direction == 0 { 1.0 } else { -1.0 }
}

impl<const D: usize> Mover<D> {
    /// Adds the transitions for one more duration and gives its number.
    pub(super) fn prepare(&mut self, duration_s: f64) -> usize {
        let of = |rates: &Rates<D>| Transition::new(rates, duration_s);
        let [forward, backward] = &self.phases.slip;
        self.pieces.push([of(forward), of(backward), of(&self.phases.stick)]);
        self.pieces.len() - 1
    }

    /// Signed friction torque while slipping.
    fn friction(&self, direction: usize) -> f64 {
        sign(direction) * self.coulomb + self.offset
    }

    /// Acceleration that the motor has, or would have, slipping in `direction` under `torque`.
    pub(super) fn acceleration(&self, x: &[f64; D], torque: f64, direction: usize) -> f64 {
        let rates = &self.phases.slip[direction];
        let pull: f64 = rates.a[1].iter().zip(x).map(|(a, x)| a * x).sum();
        pull + rates.b[1] * (torque - self.friction(direction))
    }

    /// Friction's torque on the motor now: what holds it, or what it slips against.
    pub(super) fn friction_torque(&self, motion: &Motion<D>, torque: f64) -> f64 {
        match motion.mode {
            Mode::Forward => self.friction(0),
            Mode::Backward => self.friction(1),
            Mode::Stick => self.held(&motion.x, torque),
        }
    }

    /// The torque that holds a stuck motor.
    fn held(&self, x: &[f64; D], torque: f64) -> f64 {
        self.acceleration(x, torque, 0) / self.phases.slip[0].b[1] + self.friction(0)
    }

    /// The motor's acceleration now.
    pub(super) fn motor_acceleration(&self, motion: &Motion<D>, torque: f64) -> f64 {
        match motion.mode {
            Mode::Stick => 0.0,
            Mode::Forward => self.acceleration(&motion.x, torque, 0),
            Mode::Backward => self.acceleration(&motion.x, torque, 1),
        }
    }

    /// Moves on over prepared piece number `piece`.
    pub(super) fn advance(&self, motion: &mut Motion<D>, piece: usize, torque: Torque) {
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
    fn settle(&self, motion: &mut Motion<D>, torque: f64) {
        if motion.x[1] == 0.0 {
            motion.mode = self.mode_at_rest(&motion.x, torque);
        }
    }

    fn mode_at_rest(&self, x: &[f64; D], torque: f64) -> Mode {
        if self.acceleration(x, torque, 0) > 0.0 {
            Mode::Forward
        } else if self.acceleration(x, torque, 1) < 0.0 {
            Mode::Backward
        } else {
            Mode::Stick
        }
    }

    /// Tries a whole piece without leaving the stick.
    fn stays(&self, motion: &mut Motion<D>, piece: &Transition<D>, torque: Torque) -> bool {
        let next = times(&piece.own.phi, &motion.x);
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
        motion: &mut Motion<D>,
        piece: &Transition<D>,
        torque: Torque,
        direction: usize,
    ) -> bool {
        let sign = sign(direction);
        let net = torque.from - self.friction(direction);
        let change = torque.to - torque.from;
        let next = piece.own.apply(&motion.x, net, change);
        let keeps = sign * next[1] > 0.0 && sign * motion.x[1] > 0.0;
        // It may dip below zero and come back where it falls first and rises last.
        let dips = || {
            sign * self.acceleration(&motion.x, torque.from, direction) < 0.0
                && sign * self.acceleration(&next, torque.to, direction) > 0.0
        };
        if !keeps || dips() {
            return false;
        }
        self.move_tangents(motion, piece, Some((direction, net, change, torque.by_lag)));
        motion.rub(self.friction(direction), piece.duration_s);
        motion.x = next;
        true
    }

    /// Tangents over a whole piece; `slip` is the direction, the net torque and its change.
    fn move_tangents(
        &self,
        motion: &mut Motion<D>,
        piece: &Transition<D>,
        slip: Option<(usize, f64, f64, [f64; 2])>,
    ) {
        let columns = self.columns;
        let (net, change) = slip.map_or((0.0, 0.0), |s| (s.1, s.2));
        for (k, s) in motion.tangents.iter_mut().enumerate() {
            *s = times(&piece.own.phi, s);
            if let Some(by) = piece.by_parameter.get(k) {
                let own = by.apply(&motion.x, net, change);
                add(s, 1.0, &own);
            }
        }
        let Some((direction, _, _, by_lag)) = slip else { return };
        if let Some(k) = columns.coulomb {
            add(&mut motion.tangents[k], -sign(direction), &piece.own.push);
        }
        if let Some(k) = columns.offset {
            add(&mut motion.tangents[k], -1.0, &piece.own.push);
        }
        if let Some(k) = columns.lag
            && by_lag.iter().any(|b| *b != 0.0)
        {
            add(&mut motion.tangents[k], by_lag[0], &piece.own.push);
            add(&mut motion.tangents[k], by_lag[1] - by_lag[0], &piece.own.ramp);
        }
    }

    /// Moves on over `duration_s` from event to event.
    fn through_events(&self, motion: &mut Motion<D>, torque: Torque, duration_s: f64) {
        let by_lag = Ramp {
            from: torque.by_lag[0],
            slope: (torque.by_lag[1] - torque.by_lag[0]) / duration_s,
        };
        let (mut done, mut events) = (0.0, 0);
        let whole = torque.ramp(duration_s);
        while done < duration_s {
            let ramp = whole.after(done);
            let rates = self.rates(motion.mode);
            let net = self.net(motion.mode, ramp);
            let series = terms(rates, &motion.x, net);
            let most = reach_s(rates).min(duration_s - done);
            let event = if events < MOST_EVENTS {
                self.event(motion.mode, &series, ramp, most)
            } else {
                None
            };
            let time_s = event.unwrap_or(most);
            self.series_tangents(motion, &series, net, by_lag.after(done), time_s);
            let before = self.friction_torque(motion, ramp.from);
            motion.x = value(&series, time_s);
            let after = self.friction_torque(motion, ramp.after(time_s).from);
            motion.rub(0.5 * (before + after), time_s);
            if motion.mode == Mode::Stick {
                motion.stuck_s += time_s;
            }
            // The rest of the piece may be less than the rounding of its end.
            done = if event.is_none() && most >= duration_s - done {
                duration_s
            } else {
                done + time_s
            };
            if event.is_some() {
                events += 1;
                self.pass(motion, ramp.after(time_s).from, events >= MOST_EVENTS);
            }
        }
    }

    fn rates(&self, mode: Mode) -> &Rates<D> {
        match mode {
            Mode::Forward => &self.phases.slip[0],
            Mode::Backward => &self.phases.slip[1],
            Mode::Stick => &self.phases.stick,
        }
    }

    fn net(&self, mode: Mode, torque: Ramp) -> Ramp {
        match mode {
            Mode::Forward => torque.less(self.friction(0)),
            Mode::Backward => torque.less(self.friction(1)),
            Mode::Stick => torque,
        }
    }

    /// Time within `most` at which the motor comes to rest or is let go.
    fn event(&self, mode: Mode, series: &Terms<D>, torque: Ramp, most: f64) -> Option<f64> {
        let mut c = [0.0; ORDER_MOST + 1];
        match mode {
            Mode::Stick => {
                let let_go = |direction: usize| {
                    let mut c = [0.0; ORDER_MOST + 1];
                    let rates = &self.phases.slip[direction];
                    let s = sign(direction);
                    for (c, x) in c.iter_mut().zip(series) {
                        *c = -s * rates.a[1].iter().zip(x).map(|(a, x)| a * x).sum::<f64>();
                    }
                    let net = torque.less(self.friction(direction));
                    c[0] -= s * rates.b[1] * net.from;
                    c[1] -= s * rates.b[1] * net.slope;
                    first_used_up(&c, most, self.rounding(&series[0], torque.from))
                };
                let (a, b) = (let_go(0), let_go(1));
                match (a, b) {
                    (Some(a), Some(b)) => Some(a.min(b)),
                    (a, b) => a.or(b),
                }
            }
            Mode::Forward | Mode::Backward => {
                let s = if mode == Mode::Forward { 1.0 } else { -1.0 };
                for (c, x) in c.iter_mut().zip(series) {
                    *c = s * x[1];
                }
                first_used_up(&c, most, self.rounding(&series[0], torque.from) * most)
            }
        }
    }

    /// Rounding of the motor's acceleration at `x` under `torque`.
    fn rounding(&self, x: &[f64; D], torque: f64) -> f64 {
        let rates = &self.phases.slip[0];
        let pulls = rates.a[1].iter().zip(x).map(|(a, x)| (a * x).abs()).sum::<f64>();
        ROUNDING * (pulls + rates.b[1] * (torque.abs() + self.coulomb.abs()))
    }

    /// From one mode to the next at an event, and what that does to the tangents.
    ///
    /// The event's time depends on the parameters: with f before and after it, tangents change by
    /// (f⁻ − f⁺)·dσ, and `dσ = −s_v/θ̈⁻` where the motor comes to rest. Only θ̈ jumps: s_v becomes
    /// zero in a stick and is multiplied by θ̈⁺/θ̈⁻ in a reversal. Let go, θ̈ begins at zero, and
    /// nothing jumps.
    fn pass(&self, motion: &mut Motion<D>, torque: f64, chatters: bool) {
        if motion.mode == Mode::Stick {
            // At the threshold itself rounding decides the sign: the side nearer to it lets go.
            let forward = self.acceleration(&motion.x, torque, 0);
            let backward = -self.acceleration(&motion.x, torque, 1);
            motion.mode = if forward >= backward { Mode::Forward } else { Mode::Backward };
            return;
        }
        let before = self.motor_acceleration(motion, torque);
        motion.x[1] = 0.0;
        motion.mode = if chatters { Mode::Stick } else { self.mode_at_rest(&motion.x, torque) };
        let after = self.motor_acceleration(motion, torque);
        let ratio = if before == 0.0 { 0.0 } else { after / before };
        for s in &mut motion.tangents {
            s[1] *= ratio;
        }
    }

    fn series_tangents(
        &self,
        motion: &mut Motion<D>,
        series: &Terms<D>,
        net: Ramp,
        by_lag: Ramp,
        time_s: f64,
    ) {
        let rates = self.rates(motion.mode);
        let constant = |from: f64| Ramp { from, slope: 0.0 };
        let (direction, slipping) = match motion.mode {
            Mode::Forward => (1.0, 1.0),
            Mode::Backward => (-1.0, 1.0),
            Mode::Stick => (0.0, 0.0),
        };
        for (k, s) in motion.tangents.iter_mut().enumerate() {
            let net_by = if self.columns.coulomb == Some(k) {
                constant(-direction)
            } else if self.columns.offset == Some(k) {
                constant(-slipping)
            } else if self.columns.lag == Some(k) {
                by_lag
            } else {
                constant(0.0)
            };
            let by = rates.by_parameter.get(k);
            *s = tangent(rates, series, net, s, by, net_by, time_s);
        }
    }

    /// Under a torque that jumps from `before` to `after` at an instant that the lag moves.
    pub(super) fn jump(&self, motion: &mut Motion<D>, before: f64, after: f64) {
        let Some(k) = self.columns.lag else { return };
        let old = self.motor_acceleration(motion, before);
        self.settle(motion, after);
        let new = self.motor_acceleration(motion, after);
        motion.tangents[k][1] += old - new;
    }
}
