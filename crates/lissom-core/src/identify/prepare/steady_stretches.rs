//! Finds parts of a run in which the motor turns at a constant velocity.

use std::collections::VecDeque;
use std::ops::Range;

use crate::identify::prepare::correlated_average::{Average, VALUES_LEAST, average};
use crate::identify::prepare::steady_thresholds::{
    COMMAND_CHANGE, GROWN_BY, SAME_STRETCH, STEADY_PART, STOPPED_SHARE, STOPPED_SPEED, VARIES_BY,
    VARIES_SHARE, VELOCITY_KNOWN,
};
use crate::identify::thresholds::TRAVEL_OVER_NOISE;
use crate::record::{Hold, Run};

/// Velocities are first looked at over blocks of this many samples, then of twice as many…
const BLOCK_LEAST: usize = 8;
/// …and so on, with no more than this many blocks in a run.
const BLOCKS_MOST: usize = 2000;
/// Blocks in a stretch.
const BLOCKS_LEAST: usize = 8;
/// Two to this many sixteenths of a grown stretch are trimmed, one at each end at least: transients.
const TRIMMED_MOST: usize = 4;

/// Velocities that may swing are looked at over this many times what a sure sign needs: noise is then a few percent.
const VARIES_BLOCKS: usize = 4;

/// A stretch of a run at one velocity.
#[derive(Debug, Clone)]
pub(crate) struct SteadyStretch {
    /// Sample intervals: the motor from sample `start` to sample `end`.
    pub(crate) intervals: Range<usize>,
    /// Mean velocity \[rad/s or m/s\].
    pub(crate) velocity: Average,
    /// Mean command.
    pub(crate) command: Average,
}

/// A grown stretch, to be trimmed and judged.
struct Grown {
    intervals: Range<usize>,
    share: f64,
}

/// All stretches of a run, in order.
///
/// Velocities over blocks of 8, 16, … samples are grown into the longest stretches in which they
/// agree to a share; blocks longer than the beam's oscillation average it away. The longest ones
/// are judged first and none may overlap. A stretch stands where a parabola through its velocity
/// changes by less than a sixth of that share, two standard errors counted; where the motor never stops
/// in it; and where the command does not change by more than 10 %.
pub(crate) fn stretches(run: &Run, hold: Hold) -> Vec<SteadyStretch> {
    let mut grown = grown(run);
    grown.sort_by_key(|g| std::cmp::Reverse(g.intervals.len()));
    let mut found: Vec<SteadyStretch> = Vec::new();
    let mut rejected: Vec<Range<usize>> = Vec::new();
    for candidate in grown {
        let whole = &candidate.intervals;
        let same = |r: &Range<usize>| {
            overlap(r, whole) as f64 > SAME_STRETCH * r.len().max(whole.len()) as f64
        };
        if rejected.iter().any(same) {
            continue;
        }
        let free = |r: &Range<usize>| found.iter().all(|f| overlap(&f.intervals, r) == 0);
        match trims(whole).filter(free).find_map(|r| judged(run, hold, r, candidate.share)) {
            Some(stretch) => found.push(stretch),
            None => rejected.push(candidate.intervals),
        }
    }
    found.sort_by_key(|f| f.intervals.start);
    found
}

fn overlap(a: &Range<usize>, b: &Range<usize>) -> usize {
    a.end.min(b.end).saturating_sub(a.start.max(b.start))
}

/// The stretch with its ends trimmed, the longest first.
fn trims(whole: &Range<usize>) -> impl Iterator<Item = Range<usize>> + use<> {
    let (start, end) = (whole.start, whole.end);
    let part = (end - start) / 16;
    (2..=TRIMMED_MOST).flat_map(move |trimmed| {
        (1..trimmed).rev().map(move |head| start + head * part..end - (trimmed - head) * part)
    })
}

/// Every longest stretch whose block velocities agree, for every length of block.
fn grown(run: &Run) -> Vec<Grown> {
    let (x, t) = (run.motor(), run.sample_time_s());
    let mut out = Vec::new();
    let mut block = BLOCK_LEAST.max(x.len().div_ceil(BLOCKS_MOST));
    while x.len() / block > BLOCKS_LEAST {
        let velocity = block_velocities(x, block, t);
        for share in GROWN_BY {
            out.extend(agreeing(&velocity, share).into_iter().map(|blocks| {
                // Velocity j lies between the middles of blocks j and j + 1.
                let middle = |b: usize| b * block + block / 2;
                Grown { intervals: middle(blocks.start)..middle(blocks.end), share }
            }));
        }
        block *= 2;
    }
    out.retain(|g| g.intervals.len() >= VALUES_LEAST);
    out
}

/// Differences of the means of neighbouring blocks, per time.
fn block_velocities(x: &[f64], block: usize, sample_time_s: f64) -> Vec<f64> {
    // From the first sample: a mean of large angles would lose digits.
    let means: Vec<f64> = x
        .chunks_exact(block)
        .map(|c| c.iter().map(|v| v - x[0]).sum::<f64>() / block as f64)
        .collect();
    means.windows(2).map(|m| (m[1] - m[0]) / (block as f64 * sample_time_s)).collect()
}

/// Longest ranges of at least [`BLOCKS_LEAST`] velocities of one sign whose largest is at most
/// 1 + `share` times the smallest; none within another.
fn agreeing(velocity: &[f64], share: f64) -> Vec<Range<usize>> {
    let speed = |k: usize| velocity[k].abs();
    // Indices within the range, ascending (descending) in speed: the front is the extreme.
    let (mut small, mut large) = (VecDeque::new(), VecDeque::new());
    let mut out = Vec::new();
    let mut start = 0;
    for end in 0..velocity.len() {
        let sign_kept = velocity[end] * velocity[start] > 0.0;
        push(&mut small, end, |k| speed(k) >= speed(end));
        push(&mut large, end, |k| speed(k) <= speed(end));
        let agrees = |small: &VecDeque<usize>, large: &VecDeque<usize>| {
            speed(large[0]) <= (1.0 + share) * speed(small[0])
        };
        if sign_kept && agrees(&small, &large) {
            continue;
        }
        if end - start >= BLOCKS_LEAST {
            out.push(start..end);
        }
        while start < end && !(velocity[start] * velocity[end] > 0.0 && agrees(&small, &large)) {
            start += 1;
            drop_before(&mut small, start);
            drop_before(&mut large, start);
        }
    }
    if velocity.len() - start >= BLOCKS_LEAST {
        out.push(start..velocity.len());
    }
    out
}

fn push(queue: &mut VecDeque<usize>, index: usize, beaten: impl Fn(usize) -> bool) {
    while queue.back().is_some_and(|k| beaten(*k)) {
        queue.pop_back();
    }
    queue.push_back(index);
}

fn drop_before(queue: &mut VecDeque<usize>, first: usize) {
    while queue.front().is_some_and(|k| *k < first) {
        queue.pop_front();
    }
}

/// The stretch with its averages, if it is steady.
fn judged(run: &Run, hold: Hold, r: Range<usize>, share: f64) -> Option<SteadyStretch> {
    let (x, t) = (run.motor(), run.sample_time_s());
    let series: Vec<f64> = x[r.start..=r.end].windows(2).map(|w| (w[1] - w[0]) / t).collect();
    let velocity = average(&series)?;
    let speed = velocity.mean.abs();
    let changed = velocity.change + 2.0 * velocity.change_std;
    if !(changed <= STEADY_PART * share * speed && velocity.std <= VELOCITY_KNOWN * speed) {
        return None;
    }
    let moved = &x[r.start..=r.end];
    if stops(moved, velocity.mean * t) || varies(moved, velocity.mean * t) {
        return None;
    }
    let command = average(&acting(&run.command()[r.start..=r.end], hold))?;
    let drifts = command.change - 2.0 * command.change_std > COMMAND_CHANGE * command.mean.abs();
    (!drifts).then_some(SteadyStretch { intervals: r, velocity, command })
}

/// The command over each sample interval.
fn acting(command: &[f64], hold: Hold) -> Vec<f64> {
    command
        .windows(2)
        .map(|w| match hold {
            Hold::Sampled => w[0],
            Hold::Measured => 0.5 * (w[0] + w[1]),
        })
        .collect()
}

/// Samples over which a motor that moves by `per_sample` moves by several times its sensor's noise.
fn sure_block(x: &[f64], per_sample: f64) -> usize {
    // Of white noise the second difference has √6 times the deviation.
    let second: f64 = x.windows(3).map(|w| (w[2] - 2.0 * w[1] + w[0]).powi(2)).sum();
    let noise = (second / 6.0 / x.len() as f64).sqrt();
    ((TRAVEL_OVER_NOISE * noise / per_sample.abs()).ceil() as usize).max(BLOCK_LEAST)
}

/// Whether its velocity swings about the mean, though the mean is steady.
fn varies(x: &[f64], per_sample: f64) -> bool {
    let block = VARIES_BLOCKS * sure_block(x, per_sample);
    let velocity = block_velocities(x, block, 1.0);
    let off = |v: &&f64| (**v / per_sample - 1.0).abs() > VARIES_BY;
    velocity.iter().filter(off).count() as f64 > VARIES_SHARE * velocity.len() as f64
}

/// Whether a motor that moves by `per_sample` on average stops or turns back in between.
fn stops(x: &[f64], per_sample: f64) -> bool {
    let velocity = block_velocities(x, sure_block(x, per_sample), 1.0);
    let slow = velocity.iter().filter(|v| **v / per_sample < STOPPED_SPEED).count();
    slow as f64 > STOPPED_SHARE * velocity.len() as f64
}
