//! Windows of the runs and their initial states.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::identify::methods::friction_law::thresholds::FASTEST_QUANTILE;
use crate::identify::output_error::thresholds::{WINDOW_SAMPLES_LEAST, WINDOW_START_SPEED};
use crate::identify::prepare::phases::smoothing;
use crate::record::{Campaign, Run, TipQuantity};
use crate::replay::{ModalArm, Window, predict};

/// Cuts every run into windows of `length_s`. Each begins where the motor moves, so that the sign of its velocity is
/// known, and with it the direction of slip.
pub(crate) fn cut(campaign: &Campaign, arm: &ModalArm, length_s: f64) -> Vec<Window> {
    let of_run = |(index, run): (usize, &Run)| {
        let mut windows = Vec::new();
        let speed = Speed::new(run);
        let samples = ((length_s / run.sample_time_s()).round() as usize).max(WINDOW_SAMPLES_LEAST);
        let mut first = speed.moves_from(0);
        while let Some(from) = first {
            // A remainder that is too short for its own window is added to this one.
            let to = if from + samples + WINDOW_SAMPLES_LEAST > run.len() {
                run.len() - 1
            } else {
                from + samples - 1
            };
            if to < from + WINDOW_SAMPLES_LEAST {
                break;
            }
            windows.push(Window {
                run: index,
                samples: from..=to,
                start: initial_state(campaign, run, arm, &speed, from),
                zeros: vec![0.0; run.tips().len()],
            });
            first = speed.moves_from(to + 1);
        }
        windows
    };
    campaign.runs.par_iter().enumerate().flat_map_iter(of_run).collect()
}

/// Windows of `length_s` whose initial states are those of `before`, windows of the same runs.
pub(crate) fn widen(
    campaign: &Campaign,
    arm: &ModalArm,
    before: &[Window],
    length_s: f64,
) -> Vec<Window> {
    let mut windows = cut(campaign, arm, length_s);
    for window in &mut windows {
        let first = *window.samples.start();
        let old = before.iter().find(|w| w.run == window.run && w.samples.contains(&first));
        let Some(old) = old else { continue };
        window.zeros.clone_from(&old.zeros);
        if *old.samples.start() == first {
            window.start.clone_from(&old.start);
        } else {
            let until = Window { samples: *old.samples.start()..=first, ..old.clone() };
            if let Some(found) = predict(arm, campaign, &until)
                && found.end[1] * window.start[1] > 0.0
            {
                window.start = found.end;
            }
        }
    }
    windows
}

/// Speed that the motor exceeds in 2 % of the time.
pub(crate) fn fastest_rad_s(campaign: &Campaign) -> f64 {
    let speeds = |run: &Run| Speed::new(run).velocity;
    let mut all: Vec<f64> = campaign.runs.iter().flat_map(speeds).map(f64::abs).collect();
    all.sort_by(f64::total_cmp);
    all.get((FASTEST_QUANTILE * all.len() as f64) as usize).copied().unwrap_or(0.0)
}

/// Difference between the largest and the smallest angle of all runs.
pub(crate) fn travel(campaign: &Campaign) -> f64 {
    let angles = || campaign.runs.iter().flat_map(Run::motor).copied();
    angles().fold(f64::NEG_INFINITY, f64::max) - angles().fold(f64::INFINITY, f64::min)
}

/// The motor's velocity from lines through neighbouring samples.
struct Speed {
    /// Samples on either side.
    half: usize,
    velocity: Vec<f64>,
    least: f64,
}

impl Speed {
    fn new(run: &Run) -> Self {
        let half = (smoothing(run.motor()) / 2).max(2);
        let velocity: Vec<f64> =
            (0..run.len()).map(|k| slope(run.motor(), k, half) / run.sample_time_s()).collect();
        let power: f64 = velocity.iter().map(|v| v * v).sum();
        let least = WINDOW_START_SPEED * (power / run.len() as f64).sqrt();
        Self { half, velocity, least }
    }

    fn moves_from(&self, from: usize) -> Option<usize> {
        let from = from.max(self.half);
        let end = self.velocity.len().saturating_sub(self.half);
        (from..end).find(|&k| self.velocity[k].abs() > self.least)
    }
}

/// Slope per sample of the line through the samples within `half` of `k`.
fn slope(x: &[f64], k: usize, half: usize) -> f64 {
    let (from, to) = (k.saturating_sub(half), (k + half).min(x.len() - 1));
    let middle = 0.5 * (from + to) as f64;
    let (mut moment, mut square) = (0.0, 0.0);
    for (i, v) in x[from..=to].iter().enumerate() {
        let d = (from + i) as f64 - middle;
        moment += d * (v - x[from]);
        square += d * d;
    }
    if square > 0.0 { moment / square } else { 0.0 }
}

/// Mean of the samples within `half` of `k`.
fn mean(x: &[f64], k: usize, half: usize) -> f64 {
    let (from, to) = (k.saturating_sub(half), (k + half).min(x.len() - 1));
    x[from..=to].iter().sum::<f64>() / (to + 1 - from) as f64
}

/// State at sample `k`. The motor's part comes from the log. The oscillators' part comes from the tips, by least
/// squares with their shapes; the beam is undeflected if no tip shows an angle.
fn initial_state(
    campaign: &Campaign,
    run: &Run,
    arm: &ModalArm,
    speed: &Speed,
    k: usize,
) -> Vec<f64> {
    let (half, t) = (speed.half, run.sample_time_s());
    let (angle, velocity) = (mean(run.motor(), k, half), speed.velocity[k]);
    let mut state = vec![angle, velocity];
    let modes = arm.modes.len();
    let tips: Vec<usize> = (0..run.tips().len())
        .filter(|&i| campaign.channels.tips[i].quantity != TipQuantity::Acceleration)
        .collect();
    let shapes = DMatrix::from_fn(tips.len(), modes, |i, j| arm.shapes[tips[i]][j]);
    let deflection = |of: &dyn Fn(&[f64]) -> f64, motor: f64| {
        let right = DVector::from_iterator(
            tips.len(),
            tips.iter().map(|&i| match campaign.channels.tips[i].quantity {
                TipQuantity::Deflection => of(&run.tips()[i]),
                _ => of(&run.tips()[i]) - motor,
            }),
        );
        let solved = shapes.clone().svd(true, true).solve(&right, 1e-6);
        solved.unwrap_or_else(|_| DVector::zeros(modes))
    };
    let bent = if tips.is_empty() || modes == 0 {
        (DVector::zeros(modes), DVector::zeros(modes))
    } else {
        (deflection(&|x| mean(x, k, half), angle), deflection(&|x| slope(x, k, half) / t, velocity))
    };
    for j in 0..modes {
        state.push(angle + bent.0[j]);
        state.push(velocity + bent.1[j]);
    }
    state
}
