//! Clocks that start again within a log.

use super::time_grid::median;

/// Samples on each side of a restart that must follow each other in order.
const ORDERED: usize = 8;
/// Steps before and after a restart that show how much the angle accelerates.
const NEAR: usize = 25;
/// Smallest step back of a restart, and largest step forward near it, in typical steps.
const BACK: f64 = 3.0;
const FORWARD: f64 = 10.0;
/// The acceleration across the restart may be this many times the largest one near it.
const CONTINUOUS: f64 = 3.0;

/// What was found where time goes back.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Restarts {
    /// Restarts across which the motion goes on: one clock for both sides.
    pub(super) joined: usize,
    /// First samples after a restart across which the motion does not go on.
    pub(super) cuts: Vec<usize>,
    /// The stamp before the first restart.
    pub(super) at_s: f64,
}

/// Makes stamps increase between `cuts`.
///
/// Where the angle goes on across a restart as the sample count says, the later stamps are moved to one typical
/// step after the restart.
///
/// # Errors
/// The sample whose stamp does not increase and is not that of a restart: a small step back, or rows out of order.
pub(super) fn join(stamps_s: &mut [f64], motor: &[f64]) -> Result<Restarts, usize> {
    let back = |k: &usize| {
        stamps_s[*k].partial_cmp(&stamps_s[*k - 1]) != Some(std::cmp::Ordering::Greater)
    };
    let backs: Vec<usize> = (1..stamps_s.len()).filter(back).collect();
    let mut found = Restarts::default();
    let Some(&first) = backs.first() else { return Ok(found) };
    let typical = stamps_s.windows(2).map(|pair| pair[1] - pair[0]).filter(|step| *step > 0.0);
    let typical = median(typical.collect()).ok_or(first)?;
    if let Some(&k) = backs.iter().find(|&&k| !is_restart(stamps_s, k, typical)) {
        return Err(k);
    }
    found.at_s = stamps_s[first - 1];
    for (index, &k) in backs.iter().enumerate() {
        if !goes_on(motor, k) {
            found.cuts.push(k);
            continue;
        }
        found.joined += 1;
        let end = backs.get(index + 1).copied().unwrap_or(stamps_s.len());
        // The stamp before is moved already.
        let shift = stamps_s[k - 1] + typical - stamps_s[k];
        stamps_s[k..end].iter_mut().for_each(|stamp| *stamp += shift);
    }
    Ok(found)
}

fn is_restart(stamps_s: &[f64], k: usize, typical: f64) -> bool {
    if k < ORDERED || stamps_s[k - 1] - stamps_s[k] < BACK * typical {
        return false;
    }
    let ordered = |part: &[f64]| {
        part.windows(2).all(|pair| {
            let step = pair[1] - pair[0];
            step > 0.0 && step < FORWARD * typical
        })
    };
    ordered(&stamps_s[k - ORDERED..k]) && ordered(&stamps_s[k..(k + ORDERED).min(stamps_s.len())])
}

/// Whether angle and speed go on from sample `k - 1` to `k`.
fn goes_on(motor: &[f64], k: usize) -> bool {
    let bend = |i: usize| (motor[i + 1] - 2.0 * motor[i] + motor[i - 1]).abs();
    let last = (k + NEAR).min(motor.len().saturating_sub(1));
    let first = k.saturating_sub(NEAR).max(1);
    let near = (first..last).filter(|&i| i + 1 < k || i > k).map(bend).fold(0.0, f64::max);
    [k - 1, k]
        .into_iter()
        .filter(|&i| i > 0 && i + 1 < motor.len())
        .all(|i| bend(i) <= CONTINUOUS * near)
}
