//! Extent of a channel: its smallest step and its range.

/// Smallest difference between neighbouring values that a channel takes: its step.
///
/// Differences below 1e-9 of the range are rounding of one value. Zero for a constant.
pub(crate) fn step(samples: &[f64]) -> f64 {
    let range = range(samples);
    least_difference(samples, 1e-9 * range).min(range)
}

/// Values looked at side by side: one after the other would wait for each comparison.
const LANES: usize = 8;

/// Smallest difference of neighbouring values that is larger than `floor`; infinite where none is.
pub(crate) fn least_difference(samples: &[f64], floor: f64) -> f64 {
    let Some((_, after)) = samples.split_first() else { return f64::INFINITY };
    let (before, _) = samples.split_at(after.len());
    let mut least = [f64::INFINITY; LANES];
    let mut take = |lane: usize, a: f64, b: f64| {
        let way = (b - a).abs();
        let way = if way > floor { way } else { f64::INFINITY };
        least[lane] = if way < least[lane] { way } else { least[lane] };
    };
    let ((before, a_rest), (after, b_rest)) =
        (before.as_chunks::<LANES>(), after.as_chunks::<LANES>());
    for (a, b) in before.iter().zip(after) {
        (0..LANES).for_each(|lane| take(lane, a[lane], b[lane]));
    }
    a_rest.iter().zip(b_rest).for_each(|(a, b)| take(0, *a, *b));
    least.into_iter().fold(f64::INFINITY, f64::min)
}

/// Largest minus smallest value.
pub(crate) fn range(samples: &[f64]) -> f64 {
    let (low, high) = extremes(samples);
    high - low
}

pub(crate) fn extremes(samples: &[f64]) -> (f64, f64) {
    let (mut low, mut high) = ([f64::INFINITY; LANES], [f64::NEG_INFINITY; LANES]);
    let mut take = |lane: usize, x: f64| {
        low[lane] = if x < low[lane] { x } else { low[lane] };
        high[lane] = if x > high[lane] { x } else { high[lane] };
    };
    let (chunks, rest) = samples.as_chunks::<LANES>();
    for chunk in chunks {
        (0..LANES).for_each(|lane| take(lane, chunk[lane]));
    }
    for x in rest {
        take(0, *x);
    }
    let low = low.into_iter().fold(f64::INFINITY, f64::min);
    (low, high.into_iter().fold(f64::NEG_INFINITY, f64::max))
}
