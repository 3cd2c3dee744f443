//! The steady part of a run with sinusoidal motion.

use num_complex::Complex64;
use thiserror::Error;

use super::harmonic_fit::HarmonicFit;
use crate::record::Run;
use crate::spectrum::thresholds::{BLOCKS_LEAST, SETTLED_CHANGE, STEADY_SCATTER, STEADY_SHARE};

/// Fewest samples from which a block's phasor is taken.
const BLOCK_SAMPLES: f64 = 24.0;
/// Harmonics that are fitted to a block beside each other.
const BLOCK_HARMONICS: usize = 3;

/// Whole periods of a run in steady state.
#[derive(Debug, Clone, PartialEq)]
pub struct Steady {
    /// Index of the first sample that is kept.
    pub first: usize,
    /// Number of samples that are kept: whole periods, to the nearest sample.
    pub len: usize,
    /// Number of periods that are kept.
    pub periods: usize,
    /// Number of periods that are left out at the beginning.
    pub dropped: usize,
    /// Change of the motor's fundamental from the first to the second half of the kept part,
    /// relative to its amplitude \[1\].
    pub motor_change: f64,
    /// The same for the command and each tip; the largest of these \[1\].
    pub other_change: f64,
    /// Whether the run has settled; false if even its second half still changes.
    pub settled: bool,
}

/// Error of [`steady_state`].
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SteadyError {
    /// There are too few periods to compare.
    #[error("the run has {found} whole blocks of periods, but at least {least} are needed")]
    TooFewPeriods {
        /// Whole blocks found.
        found: usize,
        /// Blocks needed.
        least: usize,
    },
}

/// Finds the part of `run` in which its motion at `omega_rad_s` is steady, as whole periods.
///
/// The phasor of the fundamental of motor, command and each tip is computed for each period, or for blocks of a few
/// periods if a period has few samples. Blocks at the beginning are left out until all channels are within the scatter
/// of the second half of the run.
///
/// # Errors
/// [`SteadyError::TooFewPeriods`] if the run has fewer than three blocks.
pub fn steady_state(run: &Run, omega_rad_s: f64) -> Result<Steady, SteadyError> {
    let per_period = std::f64::consts::TAU / (omega_rad_s * run.sample_time_s());
    let periods_a_block = (BLOCK_SAMPLES / per_period).ceil().max(1.0);
    let block = per_period * periods_a_block;
    let blocks = (run.len() as f64 / block + 1e-9).floor() as usize;
    if blocks < BLOCKS_LEAST {
        return Err(SteadyError::TooFewPeriods { found: blocks, least: BLOCKS_LEAST });
    }
    // Blocks are aligned with the end: what is dropped is dropped from the beginning.
    let origin = run.len() as f64 - block * blocks as f64;
    let edge = |b: usize| ((origin + block * b as f64).round() as usize).min(run.len());
    let channels: Vec<&[f64]> = [run.motor(), run.command()]
        .into_iter()
        .chain(run.tips().iter().map(Vec::as_slice))
        .collect();
    // Blocks have one of two lengths.
    let phase_step = omega_rad_s * run.sample_time_s();
    let mut fits: Vec<(usize, Option<HarmonicFit>)> = Vec::new();
    for length in (0..blocks).map(|b| edge(b + 1) - edge(b)) {
        if fits.iter().all(|(known, _)| *known != length) {
            fits.push((length, HarmonicFit::new(length, phase_step, BLOCK_HARMONICS)));
        }
    }
    let fundamental = |x: &[f64], b: usize| {
        let (from, to) = (edge(b), edge(b + 1));
        let fit = fits.iter().find(|(length, _)| *length == to - from);
        let phase = -phase_step * from as f64;
        fit.and_then(|(_, fit)| fit.as_ref()).map_or(Complex64::ZERO, |fit| {
            let first = fit.solution(&x[from..to]);
            Complex64::new(first[2], -first[3]) * Complex64::from_polar(1.0, phase)
        })
    };
    let tracks: Vec<Vec<Complex64>> =
        channels.iter().map(|x| (0..blocks).map(|b| fundamental(x, b)).collect()).collect();
    let half = blocks / 2;
    let beyond = tracks.iter().map(|t| first_settled(t, half)).max().unwrap_or(0);
    let settled_by_half = beyond <= half;
    let first_block = beyond.min(half);
    let changes: Vec<f64> = tracks.iter().map(|t| change(&t[first_block..])).collect();
    let first = edge(first_block);
    let per_block = periods_a_block as usize;
    Ok(Steady {
        first,
        len: run.len() - first,
        periods: (blocks - first_block) * per_block,
        dropped: first_block * per_block,
        motor_change: changes[0],
        other_change: changes[1..].iter().copied().fold(0.0, f64::max),
        settled: settled_by_half && changes.iter().all(|c| *c < SETTLED_CHANGE),
    })
}

/// First block from which on every block is near the mean of the later half.
fn first_settled(track: &[Complex64], half: usize) -> usize {
    let later = &track[half..];
    let mean = later.iter().sum::<Complex64>() / later.len() as f64;
    let scatter =
        (later.iter().map(|z| (z - mean).norm_sqr()).sum::<f64>() / later.len() as f64).sqrt();
    let allowed = (STEADY_SCATTER * scatter).max(STEADY_SHARE * mean.norm());
    track.iter().rposition(|z| (z - mean).norm() > allowed).map_or(0, |last| last + 1)
}

/// Change of the mean phasor from the first to the second half, in units of its amplitude.
fn change(track: &[Complex64]) -> f64 {
    let half = track.len() / 2;
    let mean = |part: &[Complex64]| part.iter().sum::<Complex64>() / part.len().max(1) as f64;
    let (early, late) = (mean(&track[..half]), mean(&track[half..]));
    (early - late).norm() / late.norm().max(f64::MIN_POSITIVE)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::TimeBase;

    fn run(decay_s: f64, seconds: f64) -> Run {
        let t = 0.01;
        let x: Vec<f64> = (0..(seconds / t) as usize)
            .map(|k| {
                let s = k as f64 * t;
                (2.0 * s).sin() + 0.5 * (-s / decay_s).exp() * (2.0 * s).cos()
            })
            .collect();
        Run::new("x", TimeBase::uniform(0.0, t), x.clone(), x, vec![]).unwrap()
    }

    #[test]
    fn a_transient_is_dropped() {
        let steady = steady_state(&run(3.0, 60.0), 2.0).unwrap();
        assert!(steady.settled);
        assert!((3..=7).contains(&steady.dropped), "{steady:?}");
    }

    #[test]
    fn a_slow_transient_is_called_not_settled() {
        assert!(!steady_state(&run(60.0, 60.0), 2.0).unwrap().settled);
    }

    #[test]
    fn two_periods_are_too_few() {
        let error = steady_state(&run(1.0, 7.0), 2.0).unwrap_err();
        assert_eq!(error, SteadyError::TooFewPeriods { found: 2, least: 3 });
    }
}
