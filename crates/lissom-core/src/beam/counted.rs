//! Roots of a function that comes with a count of those below: none missed, each exact to rounding.

use super::bracket::root;
use crate::number::Scaled;

/// Roots closer to each other than this, relatively, are given as one value.
const TOGETHER: f64 = 4.0 * f64::EPSILON;

/// Doublings tried before a root is taken to be out of a double's range.
const DOUBLINGS_MOST: usize = 1200;

/// The lowest `wanted` positive roots, ascending; fewer where their squares are beyond the range of
/// a double. The search begins at `start`, a power of two: best a little below the first.
///
/// `at` gives the function's value and how many of its roots lie below a point. Intervals are
/// halved until each holds one root, where the function changes its sign; Brent's method finds it.
pub(crate) fn counted_roots(
    at: impl Fn(f64) -> (Scaled<f64>, usize),
    wanted: usize,
    start: f64,
) -> Vec<f64> {
    if wanted == 0 {
        return Vec::new();
    }
    // Powers of two: the ends of intervals stay exact and any scale is reached.
    let mut low = start;
    for _ in 0..DOUBLINGS_MOST {
        if at(low).1 == 0 {
            break;
        }
        low *= 0.5;
    }
    let mut high = low;
    let mut reached = 0;
    for _ in 0..DOUBLINGS_MOST {
        high *= 2.0;
        if high * high >= f64::MAX {
            break;
        }
        reached = at(high).1;
        if reached >= wanted {
            break;
        }
    }
    let mut found = Vec::with_capacity(wanted);
    isolate(&at, (low, 0), (high, reached), &mut found);
    found.truncate(wanted);
    found
}

/// Splits an interval until each part holds one root, ascending.
fn isolate(
    at: &impl Fn(f64) -> (Scaled<f64>, usize),
    (low, below_low): (f64, usize),
    (high, below_high): (f64, usize),
    found: &mut Vec<f64>,
) {
    match below_high.saturating_sub(below_low) {
        0 => {}
        1 => found.push(root(|x| at(x).0, low, high)),
        several => {
            let middle = 0.5 * (low + high);
            if high - low <= TOGETHER * high {
                found.extend(std::iter::repeat_n(middle, several));
                return;
            }
            let count = at(middle).1.clamp(below_low, below_high);
            isolate(at, (low, below_low), (middle, count), found);
            isolate(at, (middle, count), (high, below_high), found);
        }
    }
}
