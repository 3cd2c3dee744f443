//! One stretch of a log with one sample time: even as it is, with lost rows, or with uneven stamps.

use std::ops::Range;

use super::agreement::{Agreement, Believed};
use super::interpolation_error::{InterpolationError, fill_error};
use super::part::{LogRows, Part, Sampling};
use super::sample_count::{SampleCount, long_gaps};
use super::tally::{Counted, Resampled, Tally};
use super::thresholds::{
    EVEN_STAMPS, FILLED_ERROR, MEAN_STEP_AGREES, MEAN_STEP_STEADY, MOST_LOST_ROWS, MOST_ODD_GAPS,
    ON_THE_GRID,
};
use super::time_grid::TimeGrid;
use crate::record::TimeBase;

/// Steps over which a mean step is taken.
const BLOCK: usize = 50;

/// The parts of a stretch of increasing stamps, short ones too.
pub(super) fn parts(log: &LogRows, rows: Range<usize>, tally: &mut Tally) -> Vec<Part> {
    let stamps_s = &log.stamps_s[rows.clone()];
    let Some(grid) = TimeGrid::of(stamps_s, log.stamp_step_s) else {
        let base = TimeBase::uniform(stamps_s.first().copied().unwrap_or(0.0), 1.0);
        return vec![Part { rows, base, sampling: Sampling::AsLogged }];
    };
    even_parts(log, &rows, grid, tally).unwrap_or_else(|| uneven_parts(log, &rows, grid, tally))
}

/// Splits rows before the `cuts`, which are counted from the first of the rows.
fn split<'a>(rows: &'a Range<usize>, cuts: &'a [usize]) -> impl Iterator<Item = Range<usize>> + 'a {
    let starts = std::iter::once(rows.start).chain(cuts.iter().map(|cut| rows.start + cut));
    let ends = cuts.iter().map(|cut| rows.start + cut).chain(std::iter::once(rows.end));
    starts.zip(ends).map(|(start, end)| start..end)
}

fn count_gaps(stamps_s: &[f64], cuts: &[usize], tally: &mut Tally) {
    for &k in cuts {
        tally.gap(stamps_s[k - 1], stamps_s[k] - stamps_s[k - 1]);
    }
}

/// Parts of a stretch whose stamps are even but for gaps; `None` where they are not.
fn even_parts(
    log: &LogRows,
    rows: &Range<usize>,
    grid: TimeGrid,
    tally: &mut Tally,
) -> Option<Vec<Part>> {
    let stamps_s = &log.stamps_s[rows.clone()];
    let step = |k: usize| stamps_s[k] - stamps_s[k - 1];
    let (gaps, steps): (Vec<usize>, Vec<usize>) =
        (1..stamps_s.len()).partition(|&k| step(k) > grid.gap_s);
    let steps_s: Vec<f64> = steps.into_iter().map(step).collect();
    let jitter = rms_off(&steps_s, grid.sample_time_s);
    let mean_s = steps_s.iter().sum::<f64>() / steps_s.len().max(1) as f64;
    if jitter > EVEN_STAMPS
        || (mean_s / grid.sample_time_s - 1.0).abs() > MEAN_STEP_AGREES
        || rms_off(&block_means(&steps_s), mean_s) > MEAN_STEP_STEADY
    {
        return None;
    }
    let lost_rows = |k: usize| (step(k) / grid.sample_time_s).round() - 1.0;
    let few = |k: usize| lost_rows(k) <= MOST_LOST_ROWS as f64;
    let whole = |k: usize| (step(k) / grid.sample_time_s - 1.0 - lost_rows(k)).abs() < ON_THE_GRID;
    if gaps.iter().filter(|&&k| few(k) && !whole(k)).count() > MOST_ODD_GAPS {
        return None;
    }
    let mut lost: Vec<usize> = vec![0; MOST_LOST_ROWS + 1];
    for &k in gaps.iter().filter(|&&k| few(k) && whole(k)) {
        lost[lost_rows(k) as usize] += lost_rows(k) as usize;
    }
    let motor = &log.motor[rows.clone()];
    let may_fill: Vec<bool> = lost
        .iter()
        .enumerate()
        .map(|(length, &rows)| rows > 0 && follows(motor, length, rows))
        .collect();
    let filled = |k: usize| few(k) && whole(k) && may_fill[lost_rows(k) as usize];
    let cuts: Vec<usize> = gaps.iter().copied().filter(|&k| !filled(k)).collect();
    count_gaps(stamps_s, &cuts, tally);
    let part = |part: Range<usize>| {
        let stamps_s = &log.stamps_s[part.clone()];
        let base = grid.base(stamps_s);
        let longest = |pair: &[f64]| pair[1] - pair[0] > grid.gap_s;
        if !stamps_s.windows(2).any(longest) {
            return Part { rows: part, base, sampling: Sampling::AsLogged };
        }
        let mut position = 0.0;
        let steps = stamps_s.windows(2).map(|pair| (pair[1] - pair[0]) / grid.sample_time_s);
        let next = |step: f64| {
            position += if step * grid.sample_time_s > grid.gap_s { step.round() } else { 1.0 };
            position
        };
        let positions: Vec<f64> = std::iter::once(0.0).chain(steps.map(next)).collect();
        // Steps across lost rows are no jitter.
        let base =
            TimeBase { jitter_max_s: 0.0, jitter_rms_s: jitter * grid.sample_time_s, ..base };
        Part { rows: part, base, sampling: Sampling::LostRows(positions) }
    };
    Some(split(rows, &cuts).map(part).collect())
}

/// Rms distance of numbers from `mean`, as a share of it.
fn rms_off(numbers: &[f64], mean: f64) -> f64 {
    let squares: f64 = numbers.iter().map(|x| (x / mean - 1.0).powi(2)).sum();
    (squares / numbers.len().max(1) as f64).sqrt()
}

fn block_means(numbers: &[f64]) -> Vec<f64> {
    numbers.chunks_exact(BLOCK).map(|block| block.iter().sum::<f64>() / BLOCK as f64).collect()
}

/// Whether the motion can be interpolated across `length` lost rows, of which there are `rows` in all.
fn follows(motor: &[f64], length: usize, rows: usize) -> bool {
    let time: Vec<f64> = (0..motor.len()).map(|k| k as f64).collect();
    let noise = InterpolationError::of(&time, motor).noise;
    let n = motor.len() as f64;
    let mean = motor.iter().sum::<f64>() / n;
    let spread = (motor.iter().map(|q| (q - mean).powi(2)).sum::<f64>() / n).sqrt();
    (rows as f64 / n).sqrt() * fill_error(motor, length) <= noise.max(FILLED_ERROR * spread)
}

/// Parts of a stretch with uneven stamps.
fn uneven_parts(
    log: &LogRows,
    rows: &Range<usize>,
    grid: TimeGrid,
    tally: &mut Tally,
) -> Vec<Part> {
    let stamps_s = &log.stamps_s[rows.clone()];
    let cuts = long_gaps(stamps_s, true);
    let mut agreement = Agreement::default();
    let mut counts = Vec::new();
    for part in split(rows, &cuts).filter(|part| part.len() > 1) {
        let count = SampleCount::of(&log.stamps_s[part.clone()]);
        let stamps = positions(&log.stamps_s[part.clone()], count.step_s);
        agreement.add(&log.motor[part.clone()], &stamps, &count.positions);
        counts.push((part, count));
    }
    match agreement.believed() {
        Believed::Stamps => {
            let cuts = long_gaps(stamps_s, false);
            count_gaps(stamps_s, &cuts, tally);
            let shown = Some(agreement.ratio());
            let step_s = mean_step(&counts).unwrap_or(grid.sample_time_s);
            let part = |part: Range<usize>| {
                let stamps_s = &log.stamps_s[part.clone()];
                uneven(log, part, stamps_s[0], step_s, positions(stamps_s, step_s), shown, tally)
            };
            split(rows, &cuts).map(part).collect()
        }
        believed => {
            count_gaps(stamps_s, &cuts, tally);
            let no_gaps = stamps_s.windows(2).all(|pair| pair[1] - pair[0] <= grid.gap_s);
            if let (Believed::Either, true, [(part, count)]) =
                (believed, no_gaps, counts.as_slice())
                && !count.drifts
                && (count.step_s / grid.sample_time_s - 1.0).abs() <= MEAN_STEP_AGREES
            {
                let base = grid.base(stamps_s);
                return vec![Part { rows: part.clone(), base, sampling: Sampling::AsLogged }];
            }
            let shown = (believed == Believed::Count).then(|| agreement.ratio());
            counts
                .into_iter()
                .map(|(part, count)| counted(log, part, count, shown, tally))
                .collect()
        }
    }
}

/// The mean step of all parts, by their numbers of rows.
fn mean_step(counts: &[(Range<usize>, SampleCount)]) -> Option<f64> {
    let rows: usize = counts.iter().map(|(part, _)| part.len()).sum();
    let sum: f64 = counts.iter().map(|(part, count)| part.len() as f64 * count.step_s).sum();
    (rows > 0).then(|| sum / rows as f64)
}

fn positions(stamps_s: &[f64], step_s: f64) -> Vec<f64> {
    let first = stamps_s.first().copied().unwrap_or(0.0);
    stamps_s.iter().map(|t| (t - first) / step_s).collect()
}

/// A part whose rows are at `positions` of the grid.
fn uneven(
    log: &LogRows,
    rows: Range<usize>,
    start_s: f64,
    step_s: f64,
    positions: Vec<f64>,
    agreement: Option<f64>,
    tally: &mut Tally,
) -> Part {
    let error = InterpolationError::of(&positions, &log.motor[rows.clone()]);
    tally.resample(Resampled::new(step_s, agreement, error));
    let base = TimeBase::uniform(start_s, step_s);
    Part { rows, base, sampling: Sampling::Uneven(positions) }
}

/// A part whose samples are taken as even.
fn counted(
    log: &LogRows,
    rows: Range<usize>,
    count: SampleCount,
    agreement: Option<f64>,
    tally: &mut Tally,
) -> Part {
    if count.drifts {
        return uneven(log, rows, count.start_s, count.step_s, count.positions, None, tally);
    }
    let (jitter_rms_s, jitter_max_s) = count.jitter_s;
    if let Some(agreement) = agreement {
        let jitter_rms_share = jitter_rms_s / count.step_s;
        tally.count(Counted { step_s: count.step_s, jitter_rms_share, agreement });
    }
    let mut base = TimeBase::uniform(count.start_s, count.step_s);
    if agreement.is_none() {
        (base.jitter_rms_s, base.jitter_max_s) = (jitter_rms_s, jitter_max_s);
    }
    let lost = count.positions.last().is_some_and(|last| *last as usize + 1 > rows.len());
    let sampling = if lost { Sampling::LostRows(count.positions) } else { Sampling::AsLogged };
    Part { rows, base, sampling }
}
