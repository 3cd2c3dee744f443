//! Rows of the motor's equation on short windows, with columns of friction by speed and angle.

use nalgebra::{DMatrix, DVector};

use crate::identify::methods::friction_law::law_term::Column;
use crate::identify::methods::regression::{
    Cluster, MotorColumns, MotorEquation, Phase, Rows, SMOOTHED_PART, SineAndCosine, WINDOW_STEP,
    Window, slip_phases, smoothing, velocity,
};
use crate::identify::prepare::run_noise::RunNoise;
use crate::record::{Campaign, Run};

/// Rows looked at, about; windows overlap less in longer logs.
const MOST_ROWS: usize = 40_000;

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
    fn kind(&self, place: &WindowPlace) -> usize {
        let third = self.thirds.iter().filter(|t| place.speed > **t).count();
        (third * 2 + usize::from(place.angle > self.middle)) * 2 + usize::from(place.sign > 0.0)
    }
}

/// Sums of the windows of one slip phase that are of one kind.
#[derive(Debug)]
pub(super) struct PhaseBlock {
    pub(super) cluster: Cluster,
    /// Number of the phase.
    pub(super) phase: usize,
    /// Direction × third of the speeds × half of the travel.
    pub(super) kind: usize,
}

/// Kinds of stretches.
pub(super) const KINDS: usize = 12;

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
        let runs = campaign.runs.iter().zip(noise).map(of).collect();
        Self { campaign, window_s, after: 0.0, runs }
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

    /// Calls `see` with every window: run, number of its phase, sign, first sample, window.
    fn each(&self, mut see: impl FnMut(usize, usize, f64, usize, &Window)) {
        let samples: usize = self.campaign.runs.iter().map(Run::len).sum();
        let mut number = 0;
        for (index, slipping) in self.runs.iter().enumerate() {
            let Some(window) = &slipping.window else { continue };
            let n = window.len();
            let step = ((n as f64 * WINDOW_STEP) as usize).max(samples / MOST_ROWS).max(1);
            let motor = self.campaign.runs[index].motor();
            for phase in &slipping.phases {
                let gone = |k: &usize| (motor[*k] - motor[phase.from]).abs();
                let mut windows = phase.from..phase.to - n;
                let Some(from) = windows.find(|k| gone(k) >= self.after) else { continue };
                for k in (from..phase.to - n).step_by(step) {
                    see(index, number, phase.sign, k, window);
                }
                number += 1;
            }
        }
    }

    /// Where every window lies.
    pub(super) fn places(&self) -> Vec<WindowPlace> {
        let mut found = Vec::new();
        self.each(|run, phase, sign, k, window| {
            found.push(self.place(run, phase, sign, k + window.len() / 2));
        });
        found
    }

    fn place(&self, run: usize, phase: usize, sign: f64, sample: usize) -> WindowPlace {
        let speed = self.runs[run].velocity[sample].abs();
        WindowPlace { run, phase, sign, speed, angle: self.campaign.runs[run].motor()[sample] }
    }

    /// Calls `see` with every window's row: what the motor's regression has, then `columns`, then the
    /// right side.
    pub(super) fn rows(
        &self,
        columns: &[Column],
        knots: &[f64],
        mut see: impl FnMut(&WindowPlace, &[f64]),
    ) {
        let own = MotorColumns::of(self.campaign);
        let functions: Vec<Vec<Vec<f64>>> =
            (0..self.campaign.runs.len()).map(|run| self.functions(run, columns, knots)).collect();
        let mut row = Vec::new();
        self.each(|index, phase, sign, k, window| {
            let run = &self.campaign.runs[index];
            let gravity = self.runs[index].gravity.as_ref();
            let equation =
                MotorEquation { campaign: self.campaign, run, columns: &own, gravity, window };
            equation.fill(k, &mut row);
            let right = row.len() - 1;
            let more = columns.iter().zip(&functions[index]).map(|(column, f)| match column {
                Column::Lag => equation.later(k),
                Column::Rate(i) => equation.behind_rate(*i, k),
                _ => integral(&window.value, &f[k..=k + window.len()], run.sample_time_s()),
            });
            row.splice(right..right, more.map(|v| v * window.row_scale));
            see(&self.place(index, phase, sign, k + window.len() / 2), &row);
        });
    }

    /// The same, summed by phase and kind.
    pub(super) fn blocks(&self, columns: &[Column], knots: &[f64], cut: &Cut) -> Vec<PhaseBlock> {
        let width = fixed(self.campaign) + columns.len() + 1;
        let mut blocks: Vec<PhaseBlock> = Vec::new();
        let mut first_of_phase = 0;
        self.rows(columns, knots, |place, row| {
            let kind = cut.kind(place);
            if blocks.last().is_some_and(|b| b.phase != place.phase) {
                first_of_phase = blocks.len();
            }
            let same = blocks[first_of_phase..].iter().position(|b| b.kind == kind);
            let at = same.map_or(blocks.len(), |i| first_of_phase + i);
            if at == blocks.len() {
                let cluster = Cluster::new(place.run, place.sign, width);
                blocks.push(PhaseBlock { cluster, phase: place.phase, kind });
            }
            blocks[at].cluster.add(row);
        });
        // In columns by speed and angle noise is left: it hardly changes them.
        let own = fixed(self.campaign);
        for PhaseBlock { cluster, .. } in &mut blocks {
            let of_row = &self.runs[cluster.run].noise;
            let noise = of_row.view((0, 0), (own, own)) * cluster.rows as f64;
            cluster.noise.view_mut((0, 0), (own, own)).copy_from(&noise);
        }
        blocks
    }

    /// Every column's function at every sample of a run; empty for a lag and a tip's rate.
    fn functions(&self, run: usize, columns: &[Column], knots: &[f64]) -> Vec<Vec<f64>> {
        let motor = self.campaign.runs[run].motor();
        let velocity = &self.runs[run].velocity;
        let samples = || velocity.iter().zip(motor);
        let one = |column: &Column| match *column {
            Column::Lag | Column::Rate(_) => Vec::new(),
            Column::Hat(j) => velocity.iter().map(|v| hat(knots, j, v.abs())).collect(),
            column => samples().map(|(v, x)| column.at(v.abs(), *x)).collect(),
        };
        columns.iter().map(one).collect()
    }
}

/// Samples over which the velocity is smoothed.
fn smooth(run: &Run, window_s: f64) -> usize {
    let n = window_s / run.sample_time_s();
    smoothing(run.motor()).min((n * SMOOTHED_PART) as usize).max(4)
}

fn integral(weight: &[f64], f: &[f64], sample_time_s: f64) -> f64 {
    weight.iter().zip(f).map(|(w, f)| w * f).sum::<f64>() * sample_time_s
}

/// One at knot `j`, falling to zero at its neighbours; beyond the first and the last knot the lines go on, so
/// that friction that grows in proportion to speed is a sum of hats everywhere.
pub(super) fn hat(knots: &[f64], j: usize, speed: f64) -> f64 {
    let last = knots.len().saturating_sub(2);
    let left = knots.partition_point(|knot| *knot <= speed).saturating_sub(1).min(last);
    let Some(right) = knots.get(left + 1) else { return 1.0 };
    let share = (speed - knots[left]) / (right - knots[left]);
    match j {
        j if j == left => 1.0 - share,
        j if j == left + 1 => share,
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hats_add_up_to_one() {
        let knots = [0.1, 0.2, 0.5, 1.0];
        for speed in [0.0, 0.1, 0.15, 0.3, 0.7, 1.0, 3.0] {
            let sum: f64 = (0..4).map(|j| hat(&knots, j, speed)).sum();
            assert!((sum - 1.0).abs() < 1e-12, "{speed}: {sum}");
            let line: f64 = (0..4).map(|j| hat(&knots, j, speed) * knots[j]).sum();
            assert!((line - speed).abs() < 1e-12, "{speed}: {line}");
        }
    }
}
