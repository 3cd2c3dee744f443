//! The replayed arm from event to event within a piece of a sample, by Taylor series.

use super::friction::{Ends, Held, sign};
use super::rates::Rates;
use super::replayed_motion::{INPUTS, Mover, ReplayedMotion, Torque, direction};
use super::series::{Ramp, Terms, reach_s, terms, value};
use crate::friction::Mode;
use crate::lti::first_root::{ORDER_MOST, first_used_up};

/// Events within one piece of a sample after which the joint is held until its end: it chatters.
const MOST_EVENTS: usize = 50;
/// Rounding of an acceleration, relative to the terms it is a sum of.
const ROUNDING: f64 = 1e-13;
/// Shortest stretch over which friction is taken for linear in time, over the piece.
const SHORTEST: f64 = 1.0 / 64.0;

/// A stretch that one series describes.
struct SeriesStretch<const D: usize> {
    series: Terms<D>,
    /// Net torque on the motor.
    net: Ramp,
    /// Derivatives of the torque by what it depends on.
    by: [Ramp; INPUTS],
    duration_s: f64,
    /// Friction's ends while it slips, with the responses to a torque and to a ramp at the end.
    friction: Option<(Ends, [f64; D], [f64; D])>,
}

impl<const D: usize> Mover<D> {
    /// Moves on over `duration_s` from event to event.
    pub(super) fn through_events(
        &self,
        motion: &mut ReplayedMotion<D>,
        torque: Torque,
        duration_s: f64,
    ) {
        let by = torque.by.map(|[from, to]| Ramp { from, slope: (to - from) / duration_s });
        let (mut done, mut events) = (0.0, 0);
        let whole = torque.ramp(duration_s);
        while done < duration_s {
            let left_s = duration_s - done;
            let ramp = whole.after(done);
            let most = self.reach_s(motion, ramp.from, left_s, SHORTEST * duration_s);
            let stretch = self.stretch(motion, ramp, by.map(|b| b.after(done)), most);
            let event = if events < MOST_EVENTS {
                self.event(motion.mode, &stretch.series, ramp, most)
            } else {
                None
            };
            let time_s = event.unwrap_or(most);
            self.series_tangents(motion, &stretch, time_s);
            let before = self.friction_torque(motion, ramp.from);
            motion.x = value(&stretch.series, time_s);
            let after = self.friction_torque(motion, ramp.after(time_s).from);
            motion.rub(0.5 * (before + after), time_s);
            if motion.mode == Mode::Stick {
                motion.stuck_s += time_s;
            }
            // The rest of the piece may be less than the rounding of its end.
            done = if event.is_none() && most >= left_s { duration_s } else { done + time_s };
            if event.is_some() {
                events += 1;
                self.pass(motion, ramp.after(time_s).from, events >= MOST_EVENTS);
            }
        }
    }

    /// How far one series reaches, with friction linear in time.
    fn reach_s(
        &self,
        motion: &ReplayedMotion<D>,
        torque: f64,
        left_s: f64,
        shortest_s: f64,
    ) -> f64 {
        let mut most = reach_s(self.rates(motion.mode)).min(left_s);
        while most > shortest_s && most > self.step_s(motion, torque, most) {
            most *= 0.5;
        }
        most
    }

    fn stretch(
        &self,
        motion: &ReplayedMotion<D>,
        torque: Ramp,
        by: [Ramp; INPUTS],
        duration_s: f64,
    ) -> SeriesStretch<D> {
        let rates = self.rates(motion.mode);
        let Some(direction) = direction(motion.mode) else {
            let series = terms(rates, &motion.x, torque, duration_s);
            return SeriesStretch { series, net: torque, by, duration_s, friction: None };
        };
        let mut net = torque.less(self.friction.torque(&motion.x, direction));
        let mut series = terms(rates, &motion.x, net, duration_s);
        let (mut push, mut ramp) = ([0.0; D], [0.0; D]);
        if !self.friction.terms.is_empty() {
            push = from_rest(rates, Ramp { from: 1.0, slope: 0.0 }, duration_s);
            ramp = from_rest(rates, Ramp { from: 0.0, slope: 1.0 / duration_s }, duration_s);
        }
        let held = Held {
            from: &motion.x,
            to: value(&series, duration_s),
            push: &push,
            ramp: &ramp,
            acceleration: self.acceleration(&motion.x, torque.from, direction),
            duration_s,
        };
        let ends = self.friction.over(&held, direction);
        if !self.friction.terms.is_empty() {
            let slope = torque.slope - (ends.to - ends.from) / duration_s;
            net = Ramp { from: torque.from - ends.from, slope };
            series = terms(rates, &motion.x, net, duration_s);
        }
        let friction = Some((ends, push, ramp));
        SeriesStretch { series, net, by, duration_s, friction }
    }

    fn rates(&self, mode: Mode) -> &Rates<D> {
        match mode {
            Mode::Forward => &self.phases.slip[0],
            Mode::Backward => &self.phases.slip[1],
            Mode::Stick => &self.phases.stick,
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
                    let net = torque.less(self.friction.torque(&series[0], direction));
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
        ROUNDING * (pulls + rates.b[1] * (torque.abs() + self.friction.coulomb.abs()))
    }

    /// From one mode to the next at an event, and what that does to the tangents.
    ///
    /// The event's time depends on the parameters: with f before and after it, tangents change by
    /// (f⁻ − f⁺)·dσ, and `dσ = −s_v/θ̈⁻` where the motor comes to rest. Only θ̈ jumps: s_v becomes
    /// zero in a stick and is multiplied by θ̈⁺/θ̈⁻ in a reversal. Let go, θ̈ begins at zero, and
    /// nothing jumps.
    fn pass(&self, motion: &mut ReplayedMotion<D>, torque: f64, chatters: bool) {
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
        motion.tangents.scale(1, ratio);
    }

    fn series_tangents(
        &self,
        motion: &mut ReplayedMotion<D>,
        stretch: &SeriesStretch<D>,
        time_s: f64,
    ) {
        if motion.tangents.is_empty() {
            return;
        }
        let rates = self.rates(motion.mode);
        let torques = self.torques_by(motion, stretch);
        motion.tangents.along(rates, &stretch.series, stretch.net, time_s);
        let push = from_rest(rates, Ramp { from: 1.0, slope: 0.0 }, time_s);
        let slope = from_rest(rates, Ramp { from: 0.0, slope: 1.0 }, time_s);
        for (k, torque) in torques {
            motion.tangents.add(k, torque.from, &push);
            motion.tangents.add(k, torque.slope, &slope);
        }
    }

    /// Derivatives of the net torque by the unknowns that it depends on.
    fn torques_by(
        &self,
        motion: &ReplayedMotion<D>,
        stretch: &SeriesStretch<D>,
    ) -> Vec<(usize, Ramp)> {
        let inputs = self.columns.inputs.iter().zip(stretch.by);
        let mut found: Vec<_> = inputs.filter_map(|(k, by)| Some(((*k)?, by))).collect();
        let Some((ends, push, ramp)) = &stretch.friction else { return found };
        // Constant friction asks for nothing at its end.
        let end = (!self.friction.terms.is_empty()).then(|| {
            let mut end = motion.tangents.clone();
            let rates = self.rates(motion.mode);
            end.along(rates, &stretch.series, stretch.net, stretch.duration_s);
            end
        });
        for (k, own) in &self.columns.friction {
            let input = self.columns.inputs.iter().position(|input| *input == Some(*k));
            let own_ramp = input.map_or(Ramp::NONE, |input| stretch.by[input]);
            let end_of = |from: f64| {
                let Some(end) = &end else { return [0.0; 2] };
                let (end, rises) = (end.motor(*k), own_ramp.slope * stretch.duration_s);
                [0, 1].map(|i| end[i] + (own_ramp.from - from) * push[i] + (rises + from) * ramp[i])
            };
            let start = motion.tangents.motor(*k);
            let [from, to] = self.friction.tangent(ends, *own, &start, end_of);
            found.push((*k, Ramp { from: -from, slope: (from - to) / stretch.duration_s }));
        }
        found
    }
}

/// State after `time_s` from rest under a torque alone.
fn from_rest<const D: usize>(rates: &Rates<D>, torque: Ramp, time_s: f64) -> [f64; D] {
    value(&terms(rates, &[0.0; D], torque, time_s), time_s)
}
