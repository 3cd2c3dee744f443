//! From short windows to whole runs, and what each step of the way left.

use rayon::prelude::*;

use super::AT_NOISE;
use super::by_run::ByRun;
use super::coordinates::Body;
use super::covariance::Covariances;
use super::data::Masks;
use super::evidence::{self, Extension};
use super::figures::BEYOND;
use super::modes;
use super::noise;
use super::repeats::without_repeats;
use super::search::{Iteration, PROMISE, PROMISE_ON_THE_WAY, Point, Problem, Stop, is_possible};
use super::windows::{cut, widen};
use crate::identify::LawTerm;
use crate::record::{Campaign, Run};
use crate::replay::{
    Blocks, ModalArm, Parameter, Prediction, Sampling, SensorNoise, Window, WindowSums, costs,
    free_parameters, predict,
};

/// Most steps of a stage before the last, which only leads to it.
const STEPS_ON_THE_WAY: usize = 12;
/// Samples replayed on that way, about.
const SAMPLES_ON_THE_WAY: usize = 40_000;
/// Steps of a probe, and samples replayed for it, about.
pub(super) const STEPS_OF_A_PROBE: usize = 8;
const SAMPLES_OF_A_PROBE: usize = 15_000;
/// On the way, and where more than noise is left, a step is not worth a replay that promises less
/// than this share of the cost.
const NEAR_ENOUGH: f64 = 1e-4;
/// Most steps of the last stage.
const MOST_STEPS: usize = 40;
/// Most searches on end, each with the noise that the one before left, until no channel's falls by more
/// than this.
const MOST_ROUNDS: usize = 4;
const SETTLED: f64 = 0.9;
/// Each stage's windows are longer than the ones before by this factor.
pub(super) const WIDENING: f64 = 4.0;
/// By this one after a search that was caught.
pub(super) const SLOWER: f64 = 1.6;
/// Samples of the first windows, at least, and their share of the slowest mode's period.
const FIRST_SAMPLES: f64 = 80.0;
const FIRST_PERIODS: f64 = 0.3;
/// Windows are not widened further once the residual has grown by this factor: what the arm does
/// not describe adds up over a window, and what a sensor adds does not.
pub(super) const GROWN: f64 = 1.5;

/// One length of windows.
#[derive(Debug, Clone, PartialEq)]
pub struct StageReport {
    /// Longest window \[s\].
    pub window_s: f64,
    /// Number of windows.
    pub windows: usize,
    /// Every step tried.
    pub iterations: Vec<Iteration>,
    /// Why it ended.
    pub stop: Stop,
    /// Noise that each channel was taken to have, motor first, then tips.
    pub noise: Vec<SensorNoise>,
    /// Deviation of each channel's residual, its share of the unknowns taken out.
    pub residual: Vec<f64>,
    /// The arm at its end.
    pub arm: ModalArm,
}

/// A campaign as the fits see it.
pub(super) struct Fitting<'a> {
    pub(super) campaign: &'a Campaign,
    pub(super) masks: &'a [Masks],
    pub(super) blocks: &'a [Blocks],
    /// Terms of friction that slip phases show.
    pub(super) law: &'a [LawTerm],
    /// Noise that the samples show by themselves.
    pub(super) noise: &'a [SensorNoise],
    /// Factor by which each stage's windows are longer than the ones before.
    pub(super) widening: f64,
    /// Which laws of friction are tried.
    pub(super) laws: Laws,
}

/// Which laws of friction a fit may come to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Laws {
    /// That of its start.
    AsStarted,
    /// Others where more than the sensors' noise is left; on bristles any whose terms are likelier than none.
    BeyondNoise,
    /// Any whose terms are likelier than none.
    Likelier,
}

/// Where a fit is.
#[derive(Debug, Clone)]
pub(super) struct Fit {
    pub(super) body: Body,
    pub(super) windows: Vec<Window>,
    /// What is free.
    pub(super) free: Vec<Parameter>,
    /// Noise that each channel is taken to have.
    pub(super) noise: Vec<SensorNoise>,
    /// Deviation of each channel's residual, its share of the unknowns taken out.
    pub(super) residual: Vec<f64>,
    /// Whether windows are as long as can be told: whole runs, or all windows of the longest that do not diverge.
    pub(super) whole_runs: bool,
    pub(super) window_s: f64,
}

impl Fit {
    /// How many numbers a search moves.
    pub(super) fn coordinates(&self) -> usize {
        self.body.coordinates(&self.free).len()
    }

    /// Covariances of the free parameters, from sums by what they move.
    pub(super) fn covariances(&self, sums: &[WindowSums]) -> Covariances {
        let found = Covariances::at(sums, self.coordinates());
        match self.body.jacobian(&self.free) {
            Some(jacobian) => found.through(&jacobian),
            None => found,
        }
    }

    /// The same sums run by run.
    pub(super) fn by_run(&self, sums: &[WindowSums]) -> ByRun {
        ByRun::of(sums, &self.windows, self.coordinates(), self.body.jacobian(&self.free))
    }
}

/// What was done.
#[derive(Debug, Default)]
pub(super) struct Report {
    pub(super) stages: Vec<StageReport>,
    /// First of them under the law that friction has now.
    under_law: usize,
    /// Parameters that were added.
    pub(super) added: Vec<Extension>,
    /// Those that were not, when last tried.
    pub(super) refused: Vec<Extension>,
}

impl Report {
    /// Whether a residual is larger than that of the first windows, under the law that they are under
    /// now, by what no sensor adds. Bristles begin far from where the first windows bring them: there it is what
    /// these came to.
    fn grown(&self, residual: &[f64]) -> bool {
        let under_law = self.stages.get(self.under_law..).unwrap_or_default();
        let on_bristles = |s: &&StageReport| s.arm.dry_terms.bristles.is_some();
        let first = match under_law.first().filter(on_bristles) {
            Some(_) => least_on_first_windows(under_law),
            None => under_law.first(),
        };
        let least = first.map_or(residual, |s| &s.residual);
        least.iter().zip(residual).any(|(a, b)| *b > GROWN * a)
    }

    /// The stage that left least on the first windows.
    pub(super) fn on_first_windows(&self) -> Option<&StageReport> {
        least_on_first_windows(&self.stages)
    }

    /// Another fit was taken in the end, which these stages led to; what it has not is not added.
    pub(super) fn replaced_by(&mut self, mut other: Self, free: &[Parameter]) {
        self.stages.append(&mut other.stages);
        self.added.retain(|e| free.contains(&e.parameter));
    }

    /// Friction has another law from the last stage on.
    pub(super) fn law_changed(&mut self) {
        self.under_law = self.stages.len().saturating_sub(1);
    }
}

/// Of the stages on windows as short as the first, some of which tried what was not taken, the one that left
/// least.
fn least_on_first_windows(stages: &[StageReport]) -> Option<&StageReport> {
    let first = stages.first()?;
    let left = |s: &StageReport| {
        let each = s.residual.iter().zip(&first.residual);
        each.map(|(now, then)| (now / then).powi(2)).sum::<f64>()
    };
    let is_told = |s: &&StageReport| s.residual.iter().all(|r| *r > f64::MIN_POSITIVE);
    let short = stages.iter().take_while(|s| s.window_s <= first.window_s);
    short.filter(is_told).min_by(|a, b| left(a).total_cmp(&left(b))).or(Some(first))
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
        let near_enough = if robust { NEAR_ENOUGH } else { 0.0 };
        let promise = PROMISE_ON_THE_WAY;
        Problem {
            campaign: self.campaign,
            parameters: free,
            sampling,
            robust,
            promise,
            near_enough,
        }
    }

    /// Squares of the residuals beyond the noise that the samples show by themselves, in that noise.
    pub(super) fn excess(&self, fit: &Fit) -> f64 {
        let each = fit.residual.iter().zip(self.noise);
        each.map(|(r, n)| ((r / n.sigma).powi(2) - 1.0).max(0.0)).sum()
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
        let sampling = Sampling { noise, blocks: &[], masks: self.masks };
        costs(&fit.body.arm, self.campaign, &fit.windows, sampling).iter().sum()
    }

    /// Searches on the first windows, short ones.
    pub(super) fn begin(&self, arm: &ModalArm, window_s: f64, report: &mut Report) -> Option<Fit> {
        let mut fit = self.first_fit(arm, window_s)?;
        self.search(&mut fit, report);
        modes::drop_unfelt(self, &mut fit, report);
        modes::grow(self, &mut fit, report);
        evidence::extend(self, &mut fit, report);
        Some(fit)
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

    fn longest_s(&self) -> f64 {
        self.campaign.runs.iter().map(duration_s).fold(0.0, f64::max)
    }

    /// To whole runs, as far as the arm describes them and neighbouring motions stay together; parameters are added
    /// where it does not. What grows over windows in which motions part is not told from these.
    pub(super) fn widen(&self, fit: &mut Fit, report: &mut Report) {
        let longest = self.longest_s();
        let mut factor = self.widening;
        while !fit.whole_runs {
            let before = fit.clone();
            let (under_law, added) = (report.under_law, report.added.len());
            fit.window_s = (fit.window_s * factor).min(longest);
            fit.whole_runs = fit.window_s >= longest;
            let windows = widen(self.campaign, &fit.body.arm, &fit.windows, fit.window_s);
            fit.windows = if fit.whole_runs { windows } else { some(windows) };
            self.search(fit, report);
            if report.grown(&fit.residual) {
                modes::grow(self, fit, report);
                evidence::extend(self, fit, report);
                evidence::relax(self, fit, report);
            }
            let diverges = self.diverges(fit);
            if report.grown(&fit.residual) || diverges {
                *fit = before;
                report.under_law = under_law;
                report.added.truncate(added);
                let at_noise = self.beyond_noise(fit) <= AT_NOISE;
                if factor < WIDENING || !at_noise {
                    let lawful = !fit.body.arm.dry_terms.is_empty();
                    if diverges && at_noise && lawful {
                        self.take_all(fit, report);
                    }
                    return;
                }
                // The windows before are described to the noise: this search was caught on the way.
                factor = SLOWER;
            }
        }
    }

    /// Searches from where the fit is and takes its noise from what is left.
    pub(super) fn search(&self, fit: &mut Fit, report: &mut Report) {
        for _ in 0..MOST_ROUNDS {
            let (point, stop) = self.steps(fit, report, STEPS_ON_THE_WAY, PROMISE_ON_THE_WAY, None);
            // Another law is there to the end or not at all.
            let lawful = !fit.body.arm.dry_terms.is_empty();
            let to_the_end = fit.whole_runs || lawful || report.grown(&fit.residual);
            if stop == Stop::StepsUsedUp && to_the_end {
                self.steps(fit, report, MOST_STEPS, PROMISE_ON_THE_WAY, Some(point));
            }
            let noise = self.noise_of(fit);
            let before = std::mem::replace(&mut fit.noise, noise);
            let same =
                |(a, b): (&SensorNoise, &SensorNoise)| b.deviation() > SETTLED * a.deviation();
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
        if self.beyond_noise(fit) > BEYOND {
            problem.near_enough = NEAR_ENOUGH;
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
        let every = samples.div_ceil(SAMPLES_OF_A_PROBE).min(fit.windows.len()).max(1);
        let windows = fit.windows.iter().step_by(every).cloned().collect();
        let mut problem = self.problem(&fit.free, &fit.noise, fit.whole_runs);
        problem.near_enough = NEAR_ENOUGH;
        let (point, ..) = problem.search(problem.at(fit.body.clone(), windows), steps);
        Some((point.sums.iter().map(|s| s.cost).sum(), point.body))
    }

    pub(super) fn first_window_s(&self, arm: &ModalArm) -> f64 {
        let sample_s =
            self.campaign.runs.iter().map(Run::sample_time_s).fold(f64::INFINITY, f64::min);
        let slowest = arm.modes.iter().map(|m| m.omega_rad_s).fold(f64::INFINITY, f64::min);
        let period_s = std::f64::consts::TAU / slowest;
        (FIRST_SAMPLES * sample_s).max(FIRST_PERIODS * period_s)
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
            self.steps(fit, report, STEPS_ON_THE_WAY, PROMISE, None);
            return None;
        };
        // Without noise there is no cost lower than another but by the edges of steps: a longer way.
        Fitting { masks: &masks, ..*self }.steps(fit, report, MOST_STEPS, PROMISE, None);
        Some(masks)
    }
}

/// Windows enough to find the way: every so manieth.
fn some(windows: Vec<Window>) -> Vec<Window> {
    let samples: usize = windows.iter().map(Window::len).sum();
    windows.into_iter().step_by(samples.div_ceil(SAMPLES_ON_THE_WAY).max(1)).collect()
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
