//! Output error: the logged command replayed through an arm whose figures are moved until it shows
//! the logged angles.

mod covariance;
mod noise;
mod normal;
mod search;
mod start;
mod windows;

use nalgebra::DMatrix;

use super::Estimate;
use crate::record::{Campaign, Run};
use crate::replay::{Blocks, ModalArm, Parameter, Sampling, SensorNoise, WindowSums};
use covariance::Covariances;
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
    /// Noise that each channel was taken to have, motor first, then tips.
    pub noise: Vec<SensorNoise>,
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
    /// By blocks.
    pub blocks: DMatrix<f64>,
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
    blocks: &[Blocks],
) -> Option<OutputError> {
    let length = |r: &Run| r.len() as f64 * r.sample_time_s();
    let longest = campaign.runs.iter().map(length).fold(0.0, f64::max);
    let mut noise = noise::of_samples(campaign);
    let mut length_s = first_window_s.min(longest);
    let mut arm = start.clone();
    let mut windows = cut(campaign, &arm, length_s);
    let mut stages = Vec::new();
    let steps = noise::steps(campaign);
    let mut polished = 0;
    loop {
        if windows.is_empty() {
            return None;
        }
        let last = length_s >= longest;
        let sampling = Sampling { noise: &noise, blocks };
        let problem = Problem { campaign, parameters: free, sampling, robust: !last };
        let (point, iterations, stop) = problem.search(problem.at(arm, windows), MOST_STEPS);
        arm = point.arm.clone();
        stages.push(StageReport {
            window_s: length_s,
            windows: point.windows.len(),
            iterations,
            stop,
            noise: noise.clone(),
        });
        if last && polished == 2 {
            let noise: Vec<SensorNoise> =
                noise.iter().map(|n| SensorNoise::gaussian(n.deviation())).collect();
            let gaussian = Problem { sampling: Sampling { noise: &noise, blocks }, ..problem };
            let found = Covariances::at(&gaussian.at(point.arm, point.windows), free.len());
            return Some(OutputError {
                arm,
                parameters: free.to_vec(),
                covariance: found.larger(),
                white: found.white,
                blocks: found.blocks,
                stages,
            });
        }
        if last {
            // Steps count once the fit is near: within one there is nothing that would lead there.
            let left = noise::residuals(campaign, &point);
            noise = left.iter().zip(&steps).map(|(e, q)| noise::most_likely(e, *q)).collect();
            polished += 1;
            windows = point.windows;
        } else {
            noise = residual_deviation(&point, free.len());
            length_s = (length_s * WIDENING).min(longest);
            windows = widen(campaign, &arm, &point.windows, length_s);
        }
    }
}

/// Deviation of each channel's residual, its share of the unknowns taken out.
fn residual_deviation(point: &Point, shared: usize) -> Vec<SensorNoise> {
    let channels = point.sums.first().map_or(0, |s| s.squares.len());
    let samples: usize = point.sums.iter().map(|s| s.samples).sum();
    let unknowns: usize =
        point.sums.iter().map(|s| s.gram.ncols() - 1 - shared).sum::<usize>() + shared;
    let free = (samples * channels).saturating_sub(unknowns).max(1) as f64 / channels as f64;
    let square = |c: usize| point.sums.iter().map(|s: &WindowSums| s.squares[c]).sum::<f64>();
    let deviation = |c: usize| (square(c) / free).sqrt().max(f64::MIN_POSITIVE);
    (0..channels).map(|c| SensorNoise::gaussian(deviation(c))).collect()
}
