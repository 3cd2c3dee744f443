//! Replay of one stretch of a run: its logged command drives the arm, and the result is
//! compared with its logged angles.

use std::ops::RangeInclusive;

use super::friction::Friction;
use super::lanes::LANES;
use super::modal_arm::ModalArm;
use super::parameter::{Enters, Parameter};
use super::rates::Phases;
use super::replayed_motion::{
    BY_COSINE, BY_LAG, BY_SINE, Columns, INPUTS, Mover, ReplayedMotion, Torque, direction,
};
use super::tangents::Tangents;
use crate::friction::Mode;
use crate::load::GravityLoad;
use crate::record::{Channels, Hold, Run, TipQuantity};

/// Where a part of a sample is no longer one: shares of the sample time below this count as none.
const SHARE: f64 = 1e-9;

/// One arm with its derivatives by some parameters, ready to replay runs of one sample time.
#[derive(Debug, Clone)]
pub(super) struct Replayer<'a, const D: usize> {
    mover: Mover<D>,
    channels: &'a Channels,
    parameters: &'a [Parameter],
    arm: &'a ModalArm,
    /// Whether tangents of unit changes of the state follow those of the unknowns.
    with_units: bool,
    sample_time_s: f64,
    /// Whole samples and the share of one by which the command acts later.
    lag_samples: isize,
    lag_share: f64,
    /// Pieces of a sample: before and after the lagging command's change, or one.
    pieces: [Option<usize>; 2],
    torque_per_command: f64,
}

/// What is seen at one sample.
pub(super) struct Seen<'m, const D: usize> {
    pub(super) sample: usize,
    pub(super) motion: &'m mut ReplayedMotion<D>,
    /// Torque that acts just before the sample, that of position taken off \[N·m\].
    pub(super) torque: f64,
    /// Sine and cosine of the logged angle, where gravity acts.
    pub(super) waves: Option<[f64; 2]>,
}

/// The first place behind a row of `unknowns` and one number more, which is a whole number of [`LANES`].
fn units(unknowns: usize) -> usize {
    (unknowns + 1).next_multiple_of(LANES)
}

impl<'a, const D: usize> Replayer<'a, D> {
    pub(super) fn new(
        arm: &'a ModalArm,
        parameters: &'a [Parameter],
        channels: &'a Channels,
        sample_time_s: f64,
        with_units: bool,
    ) -> Self {
        let phases = Phases::new(arm, parameters);
        let friction = Friction::new(arm);
        let rubs = |p: &Parameter| p.enters(arm) == Enters::Friction;
        let own = |k: usize| (k, parameters.get(k).copied().filter(rubs));
        let unknowns = parameters.len() + D + channels.tips.len();
        let units = if with_units { units(unknowns)..units(unknowns) + D } else { 0..0 };
        let mut by = (0..unknowns).chain(units).map(own).collect::<Vec<_>>();
        if friction.terms.is_empty() {
            by.retain(|(_, own)| own.is_some());
        }
        let place = |parameter| parameters.iter().position(|p| *p == parameter);
        let mut inputs = [None; INPUTS];
        inputs[BY_LAG] = place(Parameter::CommandLag);
        inputs[BY_SINE] = place(Parameter::GravitySine);
        inputs[BY_COSINE] = place(Parameter::GravityCosine);
        let columns = Columns { friction: by, inputs };
        let mut mover = Mover { phases, friction, columns, pieces: Vec::new() };
        let samples = arm.command_lag_s / sample_time_s;
        let held = channels.command.hold == Hold::Sampled;
        let (mut lag_samples, mut lag_share) = (samples.floor(), samples - samples.floor());
        if lag_share > 1.0 - SHARE {
            (lag_samples, lag_share) = (lag_samples + 1.0, 0.0);
        }
        let pieces = if held && lag_share > SHARE {
            let before = mover.prepare(lag_share * sample_time_s);
            [Some(before), Some(mover.prepare((1.0 - lag_share) * sample_time_s))]
        } else {
            [None, Some(mover.prepare(sample_time_s))]
        };
        Self {
            mover,
            channels,
            parameters,
            arm,
            with_units,
            sample_time_s,
            lag_samples: lag_samples as isize,
            lag_share,
            pieces,
            torque_per_command: channels.command.torque_per_command.unwrap_or(1.0),
        }
    }

    /// Torque of the logged sample `index`; beyond the log's ends its first and last.
    fn torque(&self, run: &Run, index: isize) -> f64 {
        let last = run.len().cast_signed() - 1;
        self.torque_per_command * run.command()[index.clamp(0, last).cast_unsigned()]
    }

    /// Measured torque at sample `index` for lines between samples: the mean over each interval is that of the cubic polynomial
    /// through the four samples around it, `(−1, 13, 13, −1)/24`. Lines between the samples themselves would take `(ωT)²/12`
    /// from a torque at the frequency ω.
    fn drawn(&self, run: &Run, index: isize) -> f64 {
        let [before, at, after] = [index - 1, index, index + 1].map(|i| self.torque(run, i));
        at - (before - 2.0 * at + after) / 12.0
    }

    /// Replays samples `range` from the state `start`; `see` is called at each of them.
    pub(super) fn walk(
        &self,
        run: &Run,
        range: RangeInclusive<usize>,
        start: [f64; D],
        with_tangents: bool,
        mut see: impl FnMut(&mut Seen<'_, D>),
    ) -> ReplayedMotion<D> {
        let shared = self.parameters.len();
        let (unknowns, units) = (self.unknowns(), self.units());
        let mut tangents = Tangents::new(match (with_tangents, self.with_units) {
            (_, true) => units + D,
            (true, false) => unknowns,
            (false, false) => 0,
        });
        if with_tangents {
            tangents.set_units(shared);
        }
        if self.with_units {
            tangents.set_units(units);
        }
        let mode = Mode::of(start[1]);
        let friction_impulse = (!with_tangents).then_some(0.0);
        let mut motion =
            ReplayedMotion { x: start, tangents, mode, stuck_s: 0.0, friction_impulse };
        let (first, last) = (*range.start(), *range.end());
        for sample in first..=last {
            let waves = self.waves(run, sample);
            let torque = self.before(run, sample) - self.load(run, sample, waves);
            see(&mut Seen { sample, motion: &mut motion, torque, waves });
            if sample < last {
                self.sample(run, sample, &mut motion);
            }
        }
        motion
    }

    /// Sine and cosine of the logged angle at sample `k`, where gravity acts.
    fn waves(&self, run: &Run, k: usize) -> Option<[f64; 2]> {
        self.arm.gravity.map(|_| run.motor()[k].sin_cos().into())
    }

    /// Torque of gravity and torque ripples at sample `k`, where `waves` are [`Self::waves`].
    fn load(&self, run: &Run, k: usize, waves: Option<[f64; 2]>) -> f64 {
        let torque = |(g, [sin, cos]): (GravityLoad, [f64; 2])| g.sine_nm * sin + g.cosine_nm * cos;
        let ripples = self.arm.torque_ripples.iter().map(|r| r.torque_nm(run.motor()[k]));
        self.arm.gravity.zip(waves).map_or(0.0, torque) + ripples.sum::<f64>()
    }

    /// A torque over sample `k`, that of gravity and torque ripples taken off.
    fn less_load(&self, run: &Run, k: usize, torque: Torque) -> Torque {
        let [now, next] = [k, k + 1].map(|k| self.waves(run, k));
        let mut less = torque;
        less.from -= self.load(run, k, now);
        less.to -= self.load(run, k + 1, next);
        if let (Some([sin, cos]), Some([next_sin, next_cos])) = (now, next) {
            less.by[BY_SINE] = [-sin, -next_sin];
            less.by[BY_COSINE] = [-cos, -next_cos];
        }
        less
    }

    /// Torque of the command just before sample `k`.
    fn before(&self, run: &Run, k: usize) -> f64 {
        let at = k.cast_signed() - self.lag_samples;
        match self.channels.command.hold {
            Hold::Sampled => self.torque(run, at - 1),
            Hold::Measured => self.between(run, at).0,
        }
    }

    /// Measured torque at the lagging time of index `at`, and its slope per sample.
    fn between(&self, run: &Run, at: isize) -> (f64, f64) {
        let (before, after) = (self.drawn(run, at - 1), self.drawn(run, at));
        let slope = after - before;
        if self.lag_share > 0.0 {
            (after - self.lag_share * slope, slope)
        } else {
            (after, 0.5 * (self.drawn(run, at + 1) - before))
        }
    }

    /// From sample `k` to the next.
    fn sample(&self, run: &Run, k: usize, motion: &mut ReplayedMotion<D>) {
        let at = k.cast_signed() - self.lag_samples;
        let whole = self.pieces[1].unwrap_or(0);
        match self.channels.command.hold {
            Hold::Measured => {
                let (from, from_slope) = self.between(run, at);
                let (to, to_slope) = self.between(run, at + 1);
                let mut torque = Torque { to, ..Torque::held(from) };
                torque.by[BY_LAG] = [from_slope, to_slope].map(|s| -s / self.sample_time_s);
                self.mover.advance(motion, whole, self.less_load(run, k, torque));
            }
            Hold::Sampled => {
                let (old, new) = (self.torque(run, at - 1), self.torque(run, at));
                let [old, new] = [old, new].map(|t| self.less_load(run, k, Torque::held(t)));
                let share = if self.pieces[0].is_some() { self.lag_share } else { 0.0 };
                if let Some(before) = self.pieces[0] {
                    self.mover.advance(motion, before, old.part(0.0, share));
                }
                let new = new.part(share, 1.0);
                self.mover.jump(motion, old.part(share, 1.0).from, new.from);
                self.mover.advance(motion, whole, new);
            }
        }
    }

    /// Number of unknowns of a window: the parameters, its initial state and each tip's zero.
    pub(super) fn unknowns(&self) -> usize {
        self.parameters.len() + D + self.channels.tips.len()
    }

    /// The first of the unit changes of the state among the tangents, where they follow: behind a [`Self::row`].
    pub(super) fn units(&self) -> usize {
        units(self.unknowns())
    }

    /// A row for the derivatives of an output: the unknowns', one number more, and as many beyond as
    /// make it a whole number of [`LANES`].
    pub(super) fn row(&self) -> Vec<f64> {
        vec![0.0; self.units()]
    }

    /// The arm that is replayed.
    pub(super) fn arm(&self) -> &ModalArm {
        self.arm
    }

    /// Parameters by which derivatives are.
    pub(super) fn parameters(&self) -> &[Parameter] {
        self.parameters
    }

    pub(super) fn sample_time_s(&self) -> f64 {
        self.sample_time_s
    }

    /// Number of tips.
    pub(super) fn tips(&self) -> usize {
        self.channels.tips.len()
    }

    pub(super) fn quantity(&self, tip: usize) -> TipQuantity {
        self.channels.tips[tip].quantity
    }

    /// What channel `channel` (0: motor, then tips) shows, and its derivatives by the parameters,
    /// the initial state and the tips' zeros, in a [`Self::row`] where one is given.
    pub(super) fn output(
        &self,
        seen: &Seen<'_, D>,
        channel: usize,
        row: Option<&mut [f64]>,
    ) -> f64 {
        let x = &seen.motion.x;
        let (c, value) = if channel == 0 {
            let mut c = [0.0; D];
            c[0] = 1.0;
            (c, x[0])
        } else {
            self.tip(seen, channel - 1)
        };
        let Some(row) = row else { return value };
        let own = self.parameters.len() + D;
        seen.motion.tangents.seen(&c, row);
        row[self.unknowns()..].fill(0.0);
        if channel > 0 {
            row[own + channel - 1] += 1.0;
            self.direct(seen, channel - 1, row);
        }
        value
    }

    /// How fast changes what a tip shows, an angle or a deflection, and the derivatives of that.
    pub(super) fn rate(&self, seen: &Seen<'_, D>, tip: usize, row: Option<&mut [f64]>) -> f64 {
        let x = &seen.motion.x;
        let (angles, _) = self.tip(seen, tip);
        let mut c = [0.0; D];
        (1..D).step_by(2).for_each(|i| c[i] = angles[i - 1]);
        if let Some(row) = row {
            seen.motion.tangents.seen(&c, row);
            row[self.unknowns()..].fill(0.0);
            self.by_shapes(tip, row, |j| x[3 + 2 * j] - x[1]);
        }
        c.iter().zip(x).map(|(a, b)| a * b).sum()
    }

    /// Derivatives by a tip's shares in the modes; `shown` is what it sees of each.
    fn by_shapes(&self, tip: usize, row: &mut [f64], shown: impl Fn(usize) -> f64) {
        for (index, p) in self.parameters.iter().enumerate() {
            if let Parameter::Shape(i, j) = *p
                && i == tip
            {
                row[index] += shown(j);
            }
        }
    }

    /// What channel `channel` shows, as a row on the state.
    pub(super) fn shown(&self, seen: &Seen<'_, D>, channel: usize) -> [f64; D] {
        match channel.checked_sub(1) {
            None => std::array::from_fn(|i| f64::from(u8::from(i == 0))),
            Some(tip) => self.tip(seen, tip).0,
        }
    }

    /// Share of the modes that the tip sees beside its angle, `1 − Σr`, of an acceleration.
    fn left(&self, tip: usize) -> f64 {
        1.0 - self.arm.shapes[tip].iter().sum::<f64>()
    }

    /// What a tip shows, as a row on the state, and its value.
    fn tip(&self, seen: &Seen<'_, D>, tip: usize) -> ([f64; D], f64) {
        let mut c = [0.0; D];
        let shape = &self.arm.shapes[tip];
        let x = &seen.motion.x;
        let dot = |c: &[f64; D]| c.iter().zip(x).map(|(a, b)| a * b).sum::<f64>();
        match self.channels.tips[tip].quantity {
            TipQuantity::Angle | TipQuantity::Deflection => {
                if self.channels.tips[tip].quantity == TipQuantity::Angle {
                    c[0] = 1.0;
                }
                for (j, r) in shape.iter().enumerate() {
                    c[2 + 2 * j] = *r;
                    c[0] -= r;
                }
                (c, dot(&c))
            }
            TipQuantity::Acceleration => {
                for (j, r) in shape.iter().enumerate() {
                    for (c, a) in c.iter_mut().zip(&self.mover.phases.stick.a[3 + 2 * j]) {
                        *c += r * a;
                    }
                }
                let oscillators = dot(&c);
                let left = self.left(tip);
                let motor = self.mover.motor_acceleration(seen.motion, seen.torque);
                if let Some(d) = direction(seen.motion.mode) {
                    let rates = &self.mover.phases.slip[d];
                    for (c, a) in c.iter_mut().zip(&rates.a[1]) {
                        *c += left * a;
                    }
                    for (c, f) in c.iter_mut().zip(self.mover.friction.slopes(x, d)) {
                        *c -= left * rates.b[1] * f;
                    }
                }
                (c, oscillators + left * motor)
            }
        }
    }

    /// Derivatives of a tip's output beside those through the state.
    fn direct(&self, seen: &Seen<'_, D>, tip: usize, row: &mut [f64]) {
        let x = &seen.motion.x;
        let acceleration = self.channels.tips[tip].quantity == TipQuantity::Acceleration;
        let dot = |a: &[f64; D]| a.iter().zip(x).map(|(a, b)| a * b).sum::<f64>();
        let motor = || self.mover.motor_acceleration(seen.motion, seen.torque);
        let shown = |j: usize| {
            if acceleration {
                dot(&self.mover.phases.stick.a[3 + 2 * j]) - motor()
            } else {
                x[2 + 2 * j] - x[0]
            }
        };
        self.by_shapes(tip, row, shown);
        if !acceleration {
            let lag = self.parameters.iter().position(|p| *p == Parameter::TipLag(tip));
            if let Some(index) = lag {
                row[index] -= self.rate(seen, tip, None);
            }
            return;
        }
        let left = self.left(tip);
        let slip = direction(seen.motion.mode);
        for (index, p) in self.parameters.iter().enumerate() {
            let enters = p.enters(self.arm);
            if enters == Enters::Matrices {
                let shape = self.arm.shapes[tip].iter().enumerate();
                let by = |j: usize| self.mover.phases.stick.row_by(index, 3 + 2 * j, x);
                row[index] += shape.map(|(j, r)| r * by(j)).sum::<f64>();
            }
            let Some(d) = slip else { continue };
            let rates = &self.mover.phases.slip[d];
            let friction = &self.mover.friction;
            row[index] += left
                * match enters {
                    Enters::Friction => -rates.b[1] * friction.by(*p, x, d),
                    Enters::Load => {
                        let [sin, cos] = seen.waves.unwrap_or_default();
                        -rates.b[1] * if *p == Parameter::GravitySine { sin } else { cos }
                    }
                    Enters::Matrices => {
                        rates.row_by(index, 1, x)
                            + rates.push_by(index, 1)
                                * (seen.torque
                                    - self.mover.friction_torque(seen.motion, seen.torque))
                    }
                    Enters::Lag | Enters::Output => 0.0,
                };
        }
    }
}
