//! The sample time behind the stamps, and the gaps between them.

use super::thresholds::GAP_STEPS;
use crate::record::TimeBase;

/// Stamps rounded more finely than this part of a step need no thought about rounding.
const FINE: f64 = 0.02;
/// Stamps rounded more finely than this part of a step still tell a rounded step from a lost row.
const CLEAR: f64 = 0.4;
/// Longest step in sample times whose lost rows can be counted.
const FEW_LOST: f64 = 10.0;
/// Share of equal steps that shows rounded stamps to be exact.
const MOST_STEPS: f64 = 0.9;

/// The regular grid about which stamps lie.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TimeGrid {
    /// The sample time \[s\].
    pub(super) sample_time_s: f64,
    /// A longer step is a gap \[s\].
    pub(super) gap_s: f64,
}

impl TimeGrid {
    /// The grid of at least two increasing stamps, of which `stamp_step_s` is the last digit's
    /// step (0 where it is unknown).
    ///
    /// The sample time is the median step. Where rounding of the stamps shows in single steps
    /// (3 ms and 4 ms for a sample time of 3.33 ms) it is the mean of the steps without gaps.
    /// `None` with fewer than two stamps.
    pub(super) fn of(stamps_s: &[f64], stamp_step_s: f64) -> Option<Self> {
        let mut steps: Vec<f64> = stamps_s.windows(2).map(|pair| pair[1] - pair[0]).collect();
        if steps.is_empty() {
            return None;
        }
        let middle = steps.len() / 2;
        let (_, &mut median, _) = steps.select_nth_unstable_by(middle, f64::total_cmp);
        let rounding = stamp_step_s / median;
        let mean_below = |limit: f64| {
            let (sum, count) = steps
                .iter()
                .filter(|&&step| step < limit)
                .fold((0.0, 0_usize), |(sum, count), step| (sum + step, count + 1));
            if count == 0 { median } else { sum / count as f64 }
        };
        let equal = steps.iter().filter(|&&step| (step - median).abs() < 0.01 * median).count();
        let (sample_time_s, slack) = if rounding < FINE {
            (median, 0.0)
        } else if rounding <= CLEAR {
            // A lost row makes a step of two sample times: counted so, none is left out.
            let first = mean_below(GAP_STEPS * median);
            let (sum, count) = steps
                .iter()
                .filter(|&&step| step < FEW_LOST * first)
                .fold((0.0, 0.0), |(sum, count), step| {
                    (sum + step, count + (step / first).round())
                });
            (if count > 0.0 { sum / count } else { first }, 0.0)
        } else if equal as f64 >= MOST_STEPS * steps.len() as f64 {
            (median, 0.0)
        } else {
            (mean_below(GAP_STEPS * median + stamp_step_s), stamp_step_s)
        };
        let largest = stamps_s.iter().fold(0.0_f64, |largest, stamp| largest.max(stamp.abs()));
        let sample_time_s = rounded(sample_time_s, largest);
        Some(Self { sample_time_s, gap_s: GAP_STEPS * sample_time_s + slack })
    }

    /// The time base of stamps without gaps.
    pub(super) fn base(&self, stamps_s: &[f64]) -> TimeBase {
        let (mut largest, mut squares) = (0.0_f64, 0.0);
        for pair in stamps_s.windows(2) {
            let jitter = (pair[1] - pair[0] - self.sample_time_s).abs();
            largest = largest.max(jitter);
            squares += jitter * jitter;
        }
        let steps = stamps_s.len().saturating_sub(1).max(1) as f64;
        TimeBase {
            start_s: stamps_s.first().copied().unwrap_or(0.0),
            sample_time_s: self.sample_time_s,
            jitter_max_s: largest,
            jitter_rms_s: (squares / steps).sqrt(),
        }
    }
}

/// A sample time to the digits that the difference of two stamps can carry, eleven at most.
fn rounded(sample_time_s: f64, largest_stamp_s: f64) -> f64 {
    let noise = 4.0 * f64::EPSILON * largest_stamp_s / sample_time_s;
    let digits = (1_u8..11).rev().find(|&digits| noise * 10_f64.powi(digits.into()) < 1.0);
    let digits = usize::from(digits.unwrap_or(10));
    format!("{sample_time_s:.digits$e}").parse().unwrap_or(sample_time_s)
}

/// The middle one of the numbers, the upper of two.
pub(super) fn median(mut numbers: Vec<f64>) -> Option<f64> {
    let middle = numbers.len() / 2;
    if numbers.is_empty() {
        return None;
    }
    Some(*numbers.select_nth_unstable_by(middle, f64::total_cmp).1)
}

#[cfg(test)]
mod tests {
    #![expect(clippy::float_cmp, reason = "these numbers are exact")]

    use super::*;

    #[test]
    fn the_sample_time_survives_rounded_stamps_and_lost_rows() {
        let stamps = |step: f64, unit: f64, lost: usize| -> Vec<f64> {
            (0..1000)
                .filter(|k| lost == 0 || k % lost != lost / 2)
                .map(|k| (f64::from(u32::try_from(k).unwrap()) * step / unit).round() * unit)
                .collect()
        };
        for (step, unit, lost) in [
            (0.002, 0.001, 0),
            (0.002, 0.001, 40),
            (0.001, 0.001, 40),
            (0.01 / 3.0, 0.001, 0),
            (0.01 / 3.0, 0.001, 90),
            (0.0012, 0.001, 0),
            (0.002_000_4, 0.0001, 50),
        ] {
            let stamps = stamps(step, unit, lost);
            let grid = TimeGrid::of(&stamps, unit).unwrap();
            assert!(
                (grid.sample_time_s / step - 1.0).abs() < 1e-3,
                "{step} {unit} {lost}: {grid:?}"
            );
            let gaps = stamps.windows(2).any(|pair| pair[1] - pair[0] > grid.gap_s);
            assert_eq!(gaps, lost > 0, "{step} {unit} {lost}: {grid:?}");
        }
    }

    #[test]
    fn late_stamps_do_not_blur_the_sample_time() {
        let stamps: Vec<f64> = (8_257_265..8_258_265).map(|k| f64::from(k) * 0.001).collect();
        assert_eq!(TimeGrid::of(&stamps, 1e-6).unwrap().sample_time_s, 0.001);
    }

    #[test]
    fn jitter_is_measured_about_the_sample_time() {
        let stamps = [0.0, 1.0, 2.0, 3.25, 4.0, 5.0];
        let grid = TimeGrid::of(&stamps, 0.0).unwrap();
        assert_eq!(grid.sample_time_s, 1.0);
        let base = grid.base(&stamps);
        assert_eq!(base.jitter_max_s, 0.25);
        assert_eq!(base.jitter_rms_s, (0.125_f64 / 5.0).sqrt());
    }
}
