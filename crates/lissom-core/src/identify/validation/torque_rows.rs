//! The windows of a motion, each with the torque that an arm's parameters give and the logged torque.
#![expect(clippy::inline_always, reason = "compiled for wide registers as one")]

use std::borrow::Cow;

use rayon::prelude::*;

use crate::friction::Place;
use crate::identify::output_error::{Masks, masks};
use crate::identify::prepare::channel_noise::channel_noise;
use crate::identify::validation::cause::Causes;
use crate::identify::validation::kernel::Kernel;
use crate::identify::validation::thresholds::{MOVING, NOISE_OF_TORQUE, RESTING_SHARE};
use crate::identify::validation::torque_arm::TorqueArm;
use crate::record::{Campaign, Run, TipQuantity};
use crate::replay::ModalArm;

/// Shortest window, in samples: half power at a tenth of the sampling rate.
const LEAST_SAMPLES: usize = 10;
/// Windows tried are longer than the one before by this factor.
const LONGER: f64 = 1.1;
/// Of a run a window is at most this share.
const LONGEST: f64 = 0.1;

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
pub(super) struct Coupling {
    per_angle: Vec<f64>,
    per_rate: Vec<f64>,
}

impl Coupling {
    /// `None` where the arm has modes and the tips do not show them all.
    pub(super) fn new(found: TorqueArm<'_>, campaign: &Campaign) -> Option<Self> {
        let (arm, alone) = (found.arm, found.coupling_alone_nm_per_rad);
        let none = vec![0.0; campaign.channels.tips.len()];
        if arm.modes.is_empty() && alone.is_empty() {
            return Some(Self { per_angle: none.clone(), per_rate: none });
        }
        let known = campaign.channels.tips.iter();
        if !known.into_iter().all(|t| t.calibrated && t.quantity != TipQuantity::Acceleration) {
            return None;
        }
        if !alone.is_empty() {
            return Some(Self { per_angle: alone.to_vec(), per_rate: none });
        }
        Some(Self { per_angle: arm.coupling_by_tip()?, per_rate: arm.coupling_rate_by_tip()? })
    }

    /// Whether tip `i` takes part.
    fn counts(&self, i: usize) -> bool {
        self.per_angle[i] != 0.0 || self.per_rate[i] != 0.0
    }
}

/// One place of the window.
pub(super) struct Row {
    pub(super) time_s: f64,
    /// Without gravity and torque ripples.
    pub(super) logged: f64,
    /// Without gravity and torque ripples.
    pub(super) predicted: f64,
    pub(super) velocity: f64,
    pub(super) counts: bool,
    pub(super) terms: Terms,
}

/// The terms of a predicted torque, without the constant offset.
pub(super) struct Terms {
    pub(super) inertia: f64,
    pub(super) viscous: f64,
    pub(super) dry: f64,
    pub(super) coupling: f64,
    pub(super) gravity: f64,
}

impl Row {
    pub(super) fn residual(&self) -> f64 {
        self.logged - self.predicted
    }
}

/// The rows of a run, and what their residual looks like.
pub(super) struct RunRows {
    pub(super) run: usize,
    pub(super) half_power_hz: f64,
    pub(super) rows: Vec<Row>,
    pub(super) causes: Causes,
}

/// What predicts the torque of a campaign's runs.
pub(super) struct Predictor<'a> {
    arm: &'a ModalArm,
    /// Without the torque of gravity and torque ripples, which is taken off the command.
    campaign: Cow<'a, Campaign>,
    zeros: &'a [Vec<f64>],
    coupling: Coupling,
    pub(super) window_s: f64,
    masks: Vec<Masks>,
}

impl<'a> Predictor<'a> {
    /// With windows of a length, or of one that is chosen; `None` where the arm has modes that the tips do not show.
    pub(super) fn new(
        found: TorqueArm<'a>,
        campaign: &'a Campaign,
        zeros: &'a [Vec<f64>],
        window_s: Option<f64>,
    ) -> Option<Self> {
        let arm = found.arm;
        let load = arm.position_torque();
        let campaign = if load.is_empty() {
            Cow::Borrowed(campaign)
        } else {
            Cow::Owned(load.taken_from(campaign))
        };
        let coupling = Coupling::new(found, &campaign)?;
        let window_s = window_s.or_else(|| chosen_window_s(arm, &campaign))?;
        let masks = masks(&campaign);
        Some(Self { arm, campaign, zeros, coupling, window_s, masks })
    }

    /// What `of` gives of every run that holds a window, some at the same time.
    pub(super) fn of_runs<T: Send>(&self, of: impl Fn(usize) -> Option<T> + Sync + Send) -> Vec<T> {
        let runs = (0..self.campaign.runs.len()).into_par_iter().with_max_len(1);
        runs.filter_map(of).collect()
    }

    /// Squares of the residual and of the logged torque, summed over the rows of a run that count; `None` for a run that is
    /// shorter than the window.
    #[inline(always)]
    pub(super) fn sums(&self, index: usize) -> Option<[f64; 2]> {
        let run = WindowedRun::new(self, index)?;
        let mut sums = [0.0; 2];
        for k in 0..run.windows() {
            let (row, _) = run.row(k);
            if row.counts {
                sums[0] += row.residual().powi(2);
                sums[1] += row.logged * row.logged;
            }
        }
        Some(sums)
    }

    /// `None` for a run that is shorter than the window.
    #[inline(always)]
    pub(super) fn rows(&self, index: usize) -> Option<RunRows> {
        let windowed = WindowedRun::new(self, index)?;
        let WindowedRun { run, kernel, speed, .. } = &windowed;
        let constant = self.campaign.channels.command.torque_per_unit();
        let sign = (0..run.len()).map(|i| speed.sign(i)).collect();
        let mut causes = Causes::new(run, &speed.velocity, sign);
        let mut rows = Vec::with_capacity(windowed.windows());
        for k in 0..windowed.windows() {
            let (row, acceleration) = windowed.row(k);
            if row.counts {
                let by_delay = constant * kernel.rate_of(&run.command()[k..]);
                let terms = [by_delay, acceleration, row.velocity, row.terms.coupling];
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
    /// Torque of gravity and torque ripples at every sample; empty without them.
    gravity: Vec<f64>,
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
        let load = predictor.arm.position_torque();
        let gravity = if load.is_empty() {
            Vec::new()
        } else {
            run.motor().iter().map(|angle_rad| load.torque_nm(*angle_rad)).collect()
        };
        let (unread, shown) = (predictor.unread(index), predictor.shown(index));
        Some(Self { predictor, index, run, kernel, speed, resting, bent, gravity, unread, shown })
    }

    fn windows(&self) -> usize {
        self.run.len() - self.kernel.len()
    }

    /// The row of the window that begins at sample `k`, with the acceleration.
    #[inline(always)]
    fn row(&self, k: usize) -> (Row, f64) {
        let Self { predictor, run, kernel, .. } = self;
        let (arm, n) = (predictor.arm, kernel.len());
        let [forward, backward] = arm.viscous_nm_s_per_rad;
        let mean = 0.5 * (forward + backward);
        let constant = predictor.campaign.channels.command.torque_per_unit();
        let acceleration = kernel.acceleration_of(&run.motor()[k..]);
        let velocity = self.speed.rates[k];
        let terms = Terms {
            inertia: arm.inertia_kg_m2 * acceleration,
            viscous: mean * velocity,
            dry: kernel.mean_of(&self.bent[k..]),
            coupling: predictor.coupling_torque(self.index, kernel, &self.shown, k),
            gravity: if self.gravity.is_empty() { 0.0 } else { kernel.mean_of(&self.gravity[k..]) },
        };
        let predicted = terms.inertia + terms.viscous + terms.dry + arm.offset_nm + terms.coupling;
        let row = Row {
            time_s: (k as f64 + 0.5 * n as f64) * run.sample_time_s(),
            logged: constant * kernel.command(k, run.command()),
            predicted,
            velocity,
            counts: kernel.mean_of(&self.resting[k..]) <= RESTING_SHARE
                && self.unread[k + n + 1] == self.unread[k]
                && predictor.logged(run, kernel, k),
            terms,
        };
        (row, acceleration)
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
