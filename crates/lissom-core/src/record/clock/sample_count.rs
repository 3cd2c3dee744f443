//! The times of samples that were taken evenly and stamped unevenly.

use super::thresholds::{GAP_STEPS, MOST_LOST_ROWS};
use super::time_grid::median;

/// Samples on each side of a long step whose stamps show whether time was lost.
const SIDE: usize = 25;
/// A long step is of lost rows if the stamps after it are later by this part of it for good.
const FOR_GOOD: f64 = 0.5;
/// Fewest sample times that are lost.
const LEAST_LOST: f64 = 0.75;
/// Standard errors of what is lost by which it must be above zero.
const CLEARLY: f64 = 6.0;
/// Lost rows are believed if they bring the stamps' distance from the grid to this share.
const EXPLAINS: f64 = 0.7;
/// Samples over which the stamps are averaged where they drift.
const BLOCK: usize = 50;
/// Drift in sample times, and in standard errors of such an average, from which it is one.
const DRIFT_STEPS: f64 = 0.25;
const DRIFT_ERRORS: f64 = 4.0;

/// Even times of the rows of a piece.
#[derive(Debug, Clone)]
pub(super) struct SampleCount {
    /// The sample time \[s\].
    pub(super) step_s: f64,
    /// Time of each row from the first one, in sample times: whole numbers unless the clock drifts.
    pub(super) positions: Vec<f64>,
    /// Time of the first sample \[s\].
    pub(super) start_s: f64,
    /// Distance of the stamps' steps from those of the positions, rms and largest \[s\].
    pub(super) jitter_s: (f64, f64),
    /// The stamps drift against the count.
    pub(super) drifts: bool,
}

/// Rows that begin a piece, since the step before them is more than a few lost rows. A row that was stamped late,
/// after which the stamps return to their grid, is none.
pub(super) fn long_gaps(stamps_s: &[f64], late_rows: bool) -> Vec<usize> {
    let Some(step_s) = typical_step(stamps_s) else { return Vec::new() };
    let longest = (MOST_LOST_ROWS as f64 + 1.5) * step_s;
    let steps = (1..stamps_s.len()).filter(|&k| stamps_s[k] - stamps_s[k - 1] > longest);
    let lost =
        |k: usize| lost_time(stamps_s, k, step_s) >= FOR_GOOD * (stamps_s[k] - stamps_s[k - 1]);
    steps.filter(|&k| !late_rows || lost(k)).collect()
}

/// The mean step without gaps.
fn typical_step(stamps_s: &[f64]) -> Option<f64> {
    let steps = || stamps_s.windows(2).map(|pair| pair[1] - pair[0]);
    let longest = (MOST_LOST_ROWS as f64 + 1.5) * median(steps().collect())?;
    let (sum, count) = steps()
        .filter(|step| *step <= longest)
        .fold((0.0, 0_usize), |(sum, n), step| (sum + step, n + 1));
    Some(sum / count.max(1) as f64)
}

/// How much later the stamps from `k` on are than those before, against the count.
fn lost_time(stamps_s: &[f64], k: usize, step_s: f64) -> f64 {
    let middle = |from: usize, to: usize| {
        median((from..to).map(|i| stamps_s[i] - i as f64 * step_s).collect()).unwrap_or(0.0)
    };
    middle(k, (k + SIDE).min(stamps_s.len())) - middle(k.saturating_sub(SIDE), k)
}

impl SampleCount {
    /// Of a piece of two or more rows without long gaps.
    pub(super) fn of(stamps_s: &[f64]) -> Self {
        let n = stamps_s.len();
        let mut step_s = typical_step(stamps_s).unwrap_or(1.0);
        let counted: Vec<f64> = (0..n).map(|k| k as f64).collect();
        let plain = Line::through(&counted, stamps_s);
        let lost = with_lost_rows(stamps_s, step_s);
        let (mut positions, mut line) = (counted, plain);
        if let Some(lost) = lost {
            let fitted = Line::through(&lost, stamps_s);
            if fitted.rms < EXPLAINS * line.rms {
                (positions, line) = (lost, fitted);
            }
        }
        step_s = if line.slope > 0.0 { line.slope } else { step_s };
        let drifts = drift(&mut positions, stamps_s, line, step_s);
        let jitter_s = jitter(&positions, stamps_s, step_s);
        Self { step_s, positions, start_s: line.start, jitter_s, drifts }
    }
}

/// Positions in samples where rows are lost.
fn with_lost_rows(stamps_s: &[f64], step_s: f64) -> Option<Vec<f64>> {
    let n = stamps_s.len();
    let deviation = |k: usize| stamps_s[k] - stamps_s[k - 1] - step_s;
    let squares: f64 = (1..n).map(|k| deviation(k).powi(2)).sum();
    let noise_s = (squares / (2 * (n - 1)) as f64).sqrt();
    let error_s = 1.25 * noise_s * (2.0 / SIDE as f64).sqrt();
    let mut lost = 0.0;
    let positions: Vec<f64> = (0..n)
        .map(|k| {
            if k > 0 && deviation(k) > (GAP_STEPS - 1.0) * step_s {
                let time = lost_time(stamps_s, k, step_s);
                if time > LEAST_LOST * step_s && time > CLEARLY * error_s {
                    lost += (time / step_s).round();
                }
            }
            k as f64 + lost
        })
        .collect();
    (lost > 0.0).then_some(positions)
}

/// A straight line through stamps over positions.
#[derive(Debug, Clone, Copy)]
struct Line {
    start: f64,
    slope: f64,
    rms: f64,
}

impl Line {
    fn through(positions: &[f64], stamps_s: &[f64]) -> Self {
        let n = stamps_s.len().max(1) as f64;
        let x_mean = positions.iter().sum::<f64>() / n;
        // The first stamp may be a date: differences keep its digits.
        let first = stamps_s.first().copied().unwrap_or(0.0);
        let y_mean = stamps_s.iter().map(|t| t - first).sum::<f64>() / n;
        let (mut xx, mut xy) = (0.0, 0.0);
        for (x, t) in positions.iter().zip(stamps_s) {
            xx += (x - x_mean).powi(2);
            xy += (x - x_mean) * (t - first - y_mean);
        }
        let slope = xy / xx.max(f64::MIN_POSITIVE);
        let start = first + y_mean - slope * x_mean;
        let squares: f64 =
            positions.iter().zip(stamps_s).map(|(x, t)| (t - start - slope * x).powi(2)).sum();
        Self { start, slope, rms: (squares / n).sqrt() }
    }
}

/// Moves the positions with the average stamps where these drift by more than their noise explains.
fn drift(positions: &mut [f64], stamps_s: &[f64], line: Line, step_s: f64) -> bool {
    let n = stamps_s.len();
    if n < 4 * BLOCK {
        return false;
    }
    let off: Vec<f64> =
        positions.iter().zip(stamps_s).map(|(x, t)| (t - line.start) / step_s - x).collect();
    let blocks: Vec<f64> =
        off.chunks_exact(BLOCK).map(|block| block.iter().sum::<f64>() / BLOCK as f64).collect();
    let rms = (blocks.iter().map(|b| b * b).sum::<f64>() / blocks.len() as f64).sqrt();
    let within = off.chunks_exact(BLOCK).zip(&blocks);
    let squares: f64 =
        within.map(|(block, mean)| block.iter().map(|x| (x - mean).powi(2)).sum::<f64>()).sum();
    let noise = (squares / (blocks.len() * BLOCK) as f64).sqrt();
    if rms < DRIFT_STEPS || rms < DRIFT_ERRORS * noise / (BLOCK as f64).sqrt() {
        return false;
    }
    let half = BLOCK as f64 / 2.0 - 0.5;
    for (k, position) in positions.iter_mut().enumerate() {
        let at = ((k as f64 - half) / BLOCK as f64).clamp(0.0, (blocks.len() - 1) as f64);
        let b = (at as usize).min(blocks.len().saturating_sub(2));
        *position += blocks[b] + (at - b as f64) * (blocks[b + 1] - blocks[b]);
    }
    let first = positions[0];
    for position in positions.iter_mut() {
        *position -= first;
    }
    positions.windows(2).all(|pair| pair[1] > pair[0])
}

fn jitter(positions: &[f64], stamps_s: &[f64], step_s: f64) -> (f64, f64) {
    let (mut squares, mut largest) = (0.0, 0.0_f64);
    for (p, t) in positions.windows(2).zip(stamps_s.windows(2)) {
        let off = (t[1] - t[0] - step_s * (p[1] - p[0])).abs();
        squares += off * off;
        largest = largest.max(off);
    }
    ((squares / positions.len().saturating_sub(1).max(1) as f64).sqrt(), largest)
}
