//! Rows of the motor's equation on short windows, with columns of friction by speed and angle.

#![expect(clippy::inline_always, reason = "compiled for wide registers as one")]

use crate::registers::widest;
use std::sync::{Arc, OnceLock};

use nalgebra::DMatrix;
use rayon::prelude::*;

use crate::identify::methods::friction_law::column_values::ColumnValues;
use crate::identify::methods::friction_law::law_term::Column;
use crate::identify::methods::regression::{
    Further, ModeShape, ModeTerms, ModeWindow, MotorColumns, MotorEquation, Rows, SineAndCosine,
    velocity_and_phases,
};
use crate::identify::methods::thresholds::SLOWEST_SAMPLE;
use crate::identify::prepare::phases::{Phase, SMOOTHING_LEAST};
use crate::identify::prepare::run_noise::RunNoise;
use crate::identify::prepare::window::{SMOOTHED_PART, WINDOW_STEP, Window};
use crate::load::GravityLoad;
use crate::record::{Campaign, Run};

/// Rows looked at, about; windows overlap less in longer logs.
const MOST_ROWS: usize = 40_000;

/// Ends of slip phases are the same if they differ by at most this share of the travel.
const SAME_END: f64 = 0.02;
/// Different slip phases of one motion there and back, with the first and the last, which are not whole.
const THERE_AND_BACK: usize = 4;

/// Windows of a run whose rows are found one after the other.
const PART: usize = 1024;

/// Where a window lies.
pub(super) struct WindowPlace {
    pub(super) run: usize,
    pub(super) phase: usize,
    pub(super) sign: f64,
    /// In its middle.
    pub(super) speed: f64,
    pub(super) angle: f64,
}

/// How stretches are told apart: where travel is halved, and the speeds are parted in three.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Cut {
    pub(super) middle: f64,
    pub(super) thirds: [f64; 2],
}

impl Cut {
    /// Number of kinds of motion.
    pub(super) const KINDS: usize = 12;

    pub(super) fn kind(&self, place: &WindowPlace) -> usize {
        let third = self.thirds.iter().filter(|t| place.speed > **t).count();
        (third * 2 + usize::from(place.angle > self.middle)) * 2 + usize::from(place.sign > 0.0)
    }
}

/// Some columns of all windows, row by row.
pub(super) struct ColumnTable {
    count: usize,
    values: Vec<f64>,
}

impl ColumnTable {
    pub(super) fn row(&self, index: usize) -> &[f64] {
        &self.values[index * self.count..(index + 1) * self.count]
    }
}

/// The runs with what their windows need.
pub(super) struct Sampled<'a> {
    pub(super) campaign: &'a Campaign,
    pub(super) window_s: f64,
    /// Gravity's load as the regression has it, where it acts.
    pub(super) load: Option<GravityLoad>,
    runs: Arc<Vec<Slipping>>,
    windows: Windows,
    /// Rows of the motor's equation, the right side last, once they were asked for.
    equation: OnceLock<Vec<f64>>,
}

/// Every window of each run.
struct Windows {
    /// First samples.
    starts: Vec<Vec<usize>>,
    places: Vec<WindowPlace>,
    /// How much of the campaign is over in the middle of each.
    elapsed: Vec<f64>,
}

/// What the windows of one run have in common.
struct Slipping {
    /// Signed velocity at every sample.
    velocity: Vec<f64>,
    /// Slip phases that are longer than a window.
    phases: Vec<Phase>,
    /// `None` where the run is shorter than a window.
    window: Option<Window>,
    /// Weights of a mode that no tip shows.
    mode: Option<ModeWindow>,
    /// What the sensors' noise adds to a row's products, in expectation.
    noise: DMatrix<f64>,
    gravity: Option<SineAndCosine>,
}

impl<'a> Sampled<'a> {
    /// Windows of a length; a `mode` that no tip shows is counted.
    pub(super) fn new(
        campaign: &'a Campaign,
        noise: &[RunNoise],
        window_s: f64,
        mode: Option<ModeShape>,
    ) -> Self {
        let columns = MotorColumns::of(campaign);
        let of = |(run, noise): (&Run, &RunNoise)| {
            let t = run.sample_time_s();
            let n = (window_s / t).round() as usize;
            let window = (4..run.len()).contains(&n).then(|| Window::new(n, t));
            let (velocity, mut phases) =
                velocity_and_phases(run.motor(), smooth(run, noise, window_s), t);
            phases.retain(|phase| phase.to - phase.from > n);
            let counted = window.as_ref().zip(mode);
            let mode = counted.map(|(window, shape)| ModeWindow::of(window, shape, t));
            let noise = window.as_ref().map_or_else(
                || DMatrix::zeros(0, 0),
                |window| {
                    let columns = &columns;
                    let mode = ModeTerms::of(mode.as_ref(), None);
                    MotorEquation { campaign, run, columns, gravity: None, window, mode }
                        .noise(noise, Some(Further::LaterTorque))
                },
            );
            let gravity = columns.gravity.then(|| SineAndCosine::of(run.motor()));
            Slipping { velocity, phases, window, mode, noise, gravity }
        };
        let runs = campaign.runs.par_iter().zip(noise).with_max_len(1);
        let runs: Vec<Slipping> = runs.map(of).collect();
        let windows = Windows::of(campaign, &runs);
        let equation = OnceLock::new();
        let runs = Arc::new(runs);
        Self { campaign, window_s, load: None, runs, windows, equation }
    }

    /// Largest torque (or force) of the commands.
    pub(super) fn largest_torque(&self) -> f64 {
        let commands = self.campaign.runs.iter().flat_map(Run::command);
        let most = commands.fold(0.0, |most: f64, u| most.max(u.abs()));
        most * self.campaign.channels.command.torque_per_unit().abs()
    }

    /// Speed and angle of the motor in motion, in the order of time: of samples that are evenly spread over the campaign, without
    /// those slower than [`SLOWEST_SAMPLE`].
    pub(super) fn motion(&self) -> Vec<[f64; 2]> {
        let runs = || self.campaign.runs.iter().zip(&*self.runs);
        let all_s: f64 = runs().map(|(run, _)| run.sample_time_s() * run.len() as f64).sum();
        let longest_s = runs().map(|(run, _)| run.sample_time_s()).fold(0.0, f64::max);
        let apart_s = longest_s.max(all_s / MOST_ROWS as f64);
        let of_run = |(run, slipping): (&Run, &Slipping)| {
            let step = (apart_s / run.sample_time_s()).round().max(1.0) as usize;
            let places = slipping.velocity.iter().zip(run.motor()).step_by(step);
            places.map(|(v, angle)| [v.abs(), *angle]).collect::<Vec<_>>()
        };
        let mut motion: Vec<[f64; 2]> = runs().flat_map(of_run).collect();
        let fastest = motion.iter().fold(0.0, |most: f64, [speed, _]| most.max(*speed));
        motion.retain(|[speed, _]| *speed > SLOWEST_SAMPLE * fastest);
        motion
    }

    /// Lowest and highest angle of the windows.
    pub(super) fn travel(&self) -> [f64; 2] {
        let ends = [f64::INFINITY, f64::NEG_INFINITY];
        let widen = |[low, high]: [f64; 2], p: &WindowPlace| [low.min(p.angle), high.max(p.angle)];
        self.places().iter().fold(ends, widen)
    }

    /// Whether most slip phases repeat others, and no more than one motion there and back is repeated in each run: the errors of a
    /// sensor then repeat, too. Slip phases are the same if they differ in no end by more than [`SAME_END`] of the travel.
    pub(super) fn is_one_motion_repeated(&self) -> bool {
        let [low, high] = self.travel();
        let near = |a: f64, b: f64| (a - b).abs() <= SAME_END * (high - low);
        let (mut count, mut different): (usize, Vec<&[WindowPlace]>) = (0, Vec::new());
        for stroke in self.places().chunk_by(|a, b| a.phase == b.phase) {
            count += 1;
            let ends = |s: &[WindowPlace]| [s[0].angle, s[s.len() - 1].angle];
            let own = ends(stroke);
            let same = |other: &&[WindowPlace]| {
                other[0].run == stroke[0].run
                    && ends(other).iter().zip(own).all(|(a, b)| near(*a, b))
            };
            if !different.iter().any(same) {
                different.push(stroke);
            }
        }
        2 * different.len() <= count && different.len() <= THERE_AND_BACK * self.campaign.runs.len()
    }

    /// The speed that a share of the windows are slower than; `None` without windows.
    pub(super) fn speed(&self, share: f64) -> Option<f64> {
        let mut speeds: Vec<f64> = self.places().iter().map(|p| p.speed).collect();
        let at = (share * speeds.len() as f64) as usize;
        (at < speeds.len()).then(|| *speeds.select_nth_unstable_by(at, f64::total_cmp).1)
    }

    /// How much of the campaign is over in the middle of a window, from −½ to ½, the runs one after the other.
    pub(super) fn elapsed(&self, window: usize) -> f64 {
        self.windows.elapsed[window]
    }

    /// Where every window lies.
    pub(super) fn places(&self) -> &[WindowPlace] {
        &self.windows.places
    }

    /// Rows of the motor's equation, one after the other, each with its right side last.
    pub(super) fn equation_rows(&self) -> &[f64] {
        let own = MotorColumns::of(self.campaign);
        self.equation.get_or_init(|| {
            self.in_parts(own.count() + 1, |run, firsts, values| {
                widest(|| self.fill_equation(&own, run, firsts, values));
            })
        })
    }

    /// Every window's `columns`.
    pub(super) fn columns(&self, columns: &[Column], knots: &[f64]) -> ColumnTable {
        let own = MotorColumns::of(self.campaign);
        let values = self.in_parts(columns.len(), |run, firsts, values| {
            widest(|| self.fill_columns((columns, knots), &own, run, firsts, values));
        });
        ColumnTable { count: columns.len(), values }
    }

    /// Mean square of the rows' right sides; `None` without rows.
    pub(super) fn power(&self) -> Option<f64> {
        let own = MotorColumns::of(self.campaign);
        let right = self.in_parts(1, |run, firsts, values| {
            widest(|| self.fill_right_sides(&own, run, firsts, values));
        });
        let power = right.iter().map(|y| y * y).sum::<f64>();
        (!right.is_empty()).then(|| power / right.len() as f64)
    }

    /// A table of `width` values for each window, filled part by part.
    fn in_parts(
        &self,
        width: usize,
        fill: impl Fn(usize, &[usize], &mut [f64]) + Sync,
    ) -> Vec<f64> {
        let mut values = vec![0.0; width * self.windows.places.len()];
        let mut rest = &mut values[..];
        let mut parts = Vec::new();
        for (run, starts) in self.windows.starts.iter().enumerate() {
            for firsts in starts.chunks(PART) {
                let (own, others) = std::mem::take(&mut rest).split_at_mut(width * firsts.len());
                parts.push((run, firsts, own));
                rest = others;
            }
        }
        let parts = parts.into_par_iter().with_max_len(1);
        parts.for_each(|(run, firsts, own)| fill(run, firsts, own));
        values
    }

    /// The equation of a run; `None` where it holds no window.
    #[inline(always)]
    fn equation<'s>(
        &'s self,
        own: &'s MotorColumns,
        run: usize,
    ) -> Option<(MotorEquation<'s>, &'s Slipping)> {
        let (slipping, run) = (&self.runs[run], &self.campaign.runs[run]);
        let (window, gravity) = (slipping.window.as_ref()?, slipping.gravity.as_ref());
        let equation = MotorEquation {
            campaign: self.campaign,
            run,
            columns: own,
            gravity,
            window,
            mode: ModeTerms::of(slipping.mode.as_ref(), None),
        };
        Some((equation, slipping))
    }

    /// What the sensors' noise adds to a row's products in a run, in expectation. In columns by speed and angle it is
    /// left: it hardly changes them.
    pub(super) fn noise_of_row(&self, run: usize) -> &DMatrix<f64> {
        &self.runs[run].noise
    }
}

impl Windows {
    fn of(campaign: &Campaign, runs: &[Slipping]) -> Self {
        let samples: usize = campaign.runs.iter().map(Run::len).sum();
        let mut lasts_s = 0.0;
        let before_s: Vec<f64> = campaign
            .runs
            .iter()
            .map(|run| {
                let before = lasts_s;
                lasts_s += run.len() as f64 * run.sample_time_s();
                before
            })
            .collect();
        let of_run = |(run, slipping): (usize, &Slipping)| {
            let (mut starts, mut places, mut elapsed) = (Vec::new(), Vec::new(), Vec::new());
            let n = slipping.window.as_ref().map_or(usize::MAX, Window::len);
            let step = ((n as f64 * WINDOW_STEP) as usize).max(samples / MOST_ROWS).max(1);
            let motor = campaign.runs[run].motor();
            let t = campaign.runs[run].sample_time_s();
            let mut phase = 0;
            for Phase { from, to, sign } in slipping.phases.iter().filter(|p| p.to - p.from > n) {
                for first in (*from..to - n).step_by(step) {
                    let middle = first + n / 2;
                    let (speed, angle) = (slipping.velocity[middle].abs(), motor[middle]);
                    elapsed.push((before_s[run] + middle as f64 * t) / lasts_s - 0.5);
                    starts.push(first);
                    places.push(WindowPlace { run, phase, sign: *sign, speed, angle });
                }
                phase += 1;
            }
            (starts, places, elapsed, phase)
        };
        let of_runs = runs.par_iter().enumerate().with_max_len(1).map(of_run);
        let (mut starts, mut places, mut elapsed) = (Vec::new(), Vec::new(), Vec::new());
        let mut phases = 0;
        for (of_run, mut there, over, count) in of_runs.collect::<Vec<_>>() {
            elapsed.extend(over);
            for place in &mut there {
                place.phase += phases;
            }
            phases += count;
            starts.push(of_run);
            places.extend(there);
        }
        Self { starts, places, elapsed }
    }
}

impl Sampled<'_> {
    /// Rows of the motor's equation in windows of one run.
    #[inline(always)]
    fn fill_equation(&self, own: &MotorColumns, run: usize, firsts: &[usize], values: &mut [f64]) {
        let Some((equation, _)) = self.equation(own, run) else { return };
        let mut row = Vec::with_capacity(own.count() + 1);
        let rows = values.chunks_exact_mut(own.count() + 1);
        for (first, values) in firsts.iter().zip(rows) {
            equation.fill(*first, &mut row);
            values.copy_from_slice(&row);
        }
    }

    /// Their right sides alone.
    #[inline(always)]
    fn fill_right_sides(
        &self,
        own: &MotorColumns,
        run: usize,
        firsts: &[usize],
        values: &mut [f64],
    ) {
        let Some((equation, _)) = self.equation(own, run) else { return };
        for (first, value) in firsts.iter().zip(values) {
            *value = equation.right(*first);
        }
    }

    /// Further columns in the same windows.
    #[inline(always)]
    fn fill_columns(
        &self,
        (columns, knots): (&[Column], &[f64]),
        own: &MotorColumns,
        run: usize,
        firsts: &[usize],
        values: &mut [f64],
    ) {
        let Some((equation, slipping)) = self.equation(own, run) else { return };
        if columns.is_empty() {
            return;
        }
        let MotorEquation { run, window, .. } = equation;
        let mut functions = ColumnValues::new(columns, knots);
        let rows = values.chunks_exact_mut(columns.len());
        for (first, values) in firsts.iter().zip(rows) {
            functions.reach(*first..first + window.len() + 1, &slipping.velocity, run.motor());
            for (i, (column, value)) in columns.iter().zip(values).enumerate() {
                *value = window.row_scale
                    * match column {
                        Column::Lag => equation.later(*first),
                        Column::Rate(tip) => equation.behind_rate(*tip, *first),
                        _ => {
                            equation.of_torque().0.dot(functions.from(i, *first))
                                * run.sample_time_s()
                        }
                    };
            }
        }
    }
}

/// Samples over which the velocity is smoothed.
fn smooth(run: &Run, noise: &RunNoise, window_s: f64) -> usize {
    let n = window_s / run.sample_time_s();
    noise.needed_smoothing.max(SMOOTHING_LEAST).min((n * SMOOTHED_PART) as usize).max(4)
}
