//! Inverse dynamics: the torque that an arm's figures give for a logged motion, beside the torque
//! logged.
#![expect(clippy::inline_always, reason = "compiled for wide registers as one")]

use std::borrow::Cow;

use rayon::prelude::*;

use crate::friction::Place;
use crate::identify::methods::output_error::{Masks, masks};
use crate::identify::prepare::channel_noise::channel_noise;
use crate::identify::validation::cause::{Cause, Causes};
use crate::identify::validation::kernel::Kernel;
use crate::identify::validation::thresholds::{
    MOVING, NOISE_OF_TORQUE, RESTING_SHARE, STRETCH_LEAST,
};
use crate::record::{Campaign, Run, TipQuantity};
use crate::replay::ModalArm;

/// Shortest window, in samples: half power at a tenth of the sampling rate.
const LEAST_SAMPLES: usize = 10;
/// Windows tried are longer than the one before by this factor.
const LONGER: f64 = 1.1;
/// Of a run a window is at most this share.
const LONGEST: f64 = 0.1;

/// The torque of a log as the figures give it.
#[derive(Debug, Clone, PartialEq)]
pub struct TorquePrediction {
    /// Length of the window that both sides are averaged with \[s\].
    pub window_s: f64,
    /// Frequency at which it leaves half the power \[Hz\].
    pub half_power_hz: f64,
    /// ‖logged − predicted‖/‖logged‖ over all rows that count.
    pub relative_error: f64,
    /// The same while the motor moves forward, and backward; `None` where it does not.
    pub by_direction: [Option<f64>; 2],
    /// Root mean square of the logged torque \[N·m\].
    pub logged_nm: f64,
    /// What is left by the same recipe of the arm's own motion, shown by the same sensors: `relative_error`
    /// of an arm that is right. `None` where its motion could not be followed for long enough.
    pub expected_error: Option<f64>,
    /// Share of the rows that do not count: the motor rests, and what friction is then no figure says,
    /// or a sensor stands at the end of its range, or a command or tip that acts later is not logged.
    pub rest_share: f64,
    /// One for each run.
    pub runs: Vec<TorqueRun>,
    /// Each stretch of one direction that is long enough, errors relative to the whole log's torque.
    pub stretches: Vec<TorqueStretch>,
    /// What the residual looks like, the largest share first.
    pub causes: Vec<Cause>,
}

impl TorquePrediction {
    /// Takes what the same recipe leaves of the arm's own motion.
    pub(super) fn compare(&mut self, expected: Option<Self>) {
        let Some(expected) = expected else { return };
        self.expected_error = Some(expected.relative_error);
        for cause in &mut self.causes {
            let own = expected.causes.iter().find(|c| c.kind == cause.kind);
            cause.expected_value = own.map_or(0.0, |c| c.value);
        }
    }
}

/// The torque of one run over time, one row a sample (or one in so many of a long run).
#[derive(Debug, Clone, PartialEq)]
pub struct TorqueRun {
    /// Index of the run.
    pub run: usize,
    /// ‖logged − predicted‖/‖logged‖ of this run; `None` where no row counts.
    pub relative_error: Option<f64>,
    /// Middle of each window, from the run's first sample \[s\].
    pub time_s: Vec<f64>,
    /// Logged torque under it \[N·m\].
    pub logged_nm: Vec<f64>,
    /// Predicted torque \[N·m\]; not a number where a row does not count.
    pub predicted_nm: Vec<f64>,
}

/// A stretch in which the motor moves one way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TorqueStretch {
    /// Index of the run.
    pub run: usize,
    /// Begin, from the run's first sample \[s\].
    pub start_s: f64,
    /// End \[s\].
    pub end_s: f64,
    /// Whether the motor moves forward.
    pub forward: bool,
    /// Residual beside the logged torque of the whole log.
    pub relative_error: f64,
}

/// Predicts the torque of every run, `zeros` what each tip of each run shows undeflected.
///
/// ```text
/// ⟨k·u(t − lag)⟩ = J·⟨θ̈⟩ + V̄·⟨θ̇⟩ + ⟨C·sgn θ̇ + ΔV·|θ̇|⟩ + offset + Σκ_i·⟨θ − θ_i⟩ + κ'_i·⟨θ̇ − θ̇_i⟩
/// ```
///
/// with ⟨·⟩ the mean under a sin⁴ window, V̄ and ΔV half the sum and half the difference of viscous
/// friction forward and backward. Derivatives of what is measured are moved onto the window; a held
/// command enters by its exact integral, so that half a sample of the hold is counted. Both sides
/// go through the same window, which shifts no phase.
///
/// `window_s` is chosen where it is `None`: the shortest under which the noise of the motor's sensor
/// makes at most 1 % of the torque by J·θ̈, and ten samples at least. A tip that shows its point late
/// is read as much later, by whole samples and, under the window, a series in the rest.
///
/// `None` where the arm has modes that the tips do not show, or no row counts.
pub(in crate::identify) fn torque(
    arm: &ModalArm,
    campaign: &Campaign,
    zeros: &[Vec<f64>],
    window_s: Option<f64>,
) -> Option<TorquePrediction> {
    Predictor::new(arm, campaign, zeros, window_s)?.predicted()
}

/// Length of the window and [`TorquePrediction::relative_error`] of [`torque`], alone.
pub(in crate::identify) fn torque_error(
    arm: &ModalArm,
    campaign: &Campaign,
    zeros: &[Vec<f64>],
) -> Option<(f64, f64)> {
    let predictor = Predictor::new(arm, campaign, zeros, None)?;
    let sums = |run: usize| pulp::Arch::new().dispatch(SumsOfRun(&predictor, run));
    let sums = predictor.of_runs(sums);
    let [left, power] = sums.iter().fold([0.0; 2], |[a, b], [c, d]| [a + c, b + d]);
    (power > 0.0).then(|| (predictor.window_s, (left / power).sqrt()))
}

/// Whether the tips show the torque between motor and beam.
pub(super) fn shows_coupling(arm: &ModalArm, campaign: &Campaign) -> bool {
    Coupling::new(arm, campaign).is_some()
}

/// The shortest window under which the sensor's noise is small.
fn chosen_window_s(arm: &ModalArm, campaign: &Campaign) -> Option<f64> {
    let constant = campaign.channels.command.torque_per_unit();
    let hold = campaign.channels.command.hold;
    let of_run = |run: &Run| {
        let t = run.sample_time_s();
        let power: f64 = run.command().iter().map(|u| (constant * u).powi(2)).sum();
        let allowed = NOISE_OF_TORQUE * (power / run.len() as f64).sqrt();
        let noise = arm.inertia_kg_m2 * channel_noise(run.motor()).std;
        let most = (LONGEST * run.len() as f64) as usize;
        let mut n = LEAST_SAMPLES;
        while n < most && noise * Kernel::new(n, t, hold, 0.0).acceleration_noise() > allowed {
            n = (n as f64 * LONGER).ceil() as usize;
        }
        n as f64 * t
    };
    let needed: Vec<f64> = campaign.runs.par_iter().with_max_len(1).map(of_run).collect();
    needed.into_iter().max_by(f64::total_cmp)
}

/// κ_i and κ'_i: torque per deflection of each tip and per its rate.
struct Coupling {
    per_angle: Vec<f64>,
    per_rate: Vec<f64>,
}

impl Coupling {
    /// `None` where the arm has modes and the tips do not show them all.
    fn new(arm: &ModalArm, campaign: &Campaign) -> Option<Self> {
        let none = vec![0.0; campaign.channels.tips.len()];
        if arm.modes.is_empty() {
            return Some(Self { per_angle: none.clone(), per_rate: none });
        }
        let known = campaign.channels.tips.iter();
        if !known.into_iter().all(|t| t.calibrated && t.quantity != TipQuantity::Acceleration) {
            return None;
        }
        Some(Self { per_angle: arm.coupling_by_tip()?, per_rate: arm.coupling_rate_by_tip()? })
    }

    /// Whether tip `i` takes part.
    fn counts(&self, i: usize) -> bool {
        self.per_angle[i] != 0.0 || self.per_rate[i] != 0.0
    }
}

/// One place of the window.
struct Row {
    time_s: f64,
    logged: f64,
    predicted: f64,
    velocity: f64,
    counts: bool,
}

impl Row {
    fn residual(&self) -> f64 {
        self.logged - self.predicted
    }
}

struct RunRows {
    run: usize,
    half_power_hz: f64,
    rows: Vec<Row>,
    causes: Causes,
}

impl RunRows {
    fn told(self) -> TorqueRun {
        let counted = || self.rows.iter().filter(|r| r.counts);
        let power: f64 = counted().map(|r| r.logged * r.logged).sum();
        let left: f64 = counted().map(|r| r.residual().powi(2)).sum();
        TorqueRun {
            run: self.run,
            relative_error: (power > 0.0).then(|| (left / power).sqrt()),
            time_s: self.rows.iter().map(|r| r.time_s).collect(),
            logged_nm: self.rows.iter().map(|r| r.logged).collect(),
            predicted_nm: self
                .rows
                .iter()
                .map(|r| if r.counts { r.predicted } else { f64::NAN })
                .collect(),
        }
    }

    /// Rows on end that count and move one way.
    fn stretches(&self, logged_nm: f64, window_s: f64) -> Vec<TorqueStretch> {
        let together = |a: &Row, b: &Row| a.counts == b.counts && a.velocity * b.velocity > 0.0;
        let told = |rows: &[Row]| {
            let (first, last) = (rows.first()?, rows.last()?);
            let long = last.time_s - first.time_s >= STRETCH_LEAST as f64 * window_s;
            let left: f64 = rows.iter().map(|r| r.residual().powi(2)).sum();
            (first.counts && long).then(|| TorqueStretch {
                run: self.run,
                start_s: first.time_s,
                end_s: last.time_s,
                forward: first.velocity > 0.0,
                relative_error: (left / rows.len() as f64).sqrt() / logged_nm,
            })
        };
        self.rows.chunk_by(together).filter_map(told).collect()
    }
}

struct Predictor<'a> {
    arm: &'a ModalArm,
    /// Without gravity's torque, which is taken off the command.
    campaign: Cow<'a, Campaign>,
    zeros: &'a [Vec<f64>],
    coupling: Coupling,
    window_s: f64,
    masks: Vec<Masks>,
}

/// The rows of one run, compiled for the widest registers that there are.
struct RowsOfRun<'a>(&'a Predictor<'a>, usize);

impl pulp::WithSimd for RowsOfRun<'_> {
    type Output = Option<RunRows>;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> Option<RunRows> {
        self.0.rows(self.1)
    }
}

/// Their sums alone.
struct SumsOfRun<'a>(&'a Predictor<'a>, usize);

impl pulp::WithSimd for SumsOfRun<'_> {
    type Output = Option<[f64; 2]>;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> Option<[f64; 2]> {
        self.0.sums(self.1)
    }
}

impl<'a> Predictor<'a> {
    /// With windows of a length, or of one that is chosen; `None` where the arm has modes that the tips do not show.
    fn new(
        arm: &'a ModalArm,
        campaign: &'a Campaign,
        zeros: &'a [Vec<f64>],
        window_s: Option<f64>,
    ) -> Option<Self> {
        let campaign = match arm.gravity {
            Some(load) => Cow::Owned(load.taken_from(campaign)),
            None => Cow::Borrowed(campaign),
        };
        let coupling = Coupling::new(arm, &campaign)?;
        let window_s = window_s.or_else(|| chosen_window_s(arm, &campaign))?;
        let masks = masks(&campaign);
        Some(Self { arm, campaign, zeros, coupling, window_s, masks })
    }

    /// What `of` gives of every run that holds a window, some at the same time.
    fn of_runs<T: Send>(&self, of: impl Fn(usize) -> Option<T> + Sync + Send) -> Vec<T> {
        let runs = (0..self.campaign.runs.len()).into_par_iter().with_max_len(1);
        runs.filter_map(of).collect()
    }

    fn predicted(&self) -> Option<TorquePrediction> {
        let rows = |run: usize| pulp::Arch::new().dispatch(RowsOfRun(self, run));
        let rows: Vec<RunRows> = self.of_runs(rows);
        let counted = || rows.iter().flat_map(|r| &r.rows).filter(|row| row.counts);
        let (mut left, mut power, mut number) = ([0.0; 2], [0.0; 2], 0_usize);
        for row in counted() {
            let side = usize::from(row.velocity < 0.0);
            left[side] += row.residual().powi(2);
            power[side] += row.logged * row.logged;
            number += 1;
        }
        let all: usize = rows.iter().map(|r| r.rows.len()).sum();
        let total = power[0] + power[1];
        if number == 0 || total <= 0.0 {
            return None;
        }
        let causes = Causes::of(&rows.iter().map(|r| &r.causes).collect::<Vec<_>>());
        let logged_nm = (total / number as f64).sqrt();
        Some(TorquePrediction {
            window_s: self.window_s,
            half_power_hz: rows.first()?.half_power_hz,
            relative_error: ((left[0] + left[1]) / total).sqrt(),
            by_direction: [0, 1].map(|i| (power[i] > 0.0).then(|| (left[i] / power[i]).sqrt())),
            logged_nm,
            expected_error: None,
            rest_share: 1.0 - number as f64 / all as f64,
            stretches: rows.iter().flat_map(|r| r.stretches(logged_nm, self.window_s)).collect(),
            runs: rows.into_par_iter().map(RunRows::told).collect(),
            causes,
        })
    }

    /// Squares of the residual and of the logged torque, summed over the rows of a run that count; `None` for a run that is
    /// shorter than the window.
    #[inline(always)]
    fn sums(&self, index: usize) -> Option<[f64; 2]> {
        let run = WindowedRun::new(self, index)?;
        let mut sums = [0.0; 2];
        for k in 0..run.windows() {
            let (row, ..) = run.row(k);
            if row.counts {
                sums[0] += row.residual().powi(2);
                sums[1] += row.logged * row.logged;
            }
        }
        Some(sums)
    }

    /// `None` for a run that is shorter than the window.
    #[inline(always)]
    fn rows(&self, index: usize) -> Option<RunRows> {
        let windowed = WindowedRun::new(self, index)?;
        let WindowedRun { run, kernel, speed, .. } = &windowed;
        let constant = self.campaign.channels.command.torque_per_unit();
        let sign = (0..run.len()).map(|i| speed.sign(i)).collect();
        let mut causes = Causes::new(run, &speed.velocity, sign);
        let mut rows = Vec::with_capacity(windowed.windows());
        for k in 0..windowed.windows() {
            let (row, acceleration, coupling) = windowed.row(k);
            if row.counts {
                let by_delay = constant * kernel.rate_of(&run.command()[k..]);
                let terms = [by_delay, acceleration, row.velocity, coupling];
                causes.add(row.residual(), kernel, k, terms);
            }
            rows.push(row);
        }
        Some(RunRows { run: index, half_power_hz: kernel.half_power_hz(), rows, causes })
    }

    /// Friction beside the mean viscous one at a sample.
    fn bent(&self, run: &Run, speed: &Speed, sample: usize) -> f64 {
        let [forward, backward] = self.arm.viscous_nm_s_per_rad;
        let size = speed.velocity[sample].abs();
        let at = Place { angle: run.motor()[sample], speed: size, sign: speed.sign(sample) };
        let dry = self.arm.coulomb_nm + self.arm.dry_terms.braking_nm(at);
        at.sign * dry + 0.5 * (forward - backward) * size
    }

    /// Samples before each, and before the end, at which a sensor is out of its range.
    fn unread(&self, index: usize) -> Vec<usize> {
        let masks = &self.masks[index];
        let mut count = 0;
        let counts = (0..self.campaign.runs[index].len()).map(|i| {
            count += usize::from(!masks.iter().flatten().all(|mask| mask[i]));
            count
        });
        std::iter::once(0).chain(counts).collect()
    }

    /// Each tip that takes part, undeflected less what it shows.
    fn shown(&self, index: usize) -> Vec<Vec<f64>> {
        let of_tip = |(i, tip): (usize, &Vec<f64>)| {
            let zero = self.zeros.get(index).and_then(|z| z.get(i)).copied().unwrap_or(0.0);
            if self.coupling.counts(i) { tip.iter().map(|x| zero - x).collect() } else { vec![] }
        };
        self.campaign.runs[index].tips().iter().enumerate().map(of_tip).collect()
    }

    /// Whether what acts under the window at `k` is in the log: a late command's samples before it, a late
    /// tip's after it.
    fn logged(&self, run: &Run, kernel: &Kernel, k: usize) -> bool {
        let tips = self.arm.tip_lags_s.iter().enumerate().filter(|(i, _)| self.coupling.counts(*i));
        let begins = |lag_s: f64| kernel.late(k, lag_s).0;
        kernel.reads_command(k, run.len())
            && tips
                .map(|(_, lag)| begins(*lag))
                .all(|k| k >= 0 && k.cast_unsigned() + kernel.len() < run.len())
    }

    /// From the tips as [`Self::shown`] has them.
    #[inline(always)]
    fn coupling_torque(&self, index: usize, kernel: &Kernel, shown: &[Vec<f64>], k: usize) -> f64 {
        let run = &self.campaign.runs[index];
        let last = (run.len() - 1 - kernel.len()).cast_signed();
        let mut sum = 0.0;
        for (i, shown) in shown.iter().enumerate().filter(|(i, _)| self.coupling.counts(*i)) {
            let (per_angle, per_rate) = (self.coupling.per_angle[i], self.coupling.per_rate[i]);
            let deflects = self.campaign.channels.tips[i].quantity == TipQuantity::Deflection;
            // The tip's share of what is bent, when its point was where it shows now.
            let lag_s = self.arm.tip_lags_s.get(i).copied().unwrap_or(0.0);
            let (later, rest_s) = kernel.late(k, lag_s);
            let shown = &shown[later.clamp(0, last).cast_unsigned()..];
            let (rate, bend) = (kernel.rate_of(shown), kernel.acceleration_of(shown));
            let mean = kernel.mean_of(shown) + rest_s * (rate + 0.5 * rest_s * bend);
            let rate = rate + rest_s * bend;
            let (mean, rate) = if deflects {
                (mean, rate)
            } else {
                let motor = &run.motor()[k..];
                (kernel.mean_of(motor) + mean, kernel.rate_of(motor) + rate)
            };
            sum += per_angle * mean + per_rate * rate;
        }
        sum
    }
}

/// A run with what all of its rows need.
struct WindowedRun<'a> {
    predictor: &'a Predictor<'a>,
    index: usize,
    run: &'a Run,
    kernel: Kernel,
    speed: Speed,
    /// One at samples at which the motor rests.
    resting: Vec<f64>,
    /// Friction beside the mean viscous one at every sample.
    bent: Vec<f64>,
    unread: Vec<usize>,
    shown: Vec<Vec<f64>>,
}

impl<'a> WindowedRun<'a> {
    /// `None` for a run that is shorter than the window.
    #[inline(always)]
    fn new(predictor: &'a Predictor<'a>, index: usize) -> Option<Self> {
        let run = &predictor.campaign.runs[index];
        let t = run.sample_time_s();
        let n = ((predictor.window_s / t).round() as usize).max(LEAST_SAMPLES).min(run.len());
        if n + 2 > run.len() {
            return None;
        }
        let hold = predictor.campaign.channels.command.hold;
        let kernel = Kernel::new(n, t, hold, predictor.arm.command_lag_s);
        let speed = Speed::new(run, &kernel);
        let samples = || 0..run.len();
        let resting = samples().map(|i| if speed.moves(i) { 0.0 } else { 1.0 }).collect();
        let bent = samples().map(|i| predictor.bent(run, &speed, i)).collect();
        let (unread, shown) = (predictor.unread(index), predictor.shown(index));
        Some(Self { predictor, index, run, kernel, speed, resting, bent, unread, shown })
    }

    fn windows(&self) -> usize {
        self.run.len() - self.kernel.len()
    }

    /// The row of the window that begins at sample `k`, with the acceleration and the torque between motor and beam.
    #[inline(always)]
    fn row(&self, k: usize) -> (Row, f64, f64) {
        let Self { predictor, run, kernel, .. } = self;
        let (arm, n) = (predictor.arm, kernel.len());
        let [forward, backward] = arm.viscous_nm_s_per_rad;
        let mean = 0.5 * (forward + backward);
        let constant = predictor.campaign.channels.command.torque_per_unit();
        let acceleration = kernel.acceleration_of(&run.motor()[k..]);
        let velocity = self.speed.rates[k];
        let coupling = predictor.coupling_torque(self.index, kernel, &self.shown, k);
        let predicted = arm.inertia_kg_m2 * acceleration
            + mean * velocity
            + kernel.mean_of(&self.bent[k..])
            + arm.offset_nm
            + coupling;
        let row = Row {
            time_s: (k as f64 + 0.5 * n as f64) * run.sample_time_s(),
            logged: constant * kernel.command(k, run.command()),
            predicted,
            velocity,
            counts: kernel.mean_of(&self.resting[k..]) <= RESTING_SHARE
                && self.unread[k + n + 1] == self.unread[k]
                && predictor.logged(run, kernel, k),
        };
        (row, acceleration, coupling)
    }
}

/// The motor's velocity at every sample, under the window about it.
struct Speed {
    /// Under each window in turn.
    rates: Vec<f64>,
    velocity: Vec<f64>,
    /// Below this it is not told from rest.
    least: f64,
}

impl Speed {
    #[inline(always)]
    fn new(run: &Run, kernel: &Kernel) -> Self {
        let n = kernel.len();
        let at = |i: usize| i.saturating_sub(n / 2).min(run.len() - 1 - n);
        let rates = 0..run.len() - n;
        let rates: Vec<f64> = rates.map(|k| kernel.rate_of(&run.motor()[k..])).collect();
        let velocity = (0..run.len()).map(|i| rates[at(i)]).collect();
        let least = MOVING * kernel.rate_noise() * channel_noise(run.motor()).std;
        Self { rates, velocity, least }
    }

    fn moves(&self, i: usize) -> bool {
        self.velocity[i].abs() > self.least
    }

    fn sign(&self, i: usize) -> f64 {
        if self.moves(i) { self.velocity[i].signum() } else { 0.0 }
    }
}
