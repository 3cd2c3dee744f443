//! Decides from the angle whether samples were taken at their time stamps or evenly.

use super::lagrange::left_out;
use super::thresholds::CLOCK_AGREES;

/// Fewest samples that decide.
const LEAST: usize = 50;
/// Times of neighbours that differ by less than this share of a step between the two clocks decide nothing.
const DIFFERENT: f64 = 0.02;
/// Largest sum of squared weights of a prediction: with more, stamps that nearly coincide make it of noise.
const LARGEST_WEIGHTS: f64 = 20.0;
/// A sample counts if the motor moves at this share of its rms speed or faster.
const MOVING: f64 = 0.5;

/// Which clock the motion agrees with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Believed {
    Stamps,
    Count,
    /// The noise of the angle hides the difference.
    Either,
}

/// Mean square errors of angles that their neighbours predict, with either clock.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Agreement {
    stamps: f64,
    count: f64,
    samples: usize,
}

impl Agreement {
    /// Adds the samples of a piece: its stamps, and the times that the sample count gives.
    pub(super) fn add(&mut self, angle: &[f64], stamps: &[f64], even: &[f64]) {
        let n = angle.len();
        if n < 5 {
            return;
        }
        let travel = |k: usize| angle[k + 1] - angle[k - 1];
        let squares: f64 = (1..n - 1).map(|k| travel(k) * travel(k)).sum();
        let least = MOVING * (squares / (n - 2) as f64).sqrt();
        for k in 2..n - 2 {
            let step = 0.25 * (even[k + 2] - even[k - 2]);
            let shift = |i: usize| (stamps[i] - stamps[k]) - (even[i] - even[k]);
            let differ =
                [k - 2, k - 1, k + 1, k + 2].into_iter().any(|i| shift(i).abs() > DIFFERENT * step);
            if !differ || travel(k).abs() < least {
                continue;
            }
            let nodes = [-2, -1, 1, 2];
            let both = left_out(stamps, angle, k, nodes).zip(left_out(even, angle, k, nodes));
            let Some(((by_stamps, s), (by_count, c))) = both else { continue };
            if s < LARGEST_WEIGHTS {
                self.stamps += by_stamps * by_stamps / (1.0 + s);
                self.count += by_count * by_count / (1.0 + c);
                self.samples += 1;
            }
        }
    }

    pub(super) fn believed(&self) -> Believed {
        if self.samples < LEAST {
            Believed::Either
        } else if self.stamps < CLOCK_AGREES * self.count {
            Believed::Stamps
        } else if self.count < CLOCK_AGREES * self.stamps {
            Believed::Count
        } else {
            Believed::Either
        }
    }

    /// The rms error with the clock that is not believed over the error with the one that is.
    pub(super) fn ratio(&self) -> f64 {
        let (less, more) = (self.stamps.min(self.count), self.stamps.max(self.count));
        (more / less.max(f64::MIN_POSITIVE)).sqrt()
    }
}
