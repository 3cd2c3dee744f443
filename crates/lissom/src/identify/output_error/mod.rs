//! Output error: the logged command replayed through an arm whose figures are moved until it shows
//! the logged angles.

mod covariance;
mod normal;
mod search;
mod start;
mod windows;

use nalgebra::DMatrix;

use super::Estimate;
use crate::record::Campaign;
use crate::replay::{ModalArm, Parameter, Sampling, WindowSums};
use covariance::covariances;
use search::{Point, Problem};
pub use search::{Iteration, Stop};
pub use start::{BeamDamping, free_parameters, start_of_regressions};
use windows::{cut, widen};

/// Most steps of a stage.
const MOST_STEPS: usize = 30;
/// Each stage's windows are longer than the ones before by this factor.
const WIDENING: f64 = 3.0;

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
    /// Deviation of each channel's residual afterwards, motor first, then tips.
    pub sigma: Vec<f64>,
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
    /// Every length of windows, in order.
    pub stages: Vec<StageReport>,
}

impl OutputError {
    /// A parameter with its deviation.
    pub fn estimate(&self, parameter: Parameter) -> Option<Estimate> {
        let i = self.parameters.iter().position(|p| *p == parameter)?;
        let std = self.covariance[(i, i)].max(0.0).sqrt();
        Some(Estimate { value: parameter.of(&self.arm), std })
    }
}

/// Moves the `free` figures of `start` until the replayed command shows the logged angles.
pub fn output_error(
    campaign: &Campaign,
    start: &ModalArm,
    free: &[Parameter],
    first_window_s: f64,
    sigma: &[f64],
) -> Option<OutputError> {
    let longest = campaign
        .runs
        .iter()
        .map(|r| r.len() as f64 * r.sample_time_s())
        .fold(0.0, f64::max);
    let mut sigma = sigma.to_vec();
    let mut length_s = first_window_s.min(longest);
    let mut windows = cut(campaign, start, length_s);
    let mut arm = start.clone();
    let mut stages = Vec::new();
    loop {
        if windows.is_empty() {
            return None;
        }
        let problem = Problem {
            campaign,
            parameters: free,
            sampling: Sampling { sigma: &sigma, block: 50 },
            robust: length_s < longest,
        };
        let (point, iterations, stop) =
            problem.search(problem.at(arm, windows), MOST_STEPS);
        sigma = residual_deviation(&point, free.len());
        if std::env::var("OE_DEBUG").is_ok() {
            let mut c: Vec<_> = point.sums.iter().zip(&point.windows).map(|(s, w)| (s.cost() / s.samples as f64, w)).collect();
            c.sort_by(|a, b| b.0.total_cmp(&a.0));
            for (c, w) in c.iter().take(12) {
                #[expect(clippy::print_stderr)]
                { eprintln!("{c:.3} run {} {:?} {:?} {:?}", w.run, w.samples, w.start, w.zeros); }
            }
            #[expect(clippy::print_stderr)]
            { eprintln!("median {}", c[c.len() / 2].0); }
        }
        stages.push(StageReport {
            window_s: length_s,
            windows: point.windows.len(),
            iterations,
            stop,
            sigma: sigma.clone(),
        });
        if length_s >= longest {
            let found = covariances(&point, free.len(), 2);
            return Some(OutputError {
                arm: point.arm,
                parameters: free.to_vec(),
                covariance: found.coloured,
                white: found.white,
                stages,
            });
        }
        length_s = (length_s * WIDENING).min(longest);
        windows = widen(campaign, &point.arm, &point.windows, length_s);
        arm = point.arm;
    }
}

/// Deviation of each channel's residual, its share of the unknowns taken out.
fn residual_deviation(point: &Point, shared: usize) -> Vec<f64> {
    let channels = point.sums.first().map_or(0, |s| s.squares.len());
    let samples: usize = point.sums.iter().map(|s| s.samples).sum();
    let unknowns: usize =
        point.sums.iter().map(|s| s.gram.ncols() - 1 - shared).sum::<usize>() + shared;
    let free = (samples * channels).saturating_sub(unknowns).max(1) as f64 / channels as f64;
    let square = |c: usize| point.sums.iter().map(|s: &WindowSums| s.squares[c]).sum::<f64>();
    (0..channels).map(|c| (square(c) / free).sqrt().max(f64::MIN_POSITIVE)).collect()
}
