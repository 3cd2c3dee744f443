//! Output error: the logged command replayed through an arm whose figures are moved until it shows
//! the logged angles.

mod covariance;
mod data;
mod evidence;
mod figures;
mod follow;
mod noise;
mod normal;
mod prune;
mod search;
mod start;
mod windows;

use nalgebra::{DMatrix, DVector};

use super::Estimate;
use crate::record::{Campaign, Run};
use crate::replay::{ModalArm, Parameter, Sampling, SensorNoise, Window};
use covariance::Covariances;
pub(crate) use data::{Masks, masks};
pub use evidence::Extension;
pub(crate) use follow::follow;
pub use search::{Iteration, Stop};
use search::{Point, Problem};
pub use start::{free_parameters, starts};
use windows::{cut, widen};

/// Most steps of a stage before the last, which only leads to it.
const STEPS_ON_THE_WAY: usize = 12;
/// Samples replayed on that way, about.
const SAMPLES_ON_THE_WAY: usize = 40_000;
/// Most steps of the last stage.
const MOST_STEPS: usize = 40;
/// Each stage's windows are longer than the ones before by this factor.
const WIDENING: f64 = 4.0;
/// Samples of the first windows, at least, and their share of the slowest mode's period.
const FIRST_SAMPLES: f64 = 80.0;
const FIRST_PERIODS: f64 = 0.3;
/// Windows are not widened further once the residual has grown by this factor: what the arm does
/// not describe adds up over a window, and what a sensor adds does not.
const GROWN: f64 = 1.5;

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
}

/// What the output error gives.
#[derive(Debug, Clone)]
pub struct OutputError {
    /// The arm found.
    pub arm: ModalArm,
    /// What was free.
    pub parameters: Vec<Parameter>,
    /// Covariance of these, in their own units.
    pub covariance: DMatrix<f64>,
    /// As if the residual were white.
    pub white: DMatrix<f64>,
    /// By blocks left out.
    pub blocks: DMatrix<f64>,
    /// Windows of the last stage, with the states at which they begin.
    pub windows: Vec<Window>,
    /// Every length of windows, in order.
    pub stages: Vec<StageReport>,
    /// Every parameter that was tried beside those of the simplest law.
    pub extensions: Vec<Extension>,
    /// Whether windows were widened to the whole of the runs: the arm describes them.
    pub whole_runs: bool,
    /// Residual of the last stage beside the noise of the samples alone: the largest ratio of a channel.
    pub beyond_noise: f64,
}

impl OutputError {
    /// A parameter with its deviation; `None` where it was not free.
    pub fn estimate(&self, parameter: Parameter) -> Option<Estimate> {
        let i = self.parameters.iter().position(|p| *p == parameter)?;
        let std = self.covariance[(i, i)].max(0.0).sqrt();
        Some(Estimate { value: parameter.of(&self.arm), std })
    }

    /// Any figure of the arm, its deviation from the parameters' by differences over half a
    /// deviation of each.
    pub fn figure(&self, of: impl Fn(&ModalArm) -> f64) -> Estimate {
        let slopes = DVector::from_iterator(
            self.parameters.len(),
            self.parameters.iter().enumerate().map(|(i, p)| {
                let half = 0.5 * self.covariance[(i, i)].max(0.0).sqrt();
                let with = |change: f64| {
                    let mut arm = self.arm.clone();
                    p.set(&mut arm, p.of(&self.arm) + change);
                    of(&arm)
                };
                if half > 0.0 { (with(half) - with(-half)) / (2.0 * half) } else { 0.0 }
            }),
        );
        let variance = slopes.dot(&(&self.covariance * &slopes));
        Estimate { value: of(&self.arm), std: variance.max(0.0).sqrt() }
    }
}

/// Where an output error begins and what it may know.
#[derive(Debug, Clone)]
pub struct OutputErrorStart {
    /// The arm to start from.
    pub arm: ModalArm,
    /// Frequency of each run that is a sinusoid in steady state \[rad/s\].
    pub omega_rad_s: Vec<Option<f64>>,
    /// Length of the first windows \[s\]; chosen from the arm when `None`. Short ones find the way from
    /// a start that is wrong by factors.
    pub first_window_s: Option<f64>,
}

/// Moves the figures of an arm until the replayed command shows the logged angles.
///
/// In stages: windows with an initial state each, short at first, so that sticking and slipping
/// follow the log; then ever longer ones, until they are whole runs or the residual grows because the
/// arm does not describe what happens. Parameters beyond the simplest law (lag, viscous friction by
/// direction, the other kind of damping) are added where the residual calls for them. At the end the
/// sensors' steps are counted as what they are.
///
/// `None` where no window can be cut or nothing is left of the search.
pub fn output_error(campaign: &Campaign, start: &OutputErrorStart) -> Option<OutputError> {
    let masks = data::masks(campaign);
    let blocks = data::blocks(campaign, &start.omega_rad_s);
    let fitting = Fitting { campaign, masks: &masks, blocks: &blocks };
    let mut report = Report::default();
    let (mut fit, mut free) = fitting.widen(start, &mut report)?;
    evidence::extend(&fitting, &mut fit, &mut free, &mut report);
    prune::modes(&fitting, &mut fit, &mut free, &mut report);
    report.extensions.extend(evidence::refused(&fitting, &fit, &free));
    fitting.count_steps(&mut fit, &free, &mut report);
    let noise: Vec<SensorNoise> =
        fit.noise.iter().map(|n| SensorNoise::gaussian(n.deviation())).collect();
    let problem = fitting.problem(&free, &noise, false);
    let point = problem.at(fit.point.arm, fit.point.windows);
    let found = Covariances::at(&point, free.len());
    Some(OutputError {
        arm: point.arm,
        covariance: found.larger(),
        white: found.white,
        blocks: found.blocks,
        windows: point.windows,
        parameters: free,
        beyond_noise: beyond_noise(campaign, &report),
        stages: report.stages,
        extensions: report.extensions,
        whole_runs: fit.whole_runs,
    })
}

/// Largest ratio of a channel's residual to the noise that its samples show by themselves.
fn beyond_noise(campaign: &Campaign, report: &Report) -> f64 {
    let noise = noise::of_samples(campaign);
    let residual = report.stages.last().map_or(&[][..], |s| &s.residual);
    residual.iter().zip(&noise).map(|(r, n)| r / n.sigma).fold(0.0, f64::max)
}

/// A campaign as the fits see it.
struct Fitting<'a> {
    campaign: &'a Campaign,
    masks: &'a [Masks],
    blocks: &'a [crate::replay::Blocks],
}

/// Where a fit is.
#[derive(Clone)]
struct Fit {
    point: Point,
    noise: Vec<SensorNoise>,
    whole_runs: bool,
    window_s: f64,
}

/// What was done.
#[derive(Default)]
struct Report {
    stages: Vec<StageReport>,
    extensions: Vec<Extension>,
}

impl Report {
    /// Whether a residual is larger than that of the first windows by what no sensor adds.
    fn grown(&self, residual: &[f64]) -> bool {
        let first = self.stages.first().map_or(residual, |s| &s.residual);
        first.iter().zip(residual).any(|(a, b)| *b > GROWN * a)
    }
}

impl Fitting<'_> {
    fn problem<'b>(
        &'b self,
        free: &'b [Parameter],
        noise: &'b [SensorNoise],
        robust: bool,
    ) -> Problem<'b> {
        let sampling = Sampling { noise, blocks: self.blocks, masks: self.masks };
        Problem { campaign: self.campaign, parameters: free, sampling, robust }
    }

    /// From short windows to whole runs, as far as the arm describes them; parameters are added where
    /// it does not.
    fn widen(
        &self,
        start: &OutputErrorStart,
        report: &mut Report,
    ) -> Option<(Fit, Vec<Parameter>)> {
        let longest = self.campaign.runs.iter().map(duration_s).fold(0.0, f64::max);
        let mut free = free_parameters(self.campaign, &start.arm);
        let window_s =
            start.first_window_s.unwrap_or_else(|| self.first_window_s(&start.arm)).min(longest);
        let windows = some(cut(self.campaign, &start.arm, window_s));
        if windows.is_empty() {
            return None;
        }
        let noise = noise::of_samples(self.campaign);
        let problem = self.problem(&free, &noise, true);
        if !problem.can_be_seen(&start.arm) {
            return None;
        }
        let point = problem.at(start.arm.clone(), windows);
        let mut fit = Fit { point, noise, whole_runs: window_s >= longest, window_s };
        self.search(&mut fit, &free, report);
        evidence::extend(self, &mut fit, &mut free, report);
        while !fit.whole_runs {
            let window_s = (fit.window_s * WIDENING).min(longest);
            let whole_runs = window_s >= longest;
            let before = (fit.clone(), free.clone());
            let windows = widen(self.campaign, &fit.point.arm, &fit.point.windows, window_s);
            let windows = if whole_runs { windows } else { some(windows) };
            let problem = self.problem(&free, &fit.noise, !whole_runs);
            let point = problem.at(fit.point.arm, windows);
            fit = Fit { point, noise: before.0.noise.clone(), whole_runs, window_s };
            let mut residual = self.search(&mut fit, &free, report);
            if report.grown(&residual) && evidence::extend(self, &mut fit, &mut free, report) {
                residual = residual_deviation(&fit.point, free.len());
            }
            if report.grown(&residual) {
                return Some(before);
            }
        }
        Some((fit, free))
    }

    /// Searches from where the fit is and takes its noise from what is left; gives that.
    fn search(&self, fit: &mut Fit, free: &[Parameter], report: &mut Report) -> Vec<f64> {
        let residual = self.steps(fit, free, report, STEPS_ON_THE_WAY);
        let last = report.stages.last().map(|s| s.stop);
        let residual =
            if last == Some(Stop::StepsUsedUp) && (fit.whole_runs || report.grown(&residual)) {
                self.steps(fit, free, report, MOST_STEPS)
            } else {
                residual
            };
        fit.noise = residual.iter().map(|r| SensorNoise::gaussian(*r)).collect();
        residual
    }

    /// At most `most` steps; gives the residual's deviation.
    fn steps(
        &self,
        fit: &mut Fit,
        free: &[Parameter],
        report: &mut Report,
        most: usize,
    ) -> Vec<f64> {
        let problem = self.problem(free, &fit.noise, !fit.whole_runs);
        let point = problem.at(fit.point.arm.clone(), fit.point.windows.clone());
        let (point, iterations, stop) = problem.search(point, most);
        let residual = residual_deviation(&point, free.len());
        report.stages.push(StageReport {
            window_s: fit.window_s,
            windows: point.windows.len(),
            iterations,
            stop,
            noise: fit.noise.clone(),
            residual: residual.clone(),
        });
        fit.point = point;
        residual
    }

    fn first_window_s(&self, arm: &ModalArm) -> f64 {
        let sample_s =
            self.campaign.runs.iter().map(Run::sample_time_s).fold(f64::INFINITY, f64::min);
        let slowest = arm.modes.iter().map(|m| m.omega_rad_s).fold(f64::INFINITY, f64::min);
        let period_s = std::f64::consts::TAU / slowest;
        (FIRST_SAMPLES * sample_s).max(FIRST_PERIODS * period_s)
    }

    /// The sensors' steps as what they are. They count once the fit is near: within one there is
    /// nothing that would lead there.
    fn count_steps(&self, fit: &mut Fit, free: &[Parameter], report: &mut Report) {
        let steps = noise::steps(self.campaign);
        let left = noise::residuals(self.campaign, &fit.point, self.masks);
        let noise: Vec<SensorNoise> =
            left.iter().zip(&steps).map(|(e, q)| noise::most_likely(e, *q)).collect();
        fit.noise.clone_from(&noise);
        self.steps(fit, free, report, STEPS_ON_THE_WAY);
        fit.noise = noise;
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
    let own = |s: &crate::replay::WindowSums| s.gram.ncols() - 1 - shared;
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
