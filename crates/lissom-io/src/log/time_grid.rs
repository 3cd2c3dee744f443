//! The sample time behind the stamps, and the gaps between them.

use std::ops::Range;

use lissom::record::{Note, TimeBase};

/// A step longer than this many sample times is a gap.
const GAP_STEPS: f64 = 1.5;
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
pub struct TimeGrid {
    /// The sample time \[s\].
    pub sample_time_s: f64,
    /// A longer step is a gap \[s\].
    pub gap_s: f64,
}

impl TimeGrid {
    /// The grid of at least two increasing stamps, of which `stamp_step_s` is the last digit's
    /// step (0 where it is unknown).
    ///
    /// The sample time is the median step. Where rounding of the stamps shows in single steps
    /// (3 ms and 4 ms for a sample time of 3.33 ms) it is the mean of the steps without gaps.
    /// `None` with fewer than two stamps.
    pub fn of(stamps_s: &[f64], stamp_step_s: f64) -> Option<Self> {
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
    fn base(&self, stamps_s: &[f64]) -> TimeBase {
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

/// A log cut at its gaps.
#[derive(Debug, Clone, PartialEq)]
pub struct Pieces {
    /// Samples, time base and notes of each piece that is long enough.
    pub kept: Vec<(Range<usize>, TimeBase, Vec<Note>)>,
    /// Number of gaps.
    pub gaps: usize,
    /// Samples of the longest piece, kept or not.
    pub longest: usize,
}

/// Cuts stamps at their gaps and drops pieces of fewer than `least` samples, unless there is no
/// gap at all.
pub fn cut_at_gaps(stamps_s: &[f64], grid: TimeGrid, least: usize) -> Pieces {
    let gaps: Vec<usize> =
        (1..stamps_s.len()).filter(|&k| stamps_s[k] - stamps_s[k - 1] > grid.gap_s).collect();
    let starts = std::iter::once(0).chain(gaps.iter().copied());
    let ends = gaps.iter().copied().chain(std::iter::once(stamps_s.len()));
    let mut pieces = Pieces { kept: Vec::new(), gaps: gaps.len(), longest: 0 };
    let mut notes = Vec::new();
    for (start, end) in starts.zip(ends) {
        let samples = end - start;
        pieces.longest = pieces.longest.max(samples);
        if start > 0 {
            let (at_s, after_s) = (stamps_s[start - 1], stamps_s[start]);
            notes.push(Note::GapCut { at_s, length_s: after_s - at_s });
        }
        if samples < least && !gaps.is_empty() {
            notes.push(Note::PieceDropped { at_s: stamps_s[start], samples });
        } else {
            let base = grid.base(&stamps_s[start..end]);
            pieces.kept.push((start..end, base, std::mem::take(&mut notes)));
        }
    }
    if let Some((_, _, last)) = pieces.kept.last_mut() {
        last.append(&mut notes);
    }
    pieces
}
