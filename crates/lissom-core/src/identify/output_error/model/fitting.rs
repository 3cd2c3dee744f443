//! Searches, short searches (probes) and costs of a campaign's fits.

use rayon::prelude::*;

use crate::identify::methods::friction_law::LawTerm;
use crate::identify::output_error::engine::budget::Budget;
use crate::identify::output_error::engine::covariance::Covariances;
use crate::identify::output_error::engine::data::Masks;
use crate::identify::output_error::engine::noise;
use crate::identify::output_error::engine::search::{
    ReplayProblem, SearchPoint, Stop, is_possible,
};
use crate::identify::output_error::engine::windows::cut;
use crate::identify::output_error::model::describes::sees_modes;
use crate::identify::output_error::model::fit::{ArmFit, Report, StageReport};
use crate::identify::output_error::model::repeats::without_repeats;
use crate::identify::output_error::thresholds::{
    EXCESS_LEFT, FIRST_WINDOW_PERIODS, FIRST_WINDOW_SAMPLES, LAST_STEP_FALL, LAST_STEPS_MOST,
    NOISE_ROUNDS_MOST, NOISE_SETTLED, PARAMETER_SHARE_LEAST, PROBE_SAMPLES, RESIDUAL_ABOVE_NOISE,
    RESIDUAL_FAR_ABOVE_NOISE, STAGE_SAMPLES, STAGE_STEP_FALL, STAGE_STEPS_MOST, STEP_SHARE_LEAST,
};
use crate::identify::thresholds::PRESENT;
use crate::record::{Campaign, Run};
use crate::replay::{
    Blocks, Body, ModalArm, Parameter, Prediction, Sampling, SensorNoise, Window, WindowSums,
    costs, free_parameters, predict,
};

/// A campaign with what all of its fits share.
pub(crate) struct Fitting<'a> {
    pub(crate) campaign: &'a Campaign,
    pub(crate) masks: &'a [Masks],
    pub(crate) blocks: &'a [Blocks],
    /// Terms of friction that slip phases hardly show.
    pub(crate) further_terms: &'a [LawTerm],
    /// Modes that the responses of the tips show \[rad/s\].
    pub(crate) shown_rad_s: &'a [f64],
    /// Noise of each channel, estimated from its samples alone.
    pub(crate) noise: &'a [SensorNoise],
    /// Acceleration of the motor that noise of a measured command makes at most \[rad/s² or m/s²\].
    pub(crate) command_noise_most: f64,
    /// Limit of evaluations of the whole search.
    pub(crate) budget: &'a Budget,
    /// Factor by which each stage's windows are longer than the ones before.
    pub(crate) widening: f64,
}

impl Fitting<'_> {
    pub(crate) fn problem<'b>(
        &'b self,
        free: &'b [Parameter],
        (noise, command_noise): (&'b [SensorNoise], f64),
        whole_runs: bool,
    ) -> ReplayProblem<'b> {
        let sampling = Sampling { noise, blocks: &[], masks: self.masks, command_noise };
        let robust = !whole_runs;
        let near_enough = if robust { STEP_SHARE_LEAST } else { 0.0 };
        let promise = STAGE_STEP_FALL;
        ReplayProblem {
            campaign: self.campaign,
            parameters: free,
            sampling,
            budget: self.budget,
            robust,
            promise,
            near_enough,
        }
    }

    /// Largest ratio of a channel's residual to its noise as estimated from the samples alone.
    pub(crate) fn beyond_noise(&self, fit: &ArmFit) -> f64 {
        fit.residual.iter().zip(self.noise).map(|(r, n)| r / n.sigma).fold(0.0, f64::max)
    }

    /// Whether a fit replays whole runs, or windows that determine its modes.
    pub(crate) fn sees_modes(&self, fit: &ArmFit) -> bool {
        fit.whole_runs || sees_modes(&fit.body.arm, &self.campaign.channels.tips, fit.window_s)
    }

    /// Replays a fit with derivatives by the parameters `free`, and with sums by blocks.
    pub(crate) fn point(&self, fit: &ArmFit, free: &[Parameter]) -> SearchPoint {
        let mut problem = self.problem(free, fit.assumed_noise(), true);
        problem.sampling.blocks = self.blocks;
        problem.at(fit.body.clone(), fit.windows.clone())
    }

    /// Covariances of the free parameters.
    pub(crate) fn covariances(&self, fit: &ArmFit) -> Covariances {
        fit.covariances(&self.point(fit, &fit.free).sums)
    }

    /// Cost of a fit for this noise, and by how much noise of the command widens that of the sensors.
    pub(crate) fn costs(&self, fit: &ArmFit, sampling: Sampling<'_>) -> [f64; 2] {
        let samples: usize = fit.windows.iter().map(Window::len).sum();
        self.budget.count(samples, 0, sampling.command_noise > 0.0);
        let found = costs(&fit.body.arm, self.campaign, &fit.windows, sampling);
        found.iter().fold([0.0; 2], |[cost, widened], w| [cost + w.cost, widened + w.widened])
    }

    /// Whether `other` is better than `fit`: the one rule by which a change of the model is accepted.
    ///
    /// If it has more coordinates, the cost must fall by more than these are worth. If it has fewer, the cost may
    /// rise by less than these are worth. A coordinate is worth the square of [`PRESENT`], the standard errors at
    /// which a parameter is as likely to be present as not, and at least the share [`PARAMETER_SHARE_LEAST`] of the
    /// cost, which errors that are not white noise may take. Each further unknown of a window takes one by chance. Where the
    /// residual is above the noise, more coordinates must also explain a good part of that excess ([`EXCESS_LEFT`]): any
    /// parameter takes some of the error of an arm that lacks something else.
    pub(crate) fn is_better(&self, other: &ArmFit, fit: &ArmFit) -> bool {
        let (noise, command_noise) = fit.assumed_noise();
        let sampling = Sampling { noise, blocks: &[], masks: self.masks, command_noise };
        let cost = |fit: &ArmFit| self.costs(fit, sampling)[0];
        let (before, after) = (cost(fit), cost(other));
        let more = other.coordinates() as f64 - fit.coordinates() as f64;
        let own = |fit: &ArmFit| fit.windows.iter().map(|w| w.start.len()).sum::<usize>() as f64;
        let by_chance = own(other) - own(fit);
        let worth = (PRESENT * PRESENT).max(PARAMETER_SHARE_LEAST * before);
        let cheaper = after + worth * more + by_chance < before;
        let above_noise = self.beyond_noise(fit) > RESIDUAL_ABOVE_NOISE;
        let explains = || self.excess(other) <= EXCESS_LEFT * self.excess(fit);
        cheaper && (more <= 0.0 || !above_noise || explains())
    }

    /// Squares of the residuals beyond the sensors' noise, relative to that noise, summed over the channels.
    pub(crate) fn excess(&self, fit: &ArmFit) -> f64 {
        let each = fit.residual.iter().zip(self.noise);
        each.map(|(r, n)| ((r / n.sigma).powi(2) - 1.0).max(0.0)).sum()
    }

    /// A fit before its first step; `None` if no window can be cut or the arm is outside the limits of the search.
    pub(crate) fn first_fit(&self, arm: &ModalArm, window_s: f64) -> Option<ArmFit> {
        let longest = self.longest_s();
        let window_s = window_s.min(longest);
        let body = Body::of_masses(&self.campaign.channels, arm.clone());
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
        Some(ArmFit {
            body,
            windows,
            free,
            noise: self.noise.to_vec(),
            command_noise: 0.0,
            residual: Vec::new(),
            whole_runs: window_s >= longest,
            window_s,
        })
    }

    /// Returns to windows as short as the first.
    pub(crate) fn shorten(&self, fit: &mut ArmFit) {
        fit.window_s = self.first_window_s(&fit.body.arm).min(self.longest_s());
        fit.whole_runs = fit.window_s >= self.longest_s();
        fit.windows = some(cut(self.campaign, &fit.body.arm, fit.window_s));
    }

    pub(crate) fn longest_s(&self) -> f64 {
        self.campaign.runs.iter().map(duration_s).fold(0.0, f64::max)
    }

    /// Searches from the fit's present state, and estimates its noise from the residual.
    pub(crate) fn search(&self, fit: &mut ArmFit, report: &mut Report) {
        for _ in 0..NOISE_ROUNDS_MOST {
            let (point, stop) = self.steps(fit, report, STAGE_STEPS_MOST, STAGE_STEP_FALL, None);
            // A fit with further friction terms is searched to the end before it is compared.
            let lawful = !fit.body.arm.dry_terms.is_empty();
            let to_the_end = fit.whole_runs || lawful || report.grown(&fit.residual);
            if stop == Stop::StepsUsedUp && to_the_end {
                self.steps(fit, report, LAST_STEPS_MOST, STAGE_STEP_FALL, Some(point));
            }
            let noise = self.noise_of(fit);
            let before = std::mem::replace(&mut fit.noise, noise);
            let command_noise = self.likely_command_noise(fit);
            let told = std::mem::replace(&mut fit.command_noise, command_noise);
            let settled =
                command_noise <= told / NOISE_SETTLED && told <= command_noise / NOISE_SETTLED;
            let same = |(a, b): (&SensorNoise, &SensorNoise)| {
                b.deviation() > NOISE_SETTLED * a.deviation()
            };
            if settled && (before.iter().zip(&fit.noise).all(same) || !to_the_end) {
                break;
            }
        }
    }

    /// Noise of each channel for the next search. On short windows it is the channel's residual. Over whole runs a
    /// channel that the arm does not describe would get a lower weight, and would be described even worse. So the
    /// channels keep the ratios of the noise that their samples show.
    fn noise_of(&self, fit: &ArmFit) -> Vec<SensorNoise> {
        if !fit.whole_runs {
            return fit.residual.iter().map(|r| SensorNoise::gaussian(*r)).collect();
        }
        let own = self.noise;
        let ratio = |(r, n): (&f64, &SensorNoise)| (r / n.deviation()).powi(2);
        let squares: f64 = fit.residual.iter().zip(own).map(ratio).sum();
        let common = (squares / own.len() as f64).sqrt();
        own.iter().map(|n| SensorNoise::gaussian(common * n.deviation())).collect()
    }

    /// Makes at most `most` steps, each of which must be expected to lower the cost by `promise`. Begins at `from` if
    /// it is given. Returns where the steps end and why.
    fn steps(
        &self,
        fit: &mut ArmFit,
        report: &mut Report,
        most: usize,
        promise: f64,
        from: Option<SearchPoint>,
    ) -> (SearchPoint, Stop) {
        let (noise, command_noise) = (fit.noise.clone(), fit.command_noise);
        let mut problem = ReplayProblem {
            promise,
            ..self.problem(&fit.free, (&noise, command_noise), fit.whole_runs)
        };
        if self.beyond_noise(fit) > RESIDUAL_FAR_ABOVE_NOISE {
            problem.near_enough = STEP_SHARE_LEAST;
        }
        let start =
            from.unwrap_or_else(|| problem.at(fit.body.clone(), std::mem::take(&mut fit.windows)));
        let (point, iterations, stop) = problem.search(start, most);
        fit.residual = residual_deviation(&point, fit.coordinates(), self.noise);
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

    /// Makes a short search on a part of the windows. Returns its cost and the body; `None` if the arm is outside the
    /// limits of the search, or all evaluations allowed are made.
    pub(crate) fn probe(&self, fit: &ArmFit, steps: usize) -> Option<(f64, Body)> {
        if self.budget.is_spent() || !is_possible(self.campaign, &fit.body.arm) {
            return None;
        }
        let samples: usize = fit.windows.iter().map(Window::len).sum();
        let most = if fit.command_noise > 0.0 { PROBE_SAMPLES / 3 } else { PROBE_SAMPLES };
        let every = samples.div_ceil(most).min(fit.windows.len()).max(1);
        let windows = fit.windows.iter().step_by(every).cloned().collect();
        let mut problem = self.problem(&fit.free, fit.assumed_noise(), fit.whole_runs);
        problem.near_enough = STEP_SHARE_LEAST;
        let (point, ..) = problem.search(problem.at(fit.body.clone(), windows), steps);
        Some((point.sums.iter().map(|s| s.cost).sum(), point.body))
    }

    pub(crate) fn first_window_s(&self, arm: &ModalArm) -> f64 {
        let sample_s =
            self.campaign.runs.iter().map(Run::sample_time_s).fold(f64::INFINITY, f64::min);
        let slowest = arm.modes.iter().map(|m| m.omega_rad_s).fold(f64::INFINITY, f64::min);
        let period_s = std::f64::consts::TAU / slowest;
        (FIRST_WINDOW_SAMPLES * sample_s).max(FIRST_WINDOW_PERIODS * period_s)
    }

    /// Searches with the probability of each sensor's steps in place of Gaussian noise. The fit must be close
    /// already, because the cost is flat within a step. Returns the samples that are used if readings that only
    /// repeat a step are left out.
    pub(crate) fn count_steps(&self, fit: &mut ArmFit, report: &mut Report) -> Option<Vec<Masks>> {
        if fit.command_noise > 0.0 {
            return None;
        }
        let steps = noise::steps(self.campaign);
        let predicted: Vec<Option<Prediction>> = fit
            .windows
            .par_iter()
            .with_max_len(1)
            .map(|window| predict(&fit.body.arm, self.campaign, window))
            .collect();
        let left = noise::residuals(self.campaign, &fit.windows, &predicted, self.masks);
        let likely = |((e, q), own): ((&Vec<f64>, &f64), &SensorNoise)| {
            noise::most_likely(e, *q, f64::EPSILON * own.sigma)
        };
        fit.noise = left.iter().zip(&steps).zip(self.noise).map(likely).collect();
        let Some(masks) = without_repeats(self.campaign, fit, &predicted, self.masks) else {
            self.steps(fit, report, STAGE_STEPS_MOST, LAST_STEP_FALL, None);
            return None;
        };
        // Without noise only the edges of the steps change the cost: the search needs more steps.
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

/// Every n-th window, so that about [`STAGE_SAMPLES`] samples are replayed.
pub(crate) fn some(windows: Vec<Window>) -> Vec<Window> {
    let samples: usize = windows.iter().map(Window::len).sum();
    windows.into_iter().step_by(samples.div_ceil(STAGE_SAMPLES).max(1)).collect()
}

fn duration_s(run: &Run) -> f64 {
    run.len() as f64 * run.sample_time_s()
}

/// Standard deviation of each channel's residual, corrected for the number of unknowns; no less than rounding of the `noise`,
/// so that sums of logs which an arm describes exactly stay finite.
fn residual_deviation(point: &SearchPoint, shared: usize, noise: &[SensorNoise]) -> Vec<f64> {
    let channels = point.sums.first().map_or(0, |s| s.squares.len());
    let own = |s: &WindowSums| s.gram.ncols() - 1 - shared;
    let unknowns = point.sums.iter().map(own).sum::<usize>() + shared;
    (0..channels)
        .map(|c| {
            let readings: usize = point.sums.iter().map(|s| s.readings[c]).sum();
            let free = (readings as f64 - unknowns as f64 / channels as f64).max(1.0);
            let square: f64 = point.sums.iter().map(|s| s.squares[c]).sum();
            (square / free).sqrt().max(f64::EPSILON * noise[c].sigma)
        })
        .collect()
}
