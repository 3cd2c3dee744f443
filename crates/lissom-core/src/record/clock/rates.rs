//! Logs whose sample time changes part-way.

use super::thresholds::{MOST_RATES, RATE_CHANGES, RATE_STRETCH};
use super::time_grid::median;

/// Steps over which a mean step is taken.
const BLOCK: usize = 50;
/// A step counts as at most this many median steps of its block, so that gaps do not look like another rate.
const LONGEST_STEP: f64 = 3.0;
/// Two blocks have one rate if their mean steps differ by no more than this factor.
const SAME_RATE: f64 = 1.15;

/// The first samples of the stretches after the first one. Empty where there is one sample time, and where it changes
/// too often to cut the log.
pub(super) fn changes(stamps_s: &[f64]) -> Vec<usize> {
    let steps: Vec<f64> = stamps_s.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let blocks: Vec<f64> = steps.chunks_exact(BLOCK).map(mean_step).collect();
    let differ = |a: f64, b: f64, factor: f64| (a / b).ln().abs() > factor.ln();
    let mut found = Vec::new();
    let Some(&first) = blocks.first() else { return found };
    let (mut level, mut counted) = (first, 1.0);
    for b in 1..blocks.len().saturating_sub(1) {
        let (here, next) = (blocks[b], blocks[b + 1]);
        let jumps = differ(here, level, RATE_CHANGES) && differ(next, level, RATE_CHANGES);
        if jumps && !differ(here, next, SAME_RATE) {
            let near = (b - 1) * BLOCK..((b + 1) * BLOCK).min(steps.len());
            found.push(change_in(&steps[near.clone()], level, next) + near.start + 1);
            (level, counted) = (next, 1.0);
        } else if !differ(here, level, RATE_CHANGES) {
            counted += 1.0;
            level += (here - level) / counted;
        }
        if found.len() >= MOST_RATES {
            return Vec::new();
        }
    }
    let ends = found.iter().copied().chain([stamps_s.len()]);
    let starts = [0].into_iter().chain(found.iter().copied());
    if starts.zip(ends).any(|(start, end)| end < start + RATE_STRETCH) {
        return Vec::new();
    }
    found
}

fn mean_step(block: &[f64]) -> f64 {
    let longest = LONGEST_STEP * median(block.to_vec()).unwrap_or(0.0);
    block.iter().map(|step| step.min(longest)).sum::<f64>() / block.len() as f64
}

/// The number of steps before the change.
fn change_in(steps: &[f64], before: f64, after: f64) -> usize {
    let mut cost = 0.0;
    let mut best = (0.0, 0);
    for (index, step) in steps.iter().enumerate() {
        cost += (step - before).abs() - (step - after).abs();
        if cost < best.0 {
            best = (cost, index + 1);
        }
    }
    best.1
}
