//! Rows of the motor's equation on short windows, with columns of friction by speed and angle.

#![expect(clippy::inline_always, reason = "compiled for wide registers as one")]

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::identify::methods::friction_law::column_values::ColumnValues;
use crate::identify::methods::friction_law::law_term::{Column, LawTerm, ScaleUnit};
use crate::identify::methods::regression::{
    MotorColumns, MotorEquation, Phase, Rows, SMOOTHED_PART, SineAndCosine, Term, WINDOW_STEP,
    Window, slip_phases, smoothing, velocity,
};
use crate::identify::prepare::run_noise::RunNoise;
use crate::load::GravityLoad;
use crate::record::{Campaign, Run};

/// Rows looked at, about; windows overlap less in longer logs.
const MOST_ROWS: usize = 40_000;

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
#[derive(Debug, Clone, Copy)]
pub(super) struct Cut {
    pub(super) middle: f64,
    pub(super) thirds: [f64; 2],
}

impl Cut {
    pub(super) fn kind(&self, place: &WindowPlace) -> usize {
        let third = self.thirds.iter().filter(|t| place.speed > **t).count();
        (third * 2 + usize::from(place.angle > self.middle)) * 2 + usize::from(place.sign > 0.0)
    }
}

/// Rows of windows, one after the other.
pub(super) struct RowTable {
    pub(super) places: Vec<WindowPlace>,
    pub(super) width: usize,
    values: Vec<f64>,
}

impl RowTable {
    /// Every window's place and row: what the motor's regression has, then the columns asked for, then the right side.
    pub(super) fn iter(&self) -> impl Iterator<Item = (&WindowPlace, &[f64])> {
        self.places.iter().zip(self.values.chunks_exact(self.width))
    }

    pub(super) fn row(&self, index: usize) -> &[f64] {
        &self.values[index * self.width..(index + 1) * self.width]
    }
}

/// A window in a slip phase.
#[derive(Clone, Copy)]
struct WindowStart {
    run: usize,
    phase: usize,
    sign: f64,
    first: usize,
}

/// The columns that terms use, and the terms with the places of these.
pub(super) fn used(
    campaign: &Campaign,
    columns: &[Column],
    terms: &[Term],
) -> (Vec<Column>, Vec<Term>) {
    let first = fixed(campaign);
    let mut kept = Vec::new();
    let moved = terms.iter().map(|term| match term.column().checked_sub(first) {
        None => *term,
        Some(index) => {
            kept.push(columns[index]);
            term.at(first + kept.len() - 1)
        }
    });
    let moved = moved.collect();
    (kept, moved)
}

/// Columns of a row before the first [`Column`].
pub(super) fn fixed(campaign: &Campaign) -> usize {
    MotorColumns::of(campaign).count()
}

/// The runs with what their windows need.
pub(super) struct Sampled<'a> {
    pub(super) campaign: &'a Campaign,
    pub(super) window_s: f64,
    /// Travel since a reversal: windows that begin within it are left out.
    pub(super) after: f64,
    /// Gravity's load as the regression has it, where it acts.
    pub(super) load: Option<GravityLoad>,
    /// Largest step of the motor's sensor; zero where none shows.
    pub(super) step: f64,
    runs: Vec<Slipping>,
}

/// What the windows of one run have in common.
struct Slipping {
    /// Signed velocity at every sample.
    velocity: Vec<f64>,
    /// Slip phases that are longer than a window.
    phases: Vec<Phase>,
    /// `None` where the run is shorter than a window.
    window: Option<Window>,
    /// What the sensors' noise adds to a row's products, in expectation.
    noise: DMatrix<f64>,
    gravity: Option<SineAndCosine>,
}

impl<'a> Sampled<'a> {
    pub(super) fn new(campaign: &'a Campaign, noise: &[RunNoise], window_s: f64) -> Self {
        let columns = MotorColumns::of(campaign);
        let of = |(run, noise): (&Run, &RunNoise)| {
            let t = run.sample_time_s();
            let smooth = smooth(run, window_s);
            let n = (window_s / t).round() as usize;
            let window = (4..run.len()).contains(&n).then(|| Window::new(n, t));
            let mut phases = slip_phases(run.motor(), smooth, t);
            phases.retain(|phase| phase.to - phase.from > n);
            let noise = window.as_ref().map_or_else(
                || DMatrix::zeros(0, 0),
                |window| {
                    let columns = &columns;
                    MotorEquation { campaign, run, columns, gravity: None, window }.noise(noise)
                },
            );
            let gravity = columns.gravity.then(|| SineAndCosine::of(run.motor()));
            Slipping { velocity: velocity(run.motor(), smooth, t), phases, window, noise, gravity }
        };
        let runs = campaign.runs.par_iter().zip(noise).with_max_len(1).map(of).collect();
        Self { campaign, window_s, after: 0.0, load: None, step: 0.0, runs }
    }

    /// What the sensors' noise adds to the square of a row's sum of columns, in each run.
    pub(super) fn noise_powers(&self, taken: &DVector<f64>) -> Vec<f64> {
        let own = taken.len();
        let of = |run: &Slipping| match run.window {
            Some(_) => taken.dot(&(run.noise.view((0, 0), (own, own)) * taken)),
            None => 0.0,
        };
        self.runs.iter().map(of).collect()
    }

    /// Whether the motor's sensor has steps fine enough for a term: an angle over which it changes, or how far the motor
    /// goes in a window at a speed over which it does, is more than one.
    pub(super) fn resolves(&self, term: LawTerm) -> bool {
        let over = match term.scale() {
            None => return true,
            Some((angle, ScaleUnit::Angle)) => angle,
            Some((speed, ScaleUnit::Speed)) => speed * self.window_s,
        };
        over > self.step
    }

    /// How far the motor goes in each slip phase that holds a window, ascending.
    pub(super) fn travels(&self) -> Vec<f64> {
        let of_run = |(run, slipping): (&Run, &Slipping)| {
            let motor = run.motor();
            let gone = slipping.phases.iter().map(|p| (motor[p.to - 1] - motor[p.from]).abs());
            gone.collect::<Vec<_>>()
        };
        let mut found: Vec<f64> =
            self.campaign.runs.iter().zip(&self.runs).flat_map(of_run).collect();
        found.sort_by(f64::total_cmp);
        found
    }

    /// Every window of each run.
    fn windows(&self) -> Vec<Vec<WindowStart>> {
        let samples: usize = self.campaign.runs.iter().map(Run::len).sum();
        let mut phase = 0;
        let of_run = |(run, slipping): (usize, &Slipping)| {
            let mut found = Vec::new();
            let n = slipping.window.as_ref().map_or(usize::MAX, Window::len);
            let step = ((n as f64 * WINDOW_STEP) as usize).max(samples / MOST_ROWS).max(1);
            let motor = self.campaign.runs[run].motor();
            for Phase { from, to, sign } in slipping.phases.iter().filter(|p| p.to - p.from > n) {
                let gone = |k: &usize| (motor[*k] - motor[*from]).abs();
                let Some(begin) = (*from..to - n).find(|k| gone(k) >= self.after) else { continue };
                let starts = (begin..to - n).step_by(step);
                found.extend(starts.map(|first| WindowStart { run, phase, sign: *sign, first }));
                phase += 1;
            }
            found
        };
        self.runs.iter().enumerate().map(of_run).collect()
    }

    /// Where every window lies.
    pub(super) fn places(&self) -> Vec<WindowPlace> {
        self.places_of(&self.windows())
    }

    fn places_of(&self, windows: &[Vec<WindowStart>]) -> Vec<WindowPlace> {
        windows.par_iter().flat_map_iter(|w| w.iter().map(|w| self.place(w))).collect()
    }

    fn place(&self, start: &WindowStart) -> WindowPlace {
        let WindowStart { run, phase, sign, first } = *start;
        let sample = first + self.runs[run].window.as_ref().map_or(0, Window::len) / 2;
        let speed = self.runs[run].velocity[sample].abs();
        WindowPlace { run, phase, sign, speed, angle: self.campaign.runs[run].motor()[sample] }
    }

    /// Every window's row: what the motor's regression has, then `columns`, then the right side.
    pub(super) fn rows(&self, columns: &[Column], knots: &[f64]) -> RowTable {
        let own = MotorColumns::of(self.campaign);
        let windows = self.windows();
        let of_part = |windows: &&[WindowStart]| {
            let rows = PartRows { sampled: self, own: &own, windows, columns, knots };
            pulp::Arch::new().dispatch(rows)
        };
        let parts: Vec<_> = windows.iter().flat_map(|of_run| of_run.chunks(PART)).collect();
        let values: Vec<Vec<f64>> = parts.par_iter().with_max_len(1).map(of_part).collect();
        RowTable {
            places: self.places_of(&windows),
            width: own.count() + columns.len() + 1,
            values: values.concat(),
        }
    }

    /// What the sensors' noise adds to a row's products in a run, in expectation. In columns by speed and angle it is
    /// left: it hardly changes them.
    pub(super) fn noise_of_row(&self, run: usize) -> &DMatrix<f64> {
        &self.runs[run].noise
    }
}

/// The rows of windows of one run, compiled for the widest registers that there are.
struct PartRows<'a> {
    sampled: &'a Sampled<'a>,
    own: &'a MotorColumns,
    windows: &'a [WindowStart],
    columns: &'a [Column],
    knots: &'a [f64],
}

impl pulp::WithSimd for PartRows<'_> {
    type Output = Vec<f64>;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> Vec<f64> {
        let Self { sampled, own, windows, columns, knots } = self;
        let Some(first) = windows.first() else { return Vec::new() };
        let (slipping, run) = (&sampled.runs[first.run], &sampled.campaign.runs[first.run]);
        let Some(window) = &slipping.window else { return Vec::new() };
        let gravity = slipping.gravity.as_ref();
        let equation =
            MotorEquation { campaign: sampled.campaign, run, columns: own, gravity, window };
        let mut values = Vec::with_capacity(windows.len() * (own.count() + columns.len() + 1));
        let mut functions = ColumnValues::new(columns, knots);
        let mut row = Vec::new();
        for WindowStart { first, .. } in windows {
            functions.reach(*first..first + window.len() + 1, &slipping.velocity, run.motor());
            equation.fill(*first, &mut row);
            let right = row.pop();
            values.extend_from_slice(&row);
            values.extend(columns.iter().enumerate().map(|(i, column)| {
                window.row_scale
                    * match column {
                        Column::Lag => equation.later(*first),
                        Column::Rate(tip) => equation.behind_rate(*tip, *first),
                        _ => window.value.dot(functions.from(i, *first)) * run.sample_time_s(),
                    }
            }));
            values.extend(right);
        }
        values
    }
}

/// Samples over which the velocity is smoothed.
fn smooth(run: &Run, window_s: f64) -> usize {
    let n = window_s / run.sample_time_s();
    smoothing(run.motor()).min((n * SMOOTHED_PART) as usize).max(4)
}
