//! Searches, probes and costs of a campaign's fits.

use rayon::prelude::*;

use crate::identify::methods::friction_law::LawTerm;
use crate::identify::methods::output_error::budget::Budget;
use crate::identify::methods::output_error::coordinates::Body;
use crate::identify::methods::output_error::covariance::Covariances;
use crate::identify::methods::output_error::data::Masks;
use crate::identify::methods::output_error::fit::{Fit, Report, StageReport};
use crate::identify::methods::output_error::noise;
use crate::identify::methods::output_error::repeats::without_repeats;
use crate::identify::methods::output_error::search::{Point, Problem, Stop, is_possible};
use crate::identify::methods::output_error::thresholds::{
    FIRST_WINDOW_PERIODS, FIRST_WINDOW_SAMPLES, LAST_STEP_FALL, LAST_STEPS_MOST, NOISE_ROUNDS_MOST,
    NOISE_SETTLED, PARAMETER_SHARE_LEAST, PROBE_SAMPLES, RESIDUAL_FAR_ABOVE_NOISE, STAGE_SAMPLES,
    STAGE_STEP_FALL, STAGE_STEPS_MOST, STEP_SHARE_LEAST,
};
use crate::identify::methods::output_error::windows::cut;
use crate::identify::thresholds::PRESENT;
use crate::record::{Campaign, Run};
use crate::replay::{
    Blocks, ModalArm, Parameter, Prediction, Sampling, SensorNoise, Window, WindowSums, costs,
    free_parameters, predict,
};

/// A campaign as the fits see it.
pub(super) struct Fitting<'a> {
    pub(super) campaign: &'a Campaign,
    pub(super) masks: &'a [Masks],
    pub(super) blocks: &'a [Blocks],
    /// Terms of friction that slip phases show.
    pub(super) law: &'a [LawTerm],
    /// Noise that the samples show by themselves.
    pub(super) noise: &'a [SensorNoise],
    /// What the whole search may cost.
    pub(super) budget: &'a Budget,
    /// Factor by which each stage's windows are longer than the ones before.
    pub(super) widening: f64,
    /// Whether other friction laws than that of the start are tried.
    pub(super) tries_laws: bool,
}

impl Fitting<'_> {
    pub(super) fn problem<'b>(
        &'b self,
        free: &'b [Parameter],
        noise: &'b [SensorNoise],
        whole_runs: bool,
    ) -> Problem<'b> {
        let sampling = Sampling { noise, blocks: &[], masks: self.masks };
        let robust = !whole_runs;
        let near_enough = if robust { STEP_SHARE_LEAST } else { 0.0 };
        let promise = STAGE_STEP_FALL;
        Problem {
            campaign: self.campaign,
            parameters: free,
            sampling,
            budget: self.budget,
            robust,
            promise,
            near_enough,
        }
    }

    /// Largest ratio of a channel's residual to the noise that its samples show by themselves.
    pub(super) fn beyond_noise(&self, fit: &Fit) -> f64 {
        fit.residual.iter().zip(self.noise).map(|(r, n)| r / n.sigma).fold(0.0, f64::max)
    }

    /// Replays a fit, the parameters `free` moving, with sums by blocks.
    pub(super) fn point(&self, fit: &Fit, free: &[Parameter]) -> Point {
        let mut problem = self.problem(free, &fit.noise, true);
        problem.sampling.blocks = self.blocks;
        problem.at(fit.body.clone(), fit.windows.clone())
    }

    /// Covariances of the free parameters.
    pub(super) fn covariances(&self, fit: &Fit) -> Covariances {
        fit.covariances(&self.point(fit, &fit.free).sums)
    }

    /// Cost of an arm and its windows where the noise is `noise`.
    pub(super) fn cost(&self, fit: &Fit, noise: &[SensorNoise]) -> f64 {
        let samples: usize = fit.windows.iter().map(Window::len).sum();
        self.budget.count(samples, 0);
        let sampling = Sampling { noise, blocks: &[], masks: self.masks };
        costs(&fit.body.arm, self.campaign, &fit.windows, sampling).iter().sum()
    }

    /// Whether `other` is better than `fit`: the one rule by which a change of the model is accepted.
    ///
    /// The cost falls by more than further coordinates are worth, or rises by less than fewer of them are: [`PRESENT`]
    /// standard errors each, at which a parameter is as likely to be there as not, and no less than the share
    /// [`PARAMETER_SHARE_LEAST`] of the cost, which is what errors that are no white noise may take.
    pub(super) fn is_better(&self, other: &Fit, fit: &Fit) -> bool {
        let (before, after) = (self.cost(fit, &fit.noise), self.cost(other, &fit.noise));
        let more = other.coordinates() as f64 - fit.coordinates() as f64;
        after + (PRESENT * PRESENT).max(PARAMETER_SHARE_LEAST * before) * more < before
    }

    /// A fit before its first step; `None` where no window can be cut.
    pub(super) fn first_fit(&self, arm: &ModalArm, window_s: f64) -> Option<Fit> {
        let longest = self.longest_s();
        let window_s = window_s.min(longest);
        let body = Body::of_masses(self.campaign, arm.clone());
        let windows = some(cut(self.campaign, &body.arm, window_s));
        if windows.is_empty() || !is_possible(self.campaign, &body.arm) {
            return None;
        }
        let mut free = free_parameters(&self.campaign.channels, arm);
        let apart = Parameter::ViscousDifference.of(arm);
        free.extend((apart != 0.0).then_some(Parameter::ViscousDifference));
        free.extend((arm.command_lag_s != 0.0).then_some(Parameter::CommandLag));
        let late = (0..arm.shapes.len()).map(Parameter::TipLag);
        free.extend(late.filter(|lag| lag.of(arm) != 0.0));
        Some(Fit {
            body,
            windows,
            free,
            noise: self.noise.to_vec(),
            residual: Vec::new(),
            whole_runs: window_s >= longest,
            window_s,
        })
    }

    /// Back on windows as short as the first.
    pub(super) fn shorten(&self, fit: &mut Fit) {
        fit.window_s = self.first_window_s(&fit.body.arm).min(self.longest_s());
        fit.whole_runs = fit.window_s >= self.longest_s();
        fit.windows = some(cut(self.campaign, &fit.body.arm, fit.window_s));
    }

    pub(super) fn longest_s(&self) -> f64 {
        self.campaign.runs.iter().map(duration_s).fold(0.0, f64::max)
    }

    /// Searches from where the fit is and takes its noise from what is left.
    pub(super) fn search(&self, fit: &mut Fit, report: &mut Report) {
        for _ in 0..NOISE_ROUNDS_MOST {
            let (point, stop) = self.steps(fit, report, STAGE_STEPS_MOST, STAGE_STEP_FALL, None);
            // Another law is there to the end or not at all.
            let lawful = !fit.body.arm.dry_terms.is_empty();
            let to_the_end = fit.whole_runs || lawful || report.grown(&fit.residual);
            if stop == Stop::StepsUsedUp && to_the_end {
                self.steps(fit, report, LAST_STEPS_MOST, STAGE_STEP_FALL, Some(point));
            }
            let noise = self.noise_of(fit);
            let before = std::mem::replace(&mut fit.noise, noise);
            let same = |(a, b): (&SensorNoise, &SensorNoise)| {
                b.deviation() > NOISE_SETTLED * a.deviation()
            };
            if before.iter().zip(&fit.noise).all(same) || !to_the_end {
                break;
            }
        }
    }

    /// Noise for what follows: short windows leave each channel what it has. Over whole runs a channel
    /// that the arm misses would count less and be missed by more: the channels keep the ratios of the
    /// noise that their samples show.
    fn noise_of(&self, fit: &Fit) -> Vec<SensorNoise> {
        if !fit.whole_runs {
            return fit.residual.iter().map(|r| SensorNoise::gaussian(*r)).collect();
        }
        let own = self.noise;
        let ratio = |(r, n): (&f64, &SensorNoise)| (r / n.deviation()).powi(2);
        let squares: f64 = fit.residual.iter().zip(own).map(ratio).sum();
        let common = (squares / own.len() as f64).sqrt();
        own.iter().map(|n| SensorNoise::gaussian(common * n.deviation())).collect()
    }

    /// At most `most` steps that promise at least `promise`, from where others have come to if there were
    /// some; where these come to, and why they ended.
    fn steps(
        &self,
        fit: &mut Fit,
        report: &mut Report,
        most: usize,
        promise: f64,
        from: Option<Point>,
    ) -> (Point, Stop) {
        let mut problem =
            Problem { promise, ..self.problem(&fit.free, &fit.noise, fit.whole_runs) };
        if self.beyond_noise(fit) > RESIDUAL_FAR_ABOVE_NOISE {
            problem.near_enough = STEP_SHARE_LEAST;
        }
        let start =
            from.unwrap_or_else(|| problem.at(fit.body.clone(), std::mem::take(&mut fit.windows)));
        let (point, iterations, stop) = problem.search(start, most);
        fit.residual = residual_deviation(&point, fit.coordinates());
        report.stages.push(StageReport {
            window_s: fit.window_s,
            windows: point.windows.len(),
            iterations,
            stop,
            noise: fit.noise.clone(),
            residual: fit.residual.clone(),
            arm: point.body.arm.clone(),
        });
        (fit.body, fit.windows) = (point.body.clone(), point.windows.clone());
        (point, stop)
    }

    /// At most so many steps on a part of the windows: the cost that they come to, and the body. `None` where a
    /// mode is too fast for the samples.
    pub(super) fn probe(&self, fit: &Fit, steps: usize) -> Option<(f64, Body)> {
        if !is_possible(self.campaign, &fit.body.arm) {
            return None;
        }
        let samples: usize = fit.windows.iter().map(Window::len).sum();
        let every = samples.div_ceil(PROBE_SAMPLES).min(fit.windows.len()).max(1);
        let windows = fit.windows.iter().step_by(every).cloned().collect();
        let mut problem = self.problem(&fit.free, &fit.noise, fit.whole_runs);
        problem.near_enough = STEP_SHARE_LEAST;
        let (point, ..) = problem.search(problem.at(fit.body.clone(), windows), steps);
        Some((point.sums.iter().map(|s| s.cost).sum(), point.body))
    }

    pub(super) fn first_window_s(&self, arm: &ModalArm) -> f64 {
        let sample_s =
            self.campaign.runs.iter().map(Run::sample_time_s).fold(f64::INFINITY, f64::min);
        let slowest = arm.modes.iter().map(|m| m.omega_rad_s).fold(f64::INFINITY, f64::min);
        let period_s = std::f64::consts::TAU / slowest;
        (FIRST_WINDOW_SAMPLES * sample_s).max(FIRST_WINDOW_PERIODS * period_s)
    }

    /// The sensors' steps as what they are. They count once the fit is near: within one there is
    /// nothing that would lead there. Gives the samples that count where some only repeat a step.
    pub(super) fn count_steps(&self, fit: &mut Fit, report: &mut Report) -> Option<Vec<Masks>> {
        let steps = noise::steps(self.campaign);
        let predicted: Vec<Option<Prediction>> = fit
            .windows
            .par_iter()
            .with_max_len(1)
            .map(|window| predict(&fit.body.arm, self.campaign, window))
            .collect();
        let left = noise::residuals(self.campaign, &fit.windows, &predicted, self.masks);
        fit.noise = left.iter().zip(&steps).map(|(e, q)| noise::most_likely(e, *q)).collect();
        let Some(masks) = without_repeats(self.campaign, fit, &predicted, self.masks) else {
            self.steps(fit, report, STAGE_STEPS_MOST, LAST_STEP_FALL, None);
            return None;
        };
        // Without noise there is no cost lower than another but by the edges of steps: a longer way.
        Fitting { masks: &masks, ..*self }.steps(
            fit,
            report,
            LAST_STEPS_MOST,
            LAST_STEP_FALL,
            None,
        );
        Some(masks)
    }
}

/// Windows enough to find the way: every so manieth.
pub(super) fn some(windows: Vec<Window>) -> Vec<Window> {
    let samples: usize = windows.iter().map(Window::len).sum();
    windows.into_iter().step_by(samples.div_ceil(STAGE_SAMPLES).max(1)).collect()
}

fn duration_s(run: &Run) -> f64 {
    run.len() as f64 * run.sample_time_s()
}

/// Deviation of each channel's residual, its share of the unknowns taken out.
fn residual_deviation(point: &Point, shared: usize) -> Vec<f64> {
    let channels = point.sums.first().map_or(0, |s| s.squares.len());
    let own = |s: &WindowSums| s.gram.ncols() - 1 - shared;
    let unknowns = point.sums.iter().map(own).sum::<usize>() + shared;
    (0..channels)
        .map(|c| {
            let readings: usize = point.sums.iter().map(|s| s.readings[c]).sum();
            let free = (readings as f64 - unknowns as f64 / channels as f64).max(1.0);
            let square: f64 = point.sums.iter().map(|s| s.squares[c]).sum();
            (square / free).sqrt().max(f64::MIN_POSITIVE)
        })
        .collect()
}
