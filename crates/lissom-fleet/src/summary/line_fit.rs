//! A robust line through the values of a machine.

use super::robust::{median, scale};

/// Points that deviate by more scales have no weight (Tukey's bisquare): 95 % of the efficiency of least squares for normal
/// errors (Huber, Robust Statistics, 1981).
const BISQUARE: f64 = 4.685;
/// Largest number of iterations.
const ITERATIONS: usize = 30;
/// Relative change of weights at which the iteration ends.
const TOLERANCE: f64 = 1e-6;

/// A line y = level + slope·(x − middle).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LineFit {
    pub(super) level: f64,
    pub(super) slope: f64,
    pub(super) middle: f64,
    /// Standard error of the slope for points with the given standard errors.
    pub(super) slope_std: f64,
}

impl LineFit {
    /// The line at a place.
    pub(super) fn at(&self, x: f64) -> f64 {
        self.level + self.slope * (x - self.middle)
    }
}

/// A point with its standard error, or any number in proportion to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Point {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) std: f64,
}

/// The level of points without a slope: none without points.
pub(super) fn level(points: &[Point]) -> Option<LineFit> {
    let level = median(points.iter().map(|p| p.y))?;
    Some(LineFit { level, slope: 0.0, middle: 0.0, slope_std: f64::INFINITY })
}

/// The line by least squares; none if the points are not at different places.
pub(super) fn line(points: &[Point]) -> Option<LineFit> {
    weighted(points, |_| 1.0)
}

/// The line with less weight for points that deviate more, in scales of their standard errors or, if that is larger, of the
/// deviations themselves.
pub(super) fn robust_line(points: &[Point]) -> Option<LineFit> {
    // From a line of medians, which points far off do not move.
    let mut fit = line_of_medians(points).or_else(|| line(points))?;
    let freedom = points.len() as f64 - 2.0;
    let grown = (points.len() as f64 / freedom).sqrt();
    let own = scale(points.iter().map(|p| (p.y - fit.at(p.x)) / p.std)).map_or(1.0, |s| grown * s);
    let most = BISQUARE * own.max(1.0);
    for _ in 0..ITERATIONS {
        let next = weighted(points, |p| {
            let share = (p.y - fit.at(p.x)) / (most * p.std);
            let left = 1.0 - share * share;
            if left > 0.0 { left * left } else { 0.0 }
        })?;
        let change = (next.slope - fit.slope).abs();
        fit = next;
        if change <= TOLERANCE * fit.slope_std {
            break;
        }
    }
    Some(fit)
}

fn weighted(points: &[Point], weight: impl Fn(&Point) -> f64) -> Option<LineFit> {
    let w = |p: &Point| weight(p) / (p.std * p.std);
    let sum = |of: &dyn Fn(&Point) -> f64| points.iter().map(|p| w(p) * of(p)).sum::<f64>();
    let all = sum(&|_| 1.0);
    let middle = sum(&|p| p.x) / all;
    let level = sum(&|p| p.y) / all;
    let spread = sum(&|p| (p.x - middle) * (p.x - middle));
    let slope = sum(&|p| (p.x - middle) * (p.y - level)) / spread;
    let fit = LineFit { level, slope, middle, slope_std: spread.sqrt().recip() };
    (spread > 0.0 && slope.is_finite()).then_some(fit)
}

/// The line through the medians of the first and the last third of the points (Tukey's resistant line).
fn line_of_medians(points: &[Point]) -> Option<LineFit> {
    let mut ordered = points.to_vec();
    ordered.sort_by(|a, b| a.x.total_cmp(&b.x));
    let third = ordered.len() / 3;
    let (first, last) = (&ordered[..third], &ordered[ordered.len() - third..]);
    let mid = |points: &[Point], of: fn(&Point) -> f64| median(points.iter().map(of));
    let (x1, x2) = (mid(first, |p| p.x)?, mid(last, |p| p.x)?);
    let slope = (mid(last, |p| p.y)? - mid(first, |p| p.y)?) / (x2 - x1);
    let middle = mid(&ordered, |p| p.x)?;
    let level = median(ordered.iter().map(|p| p.y - slope * (p.x - middle)))?;
    (x2 > x1).then_some(LineFit { level, slope, middle, slope_std: f64::INFINITY })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_far_off_hardly_moves_the_line() {
        let point = |k: i32| Point { x: f64::from(k), y: 2.0 + 0.5 * f64::from(k), std: 0.01 };
        let mut points: Vec<Point> = (0..12).map(point).collect();
        let fit = line(&points).unwrap();
        assert!((fit.slope - 0.5).abs() < 1e-12 && (fit.at(0.0) - 2.0).abs() < 1e-12);
        // σ/√Σ(x − x̄)², with Σ = 143 for 0 to 11.
        assert!((fit.slope_std - 0.01 / 143f64.sqrt()).abs() < 1e-12);
        points[11].y = 100.0;
        assert!((robust_line(&points).unwrap().slope - 0.5).abs() < 0.01);
        assert!((line(&points).unwrap().slope - 0.5).abs() > 1.0);
        assert_eq!(line(&[Point { x: 1.0, y: 0.0, std: 1.0 }; 3]), None);
    }
}
