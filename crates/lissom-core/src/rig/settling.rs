//! Decides when a transient has decayed, from the true state, one period after another.

use nalgebra::{DMatrix, DVector};

use crate::arm::Arm;

/// Beams of more masses are judged without their modes: finding them costs more than the run.
const MODES_MOST: usize = 200;

/// A pole whose decay is below this part of its size decays by rounding only.
const UNDAMPED: f64 = 1e-12;

/// Slipping poles this near to zero, relative to the largest, are the arm's turning as one body:
/// the loop holds that.
const RIGID: f64 = 1e-6;

/// Lags of 1 to 16 periods, then each twice as long.
const LAGS_SINGLE: usize = 16;

/// Differences from which a decay is read off.
const SHOWN_LEAST: usize = 8;

/// Numbers kept of the past.
const KEPT_MOST: usize = 4_000_000;

/// How the state of an arm decays.
#[derive(Debug, Clone)]
struct Decays {
    /// From differences of angles to amplitudes of modes; `None`: each coordinate for itself.
    to_modes: Option<DMatrix<f64>>,
    /// ω of each mode \[rad/s\].
    omega_rad_s: Vec<f64>,
    /// Time in which each mode decays by e \[s\]; `None` where nothing says.
    decay_s: Vec<Option<f64>>,
    /// The same of the motor in its loop \[s\].
    motor_decay_s: f64,
}

impl Decays {
    fn of(arm: &Arm, memory_s: f64) -> Self {
        let (n, k) = (arm.beam().len(), arm.dynamics().len());
        if k > MODES_MOST {
            let first = arm.beam().frequencies_rad_s(crate::beam::Base::Clamped, 1);
            let omega = first.first().copied().unwrap_or(1.0);
            return Self {
                to_modes: None,
                omega_rad_s: vec![omega; k],
                decay_s: vec![None; k],
                motor_decay_s: memory_s,
            };
        }
        let slip = arm.poles().s;
        let largest = slip.iter().fold(0.0_f64, |m, s| m.max(s.norm()));
        let slipping_s = slip
            .iter()
            .filter(|s| s.norm() > RIGID * largest && -s.re > UNDAMPED * s.norm())
            .fold(memory_s, |m, s| m.max(-1.0 / s.re));
        let stuck = arm.beam().poles().s;
        let modes = arm.beam().modes(usize::MAX);
        let decay = |omega: f64| {
            let near = |s: &&num_complex::Complex64| (s.norm() - omega).abs();
            let pole = stuck.iter().min_by(|a, b| near(a).total_cmp(&near(b)))?;
            (-pole.re > UNDAMPED * pole.norm()).then(|| (-1.0 / pole.re).max(slipping_s))
        };
        let shapes = || {
            // Angles of the masses in each mode, the largest 1 rad.
            let position = |i: usize| arm.beam().position_m().get(i).copied().unwrap_or(1.0);
            let mut shapes = DMatrix::from_fn(n, n, |i, m| modes[m].shape[i] / position(i));
            for mut column in shapes.column_iter_mut() {
                column /= column.amax();
            }
            shapes.try_inverse()
        };
        // With a payload that turns, the tip's slope is a coordinate that shapes do not show.
        let to_modes = if n > 0 && n == k && modes.len() == n { shapes() } else { None };
        let mut omega_rad_s: Vec<f64> = modes.iter().map(|m| m.natural_frequency_rad_s).collect();
        let mut decay_s: Vec<Option<f64>> = omega_rad_s.iter().map(|w| decay(*w)).collect();
        if to_modes.is_none() {
            // Every coordinate moves in every mode: the lowest and the slowest stand for all.
            let slowest = decay_s.iter().try_fold(0.0_f64, |m, d| d.map(|d| m.max(d)));
            omega_rad_s = vec![omega_rad_s.first().copied().unwrap_or(1.0); k];
            decay_s = vec![slowest; k];
        }
        Self { to_modes, omega_rad_s, decay_s, motor_decay_s: slipping_s }
    }
}

impl Decays {
    /// What holds for this arm and for another that takes over: modes are not told apart.
    fn or(self, other: &Self) -> Self {
        let slowest =
            |decays: &Self| decays.decay_s.iter().try_fold(0.0_f64, |m, d| d.map(|d| m.max(d)));
        let decay_s = slowest(&self).zip(slowest(other)).map(|(a, b)| a.max(b));
        let lowest = |decays: &Self| decays.omega_rad_s.iter().copied().fold(f64::MAX, f64::min);
        let k = self.decay_s.len();
        Self {
            to_modes: None,
            omega_rad_s: vec![lowest(&self).min(lowest(other)); k],
            decay_s: vec![decay_s; k],
            motor_decay_s: self.motor_decay_s.max(other.motor_decay_s),
        }
    }
}

/// Judges what is left of a transient, from states at one phase.
///
/// A transient that decays by `e^{−P/τ}` in a period P differs from itself one period later by at
/// least `1 − e^{−P/τ}` of its size. So with d the difference over N periods, what is left is at most
/// `d/(1 − e^{−N·P/τ})`. The difference is taken apart into the motor's angle and the beam's modes,
/// each with its own τ: the slower of the motor stuck and slipping. Of all N the least bound
/// counts; where sensors or sample times that do not fit the period keep d from vanishing, a long
/// N magnifies that the least.
///
/// Without damping there is no τ. It is then read off the differences themselves, as far as they
/// fall.
#[derive(Debug, Clone)]
pub(super) struct Settling {
    decays: Decays,
    coordinates: usize,
    /// An open drive holds no angle: what drifts with the motor is no transient.
    open: bool,
    period_s: f64,
    past: Vec<Vec<f64>>,
    kept: usize,
    /// How many states were seen.
    seen: usize,
    /// Sizes of the differences over one period \[rad\].
    changes: Vec<f64>,
    /// The decay that they show, and how many there have to be before it is looked at again.
    shown_s: f64,
    look_at: usize,
}

impl Settling {
    /// `later` are arms that take over from `arm`: the slowest of all counts.
    pub(super) fn new(
        arm: &Arm,
        later: &[(f64, Arm)],
        memory_s: f64,
        period_s: f64,
        open: bool,
    ) -> Self {
        let decays = later
            .iter()
            .fold(Decays::of(arm, memory_s), |all, (_, arm)| all.or(&Decays::of(arm, memory_s)));
        Self {
            decays,
            coordinates: arm.dynamics().len(),
            open,
            period_s,
            past: Vec::new(),
            kept: (KEPT_MOST / arm.state_len()).max(2),
            seen: 0,
            changes: Vec::new(),
            shown_s: f64::INFINITY,
            look_at: SHOWN_LEAST,
        }
    }

    /// ω of the slowest mode \[rad/s\].
    pub(super) fn lowest_rad_s(arm: &Arm) -> f64 {
        let first = arm.beam().frequencies_rad_s(crate::beam::Base::Clamped, 1);
        first.first().copied().unwrap_or(1.0)
    }

    /// Takes the state one period after the last; gives what is left of the transient at most
    /// \[rad\], infinite where nothing bounds it yet.
    pub(super) fn look(&mut self, state: &[f64]) -> f64 {
        let coordinates = self.amplitudes(state);
        if self.changes.len() >= self.look_at {
            self.shown_s = self.seen_decay_s();
            // Ever more seldom, so that a long wait costs no square of its length.
            self.look_at = self.changes.len() + 1 + self.changes.len() / 8;
        }
        let most = self.seen.min(self.kept - 1);
        let mut left = f64::INFINITY;
        let mut lag = 1;
        while lag <= most {
            let before = &self.past[(self.seen - lag) % self.kept];
            let difference: Vec<f64> = coordinates.iter().zip(before).map(|(a, b)| a - b).collect();
            if lag == 1 {
                self.changes.push(self.sizes(&difference).into_iter().sum());
            }
            left = left.min(self.bound(&difference, lag));
            lag = if lag < LAGS_SINGLE { lag + 1 } else { lag * 2 };
        }
        if self.past.len() < self.kept {
            self.past.push(coordinates);
        } else {
            self.past[self.seen % self.kept] = coordinates;
        }
        self.seen += 1;
        left
    }

    /// The motor's angle (of an open drive its velocity over the lowest ω), then each mode's angle,
    /// then each one's velocity over its ω \[rad\].
    fn amplitudes(&self, state: &[f64]) -> Vec<f64> {
        let k = self.coordinates;
        let (turn, rate) = if self.open { (state[0], state[1]) } else { (0.0, 0.0) };
        let lowest = self.decays.omega_rad_s.first().copied().unwrap_or(1.0);
        let modal = |x: &[f64], from: f64| {
            let x = DVector::from_iterator(k, x.iter().map(|v| v - from));
            match &self.decays.to_modes {
                Some(to_modes) => to_modes * x,
                None => x,
            }
        };
        let angles = modal(&state[2..2 + k], turn);
        let mut rates = modal(&state[2 + k..2 + 2 * k], rate);
        for (rate, omega) in rates.iter_mut().zip(&self.decays.omega_rad_s) {
            *rate /= omega;
        }
        let motor = if self.open { state[1] / lowest } else { state[0] };
        std::iter::once(motor).chain(angles.iter().copied()).chain(rates.iter().copied()).collect()
    }

    /// Amplitudes of the motor and of each mode.
    fn sizes(&self, difference: &[f64]) -> Vec<f64> {
        let k = self.coordinates;
        let mode = |m: usize| difference[1 + m].hypot(difference[1 + k + m]);
        std::iter::once(difference[0].abs()).chain((0..k).map(mode)).collect()
    }

    fn bound(&self, difference: &[f64], lag: usize) -> f64 {
        let time = lag as f64 * self.period_s;
        // Of zero nothing is left, however slowly it goes.
        let left =
            |d: f64, decay_s: f64| if d == 0.0 { 0.0 } else { -d / (-time / decay_s).exp_m1() };
        let sizes = self.sizes(difference);
        let modes = sizes[1..].iter().zip(&self.decays.decay_s);
        let beam: f64 = modes.map(|(d, tau)| left(*d, tau.unwrap_or(self.shown_s))).sum();
        left(sizes[0], self.decays.motor_decay_s) + beam
    }

    /// The decay that the differences show: the largest of the last quarter against the largest of
    /// the second \[s\]; infinite where they do not fall.
    fn seen_decay_s(&self) -> f64 {
        let n = self.changes.len();
        let largest = |part: &[f64]| part.iter().fold(0.0_f64, |m, d| m.max(*d));
        let (early, late) =
            (largest(&self.changes[n / 4..n / 2]), largest(&self.changes[3 * n / 4..]));
        let fall = (early / late).ln();
        if fall > 0.0 { 0.5 * n as f64 * self.period_s / fall } else { f64::INFINITY }
    }
}
