//! Channels on an even grid, from samples at other times.

use super::lagrange;

/// A sample this near to a point of the grid, in steps, is taken as it is.
const ON_THE_POINT: f64 = 1e-6;
/// Samples of a polynomial are at least this far from each other, in steps: nearer ones make much of their noise.
const APART: f64 = 0.3;
/// Samples that are passed over in the search for one that is far enough.
const FURTHEST: usize = 16;

/// How the points of a grid follow from samples.
pub(super) struct Resampler<'a> {
    /// Increasing times of the samples in steps of the grid, the first 0.
    positions: &'a [f64],
    points: Vec<Point>,
}

enum Point {
    Sample(usize),
    /// Between a sample and the next one: those that it follows from.
    Between([usize; 4], [f64; 4]),
    /// The same where four samples are not far enough from each other.
    Line(usize, f64),
}

impl<'a> Resampler<'a> {
    pub(super) fn new(positions: &'a [f64]) -> Self {
        let count = positions.last().map_or(0, |last| (last + ON_THE_POINT).floor() as usize + 1);
        let mut points = Vec::with_capacity(count);
        let mut k = 0;
        for j in 0..count {
            let at = j as f64;
            while k + 2 < positions.len() && positions[k + 1] <= at {
                k += 1;
            }
            points.push(point(positions, k, at));
        }
        Self { positions, points }
    }

    /// Points that are no samples.
    pub(super) fn interpolated(&self) -> usize {
        self.points.iter().filter(|point| !matches!(point, Point::Sample(_))).count()
    }

    /// A measured channel: cubic polynomials through four samples.
    pub(super) fn measured(&self, y: &[f64]) -> Vec<f64> {
        let value = |point: &Point| match point {
            Point::Sample(k) => y[*k],
            Point::Between(nodes, weights) => lagrange::value(*weights, nodes.map(|k| y[k])),
            Point::Line(k, share) => y[*k] + share * (y[k + 1] - y[*k]),
        };
        self.points.iter().map(value).collect()
    }

    /// A held command: the mean over each step of the grid of the value that is held from each sample to the next.
    pub(super) fn held(&self, u: &[f64]) -> Vec<f64> {
        let last = u.len().saturating_sub(1);
        let mut k = 0;
        let mean = |j: usize| {
            let (start, end) = (j as f64, j as f64 + 1.0);
            while k < last && self.positions[k + 1] <= start + ON_THE_POINT {
                k += 1;
            }
            let (mut sum, mut from, mut i) = (0.0, start, k);
            while i < last && self.positions[i + 1] < end {
                sum += u[i] * (self.positions[i + 1] - from).max(0.0);
                from = self.positions[i + 1].max(from);
                i += 1;
            }
            sum + u[i] * (end - from)
        };
        (0..self.points.len()).map(mean).collect()
    }

    /// A held command of which rows are lost: a straight line in their place.
    pub(super) fn held_with_lost_rows(&self, u: &[f64]) -> Vec<f64> {
        let mut k = 0;
        let value = |(j, point): (usize, &Point)| {
            if let Point::Sample(k) = point {
                return u[*k];
            }
            let at = j as f64;
            while k + 2 < u.len() && self.positions[k + 1] <= at {
                k += 1;
            }
            let share = (at - self.positions[k]) / (self.positions[k + 1] - self.positions[k]);
            u[k] + share * (u[k + 1] - u[k])
        };
        self.points.iter().enumerate().map(value).collect()
    }
}

/// The point at `at`, which is between the samples `k` and `k + 1`.
fn point(positions: &[f64], k: usize, at: f64) -> Point {
    let near = |k: usize| positions.get(k).is_some_and(|p| (p - at).abs() <= ON_THE_POINT);
    if near(k) {
        return Point::Sample(k);
    }
    if near(k + 1) || k + 1 >= positions.len() {
        return Point::Sample((k + 1).min(positions.len() - 1));
    }
    let line = Point::Line(k, (at - positions[k]) / (positions[k + 1] - positions[k]));
    let before = |k: usize| {
        (k.saturating_sub(FURTHEST)..k).rev().find(|&i| positions[k] - positions[i] >= APART)
    };
    let after = |k: usize| {
        (k + 1..(k + 1 + FURTHEST).min(positions.len()))
            .find(|&i| positions[i] - positions[k] >= APART)
    };
    if positions[k + 1] - positions[k] < APART {
        return line;
    }
    let (first, last) = (before(k), after(k + 1));
    let nodes = match (first, last) {
        (Some(first), Some(last)) => Some([first, k, k + 1, last]),
        (None, Some(third)) => after(third).map(|fourth| [k, k + 1, third, fourth]),
        (Some(second), None) => before(second).map(|first| [first, second, k, k + 1]),
        (None, None) => None,
    };
    nodes.map_or(line, |nodes| {
        Point::Between(nodes, lagrange::weights(nodes.map(|i| positions[i]), at))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cubic_at_uneven_times_is_exact_on_the_grid() {
        let positions = [0.0, 1.2, 1.9, 3.0, 4.4, 5.0, 6.1];
        let cubic = |t: f64| 2.0 + t - 0.3 * t * t + 0.1 * t * t * t;
        let grid = Resampler::new(&positions).measured(&positions.map(cubic));
        assert_eq!(grid.len(), 7);
        for (j, value) in grid.iter().enumerate() {
            assert!((value - cubic(j as f64)).abs() < 1e-12, "{j}: {value}");
        }
    }

    #[test]
    fn the_integral_of_a_held_command_is_kept() {
        let positions = [0.0, 0.7, 2.4, 3.0, 4.0];
        let held = Resampler::new(&positions).held(&[1.0, -2.0, 5.0, 3.0, 0.5]);
        let expected = [0.7 - 0.6, -2.0, -0.8 + 3.0, 3.0, 0.5];
        for (value, expected) in held.iter().zip(expected) {
            assert!((value - expected).abs() < 1e-12, "{held:?}");
        }
    }

    #[test]
    fn lost_rows_are_filled_and_others_kept() {
        let positions = [0.0, 1.0, 2.0, 4.0, 5.0, 6.0];
        let y = positions.map(|t: f64| t * t);
        let resampler = Resampler::new(&positions);
        assert_eq!(resampler.interpolated(), 1);
        let filled = resampler.measured(&y);
        assert!((filled[3] - 9.0).abs() < 1e-12, "{filled:?}");
        assert!((resampler.held_with_lost_rows(&y)[3] - 10.0).abs() < 1e-12);
    }

    #[test]
    fn stamps_that_nearly_coincide_do_no_harm() {
        let positions: Vec<f64> =
            (0..100).flat_map(|k| [f64::from(k) * 1.1, f64::from(k) * 1.1 + 1e-5]).collect();
        let noisy: Vec<f64> = (0..200).map(|k| f64::from(k % 3)).collect();
        let grid = Resampler::new(&positions).measured(&noisy);
        assert!(grid.iter().all(|value| value.abs() < 10.0), "{grid:?}");
    }
}
