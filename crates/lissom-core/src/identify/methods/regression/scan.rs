//! Choice of the window length at which the estimates are best known.

use std::collections::VecDeque;

use crate::identify::methods::regression::normal::Solution;
use crate::identify::methods::regression::thresholds::{
    CLUSTERS_LEAST, WINDOW_FAR_WORSE, WINDOW_HOPELESS,
};

/// Fewest samples in a window.
const LEAST_SAMPLES: f64 = 10.0;
/// Ratio of one candidate's length to that before it.
pub(super) const RATIO: f64 = std::f64::consts::SQRT_2;
/// The scan ends early only if the scatter has grown twice in a row and rests on more rows than this: few rows scatter
/// anyhow, and cost little.
const MANY_ROWS: usize = 2000;
/// Most candidates: √2⁴⁰ is a factor of a million in length.
const MOST_CANDIDATES: i32 = 40;

/// A window length that was tried.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate {
    /// Length of the window \[s\].
    pub window_s: f64,
    /// Number of windows (rows).
    pub rows: usize,
    /// Number of slip phases (or blocks) with windows.
    pub clusters: usize,
    /// Relative residual ‖y − X·q‖/‖y‖ \[1\].
    pub relative_residual: f64,
    /// Root mean square of two things: the relative changes of the estimates from the next shorter to the next longer
    /// window, and their relative standard errors \[1\]. Infinite at the ends of the list.
    pub sensitivity: f64,
}

/// The chosen candidate among all.
#[derive(Debug, Clone)]
pub(crate) struct Scan {
    pub(crate) candidates: Vec<Candidate>,
    pub(crate) chosen: usize,
    pub(crate) solution: Solution,
    /// Change of each estimate from the next shorter to the next longer window.
    pub(crate) change: Vec<f64>,
}

/// Tries windows each √2 shorter than the one before, from the longest of which a few phases hold one
/// down to ten samples; takes the one with the least sensitivity in the estimates marked by `counts`.
///
/// Below some length the estimates scatter the more the shorter a window is: none is tried beyond one
/// whose growing scatter alone is well over the least sensitivity, or where it grows and all is far over it.
///
/// With `given` lengths only these are taken, each between neighbours that tell its sensitivity.
pub(crate) fn scan(
    sample_time_s: f64,
    given: &[f64],
    counts: &[bool],
    solve: impl Fn(f64) -> Option<Solution>,
) -> Option<Scan> {
    let shortest = LEAST_SAMPLES * sample_time_s;
    let usable = |length: f64| {
        let solution = (length >= 0.5 * shortest).then(|| solve(length)).flatten();
        solution.filter(|s| s.clusters >= CLUSTERS_LEAST && s.rows >= 3 * s.value.len())
    };
    if !given.is_empty() {
        let scans = given.iter().filter_map(|&length| {
            let around = [length / RATIO, length, length * RATIO];
            let tried: Vec<_> = around.into_iter().filter_map(|l| Some((l, usable(l)?))).collect();
            choose(&tried, counts, Some(length))
        });
        return scans.min_by(|a, b| a.sensitivity().total_cmp(&b.sensitivity()));
    }
    let mut tried: VecDeque<(f64, Solution)> = VecDeque::new();
    let mut least = f64::INFINITY;
    let mut scatters = [f64::INFINITY; 3];
    for k in (0..MOST_CANDIDATES).rev() {
        let length = shortest * RATIO.powi(k);
        let Some(solution) = usable(length) else { continue };
        let rows = solution.rows;
        scatters = [scatters[1], scatters[2], scatter(&solution, counts).unwrap_or(0.0)];
        tried.push_front((length, solution));
        let mut before = 0.0;
        if tried.len() > 2 {
            before = sensitivity(tried.make_contiguous(), 1, counts);
            least = least.min(before);
        }
        let rises = scatters.is_sorted_by(|longer, shorter| longer < shorter);
        let hopeless = scatters[2] > WINDOW_HOPELESS * least || before > WINDOW_FAR_WORSE * least;
        if rows > MANY_ROWS && rises && hopeless {
            break;
        }
    }
    choose(tried.make_contiguous(), counts, None)
}

/// Root mean square over the estimates that count of what `of` says of each, relative to its size; `None`
/// where all of them are inseparable.
fn relative(s: &Solution, counts: &[bool], of: impl Fn(usize, f64) -> f64) -> Option<f64> {
    let (mut sum, mut number) = (0.0, 0.0);
    for (i, _) in counts.iter().enumerate().filter(|(_, c)| **c) {
        // An estimate that is zero within its scatter must not decide.
        let variance = s.covariance[(i, i)].max(0.0);
        let size = s.value[i].abs().max(3.0 * variance.sqrt());
        if !s.inseparable[i] && size > 0.0 {
            sum += of(i, variance) / (size * size);
            number += 1.0;
        }
    }
    (number > 0.0).then(|| (sum / number).sqrt())
}

/// Root mean square of the estimates' relative deviations.
fn scatter(s: &Solution, counts: &[bool]) -> Option<f64> {
    relative(s, counts, |_, variance| variance)
}

/// Root mean square of the estimates' relative change from neighbour to neighbour and of their relative
/// standard errors; infinite at the ends.
fn sensitivity(tried: &[(f64, Solution)], k: usize, counts: &[bool]) -> f64 {
    if k == 0 || k + 1 >= tried.len() {
        return f64::INFINITY;
    }
    let (before, here, after) = (&tried[k - 1].1, &tried[k].1, &tried[k + 1].1);
    let change = |i: usize| after.value[i] - before.value[i];
    relative(here, counts, |i, variance| change(i) * change(i) + variance).unwrap_or(f64::INFINITY)
}

impl Scan {
    fn sensitivity(&self) -> f64 {
        self.candidates[self.chosen].sensitivity
    }
}

/// Takes the length `given`, or the one with the least sensitivity.
fn choose(tried: &[(f64, Solution)], counts: &[bool], given: Option<f64>) -> Option<Scan> {
    let candidates: Vec<Candidate> = tried
        .iter()
        .enumerate()
        .map(|(k, (window_s, s))| Candidate {
            window_s: *window_s,
            rows: s.rows,
            clusters: s.clusters,
            relative_residual: s.relative_residual,
            sensitivity: sensitivity(tried, k, counts),
        })
        .collect();
    let chosen = if let Some(length) = given {
        candidates.iter().position(|c| (c.window_s - length).abs() < 1e-12 * length)?
    } else {
        let least = candidates
            .iter()
            .enumerate()
            .min_by(|a, b| a.1.sensitivity.total_cmp(&b.1.sensitivity));
        least?.0
    };
    let solution = tried[chosen].1.clone();
    let neighbour = |k: usize| tried.get(k).map(|(_, solution)| solution);
    let change = change(neighbour(chosen.wrapping_sub(1)), &solution, neighbour(chosen + 1));
    Some(Scan { candidates, chosen, solution, change })
}

/// Change of each estimate from the next shorter to the next longer window; twice that to the one neighbour where there
/// is only one that tells it.
pub(super) fn change(
    shorter: Option<&Solution>,
    here: &Solution,
    longer: Option<&Solution>,
) -> Vec<f64> {
    let of = |i: usize| match [shorter, longer].map(|s| s.filter(|s| !s.inseparable[i])).into() {
        (Some(a), Some(b)) => b.value[i] - a.value[i],
        (Some(a), None) | (None, Some(a)) => 2.0 * (a.value[i] - here.value[i]),
        (None, None) => 0.0,
    };
    (0..here.value.len()).map(of).collect()
}
