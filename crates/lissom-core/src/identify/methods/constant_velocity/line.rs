//! A straight line through the points of one direction, extrapolated to zero speed.

use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ContinuousCDF as _, FisherSnedecor, StudentsT};
use thiserror::Error;

use crate::identify::estimate::{Estimate, wider_by_student};
use crate::identify::prepare::correlated_average::FREEDOM;
use crate::identify::prepare::steady_thresholds::SAME_SPEED;
use crate::identify::thresholds::REJECTED_CHANCE;

/// Standard errors below this share of the largest command are rounding.
const ROUNDING: f64 = 1e-9;
/// Rounds in which the slope that turns velocity's standard errors into the command's settles: each
/// takes its change down by the ratio of the two variances.
const ROUNDS: usize = 4;
/// Halvings of the variance that all points share: from all of the command down to 1e-15 of it.
const HALVINGS: usize = 50;

/// Friction in one direction, a straight line `τ = CF + V·|θ̇|` through the points; all values are magnitudes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrictionLine {
    /// Coulomb friction CF: the line extrapolated to zero speed \[N·m or N\].
    pub coulomb: Estimate,
    /// Viscous friction V: slope of the line, without the damping by back-EMF \[N·m·s/rad or N·s/m\].
    pub viscous: Estimate,
    /// Correlation of the errors of CF and V.
    pub correlation: f64,
    /// Number of points.
    pub points: usize,
    /// Number of speeds that differ by 5 % or more.
    pub speeds: usize,
    /// Whether a straight line describes the points.
    pub shape: LineShape,
    /// Coulomb friction from the slowest third of the speeds alone; `None` if these are all speeds or fewer than two.
    pub slowest: Option<Estimate>,
}

/// Shape of the points compared with their line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LineShape {
    /// Only two speeds: the shape cannot be checked.
    Unchecked,
    /// The points are on the line within their standard errors.
    Straight,
    /// Friction grows less than in proportion to speed, so the extrapolation to zero speed is too high.
    Concave {
        /// Curvature divided by its standard error.
        standard_errors: f64,
    },
    /// Friction grows more than in proportion to speed, or falls before it grows, so the
    /// extrapolation to zero speed is too low.
    Convex {
        /// Curvature divided by its standard error.
        standard_errors: f64,
    },
    /// The points are farther from the line than their standard errors allow, on both sides.
    Scattered {
        /// Root mean square of the distances, divided by their standard errors.
        rms: f64,
    },
}

impl FrictionLine {
    /// Best estimate of friction near zero speed: the value of the line if a line describes the points; the value of
    /// the slowest third of the speeds if the points are on a curve. In that case half of the difference is added to
    /// the standard error, because the curve continues within the slowest third.
    pub fn near_rest(&self) -> Estimate {
        match (self.shape, self.slowest) {
            (LineShape::Concave { .. } | LineShape::Convex { .. }, Some(slowest)) => {
                let change = slowest.value - self.coulomb.value;
                Estimate { std: slowest.std.hypot(0.5 * change), ..slowest }
            }
            _ => self.coulomb,
        }
    }
}

/// Reason why one direction gives no friction line.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum LineError {
    /// No stretch at a constant velocity in this direction.
    #[error("no stretch at a constant velocity")]
    NoPoints,
    /// There are too few speeds.
    #[error("there is only {found} speed, but at least two are needed")]
    TooFewSpeeds {
        /// Speeds found.
        found: usize,
    },
    /// The speeds are too close together, or too uncertain, for an extrapolation.
    #[error(
        "the friction extrapolated to zero speed, {coulomb:.4e}, has a standard error of {std:.1e}"
    )]
    TooClose {
        /// Coulomb friction \[N·m or N\].
        coulomb: f64,
        /// Its standard error.
        std: f64,
    },
}

/// A point of the plot, magnitudes.
#[derive(Debug, Clone, Copy)]
pub(super) struct SpeedPoint {
    pub(super) speed: Estimate,
    /// Torque (or force) that keeps up the speed.
    pub(super) drive: Estimate,
}

/// Polynomial through points by weighted least squares.
struct LineFit {
    /// Coefficients in ascending powers of the speed.
    value: Vec<f64>,
    covariance: DMatrix<f64>,
    /// Squared residuals in units of the variances: those of the points and what is added to them.
    chi_squared: f64,
    /// Points beyond coefficients.
    freedom: usize,
    /// Speeds among the points.
    speeds: usize,
    /// Where the points lie farther off than their standard errors allow: that distance (rms) in units of
    /// their deviations. Their scatter is then added to their variances.
    rejected: Option<f64>,
}

/// The line through `points`, `back_emf` taken off its slope.
pub(super) fn line(points: &[SpeedPoint], back_emf: f64) -> Result<FrictionLine, LineError> {
    let mut points = points.to_vec();
    points.sort_by(|a, b| a.speed.value.total_cmp(&b.speed.value));
    let starts = speeds(&points);
    let speeds = starts.len();
    if points.is_empty() {
        return Err(LineError::NoPoints);
    }
    let few = LineError::TooFewSpeeds { found: speeds };
    let fit = if speeds < 2 { None } else { LineFit::new(&points, 1) }.ok_or(few)?;
    let shape = shape(&points, &fit, speeds);
    // Two at least, and a third of them: the rest is what a curve bends away by.
    let slow = starts.get(starts.len().div_ceil(3).max(2));
    let slowest = slow.and_then(|to| LineFit::new(&points[..*to], 1)).map(|f| f.estimate(0));
    let mut coulomb = fit.estimate(0);
    if let (LineShape::Concave { .. } | LineShape::Convex { .. }, Some(slowest)) = (shape, slowest)
    {
        coulomb.std = coulomb.std.hypot(slowest.value - coulomb.value);
    }
    if coulomb.std.is_nan() || coulomb.std > coulomb.value.abs() {
        return Err(LineError::TooClose { coulomb: coulomb.value, std: coulomb.std });
    }
    let c = &fit.covariance;
    let slope = fit.estimate(1);
    Ok(FrictionLine {
        coulomb,
        viscous: Estimate { value: slope.value - back_emf, std: slope.std },
        correlation: c[(0, 1)] / (c[(0, 0)] * c[(1, 1)]).sqrt(),
        points: points.len(),
        speeds,
        shape,
        slowest,
    })
}

/// Where each speed begins among points in ascending order.
fn speeds(points: &[SpeedPoint]) -> Vec<usize> {
    let mut starts: Vec<usize> = Vec::new();
    for (k, p) in points.iter().enumerate() {
        let from = starts.last().map(|s| points[*s].speed.value);
        if from.is_none_or(|from| p.speed.value > SAME_SPEED * from) {
            starts.push(k);
        }
    }
    starts
}

fn shape(points: &[SpeedPoint], line: &LineFit, speeds: usize) -> LineShape {
    if speeds < 3 {
        return LineShape::Unchecked;
    }
    // By the quadratic term; a sharper bend by what a cubic makes of rest, where it fits.
    let parabola = LineFit::new(points, 2).map(|p| {
        let (scale, freedom) = p.scale();
        (p.value[2] / (p.covariance[(2, 2)] * scale).sqrt(), freedom)
    });
    let cubic = || {
        let cubic = LineFit::new(points, 3).filter(|c| c.freedom >= 2 && c.rejected.is_none())?;
        let bent = (cubic.value[0] - line.value[0]) / cubic.covariance[(0, 0)].sqrt();
        Some((bent, cubic.own_freedom()))
    };
    let sharp = if line.rejected.is_some() && speeds > 4 { cubic() } else { None };
    for (standard_errors, freedom) in parabola.into_iter().chain(sharp) {
        let chance = StudentsT::new(0.0, 1.0, freedom)
            .map_or(1.0, |t| 2.0 * t.cdf(-standard_errors.abs().min(f64::MAX)));
        if chance < REJECTED_CHANCE {
            let size = standard_errors.abs();
            return if standard_errors < 0.0 {
                LineShape::Concave { standard_errors: size }
            } else {
                LineShape::Convex { standard_errors: size }
            };
        }
    }
    line.rejected.map_or(LineShape::Straight, |rms| LineShape::Scattered { rms })
}

impl LineFit {
    /// `None` where the speeds do not carry the powers.
    fn new(points: &[SpeedPoint], degree: usize) -> Option<Self> {
        let own = Self::weighted(points, degree, 0.0)?;
        let freedom = own.freedom as f64;
        let reduced = own.chi_squared / freedom;
        let rejected = own.freedom > 0
            && FisherSnedecor::new(freedom, own.own_freedom())
                .is_ok_and(|f| f.sf(reduced) < REJECTED_CHANCE);
        if !rejected {
            return Some(own);
        }
        // Friction differs between the stretches by more than they know of: the variance that all
        // share then is the one that leaves χ² at its degrees of freedom. It falls with it.
        let with = |variance| Self::weighted(points, degree, variance);
        let most = points.iter().map(|p| p.drive.value.powi(2)).fold(0.0, f64::max);
        let (mut low, mut high) = (0.0, most);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if with(middle)?.chi_squared > freedom {
                low = middle;
            } else {
                high = middle;
            }
        }
        Some(Self { rejected: Some(reduced.sqrt()), ..with(high)? })
    }

    /// The fit with `shared` added to the variance of every point.
    fn weighted(points: &[SpeedPoint], degree: usize, shared: f64) -> Option<Self> {
        let most = |get: fn(&SpeedPoint) -> f64| points.iter().map(get).fold(0.0, f64::max);
        let (fastest, largest) = (most(|p| p.speed.value), most(|p| p.drive.value.abs()));
        let columns = degree + 1;
        let mut value = DVector::zeros(columns);
        let mut covariance = DMatrix::zeros(columns, columns);
        let mut chi_squared = 0.0;
        for _ in 0..ROUNDS {
            let mut normal = DMatrix::zeros(columns, columns);
            let mut right = DVector::zeros(columns);
            let mut rows = Vec::with_capacity(points.len());
            for p in points {
                let s = p.speed.value / fastest;
                let slope: f64 =
                    (1..columns).map(|k| k as f64 * value[k] * s.powf(k as f64 - 1.0)).sum();
                let variance = p.drive.std.powi(2)
                    + (slope * p.speed.std / fastest).powi(2)
                    + (ROUNDING * largest).powi(2)
                    + shared;
                let row = DVector::from_fn(columns, |k, _| s.powf(k as f64));
                normal += &row * row.transpose() / variance;
                right += &row * (p.drive.value / variance);
                rows.push((row, p.drive.value, variance));
            }
            covariance = normal.try_inverse()?;
            value = &covariance * right;
            chi_squared = rows.iter().map(|(r, y, v)| (y - r.dot(&value)).powi(2) / v).sum();
        }
        let unit = |k: usize| fastest.powf(-(k as f64));
        Some(Self {
            value: value.iter().enumerate().map(|(k, v)| v * unit(k)).collect(),
            covariance: DMatrix::from_fn(columns, columns, |i, k| {
                covariance[(i, k)] * unit(i) * unit(k)
            }),
            chi_squared,
            freedom: points.len().saturating_sub(columns),
            speeds: speeds(points).len(),
            rejected: None,
        })
    }

    /// Degrees of freedom of the points' own deviations.
    fn own_freedom(&self) -> f64 {
        FREEDOM * (self.freedom + self.value.len()) as f64
    }

    /// What the covariance is to be multiplied by, and the degrees of freedom it then has: the
    /// points' own standard errors, never less than their scatter; the scatter alone where that is beyond
    /// them. Runs repeated at one speed mostly pass through the same travel and meet the same
    /// friction there: then speeds count, not points.
    fn scale(&self) -> (f64, f64) {
        if self.rejected.is_some() {
            (1.0, self.speeds.saturating_sub(self.value.len()).max(1) as f64)
        } else {
            let scatter = self.chi_squared / self.freedom.max(1) as f64;
            (scatter.max(1.0), self.own_freedom())
        }
    }

    /// Coefficient `k`; its standard error is such that 1.96 of it make the 95 % interval.
    fn estimate(&self, k: usize) -> Estimate {
        let (scale, freedom) = self.scale();
        let std = (self.covariance[(k, k)] * scale).max(0.0).sqrt() * wider_by_student(freedom);
        Estimate { value: self.value[k], std }
    }
}

#[cfg(test)]
#[path = "line_tests.rs"]
mod tests;
