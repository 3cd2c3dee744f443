//! Maximum likelihood: poles and residues moved together, from where vector fitting has come to.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};
use num_complex::Complex64;
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

use super::Pole;
use super::products::products;
use super::shared_poles::Damping;
use super::weighted::{Output, Weighted};

/// Most steps.
const STEPS: usize = 40;
/// A step is not worth making that promises less than this, in squared deviations.
const PROMISE: f64 = 1e-7;
/// The same as a share of what is left.
const SHARE: f64 = 1e-12;
/// Most halvings of a step.
const HALVINGS: usize = 12;
/// Largest change of a frequency's logarithm in one step.
const LARGEST: f64 = 0.2;

/// Poles with the residues that are best at them.
pub(super) struct Point {
    pub(super) poles: Vec<Pole>,
    /// `ρ_ik = r_ik/ω_k²` of output i (outer) and pole k.
    pub(super) static_gains: Vec<DVector<f64>>,
    /// Squares of the residuals, each part in its deviations.
    pub(super) cost: f64,
    /// By ln ω_k and, of damped poles, ζ_k, the gains eliminated.
    normal: DMatrix<f64>,
    right: DVector<f64>,
    /// Of each output: the gains' own normal matrix, factored, and its products with the poles'.
    own: Vec<Own>,
}

struct Own {
    factor: Cholesky<f64, Dyn>,
    across: DMatrix<f64>,
}

/// Gauss-Newton on the poles, the gains being linear (variable projection), from `poles`. `None` where two
/// poles have come together.
pub(super) fn refined(data: &Weighted, mut poles: Vec<Pole>, damping: Damping) -> Option<Point> {
    if damping == Damping::None {
        for pole in &mut poles {
            pole.damping_ratio = 0.0;
        }
    }
    let mut point = Point::new(data, poles, damping)?;
    for _ in 0..STEPS {
        let step = point.normal.clone().cholesky()?.solve(&point.right);
        let promised = step.dot(&point.right);
        if promised < PROMISE.max(SHARE * point.cost) {
            break;
        }
        let mut share = (LARGEST / largest(&step, damping)).min(1.0);
        let halved = (0..HALVINGS).find_map(|_| {
            let found = Point::new(data, point.moved(&step, share, damping), damping);
            share *= 0.5;
            found.filter(|f| f.cost < point.cost)
        });
        let Some(better) = halved else { break };
        point = better;
    }
    let ascending = |a: &Pole, b: &Pole| a.omega_rad_s <= b.omega_rad_s;
    if point.poles.is_sorted_by(ascending) {
        return Some(point);
    }
    point.poles.sort_by(|a, b| a.omega_rad_s.total_cmp(&b.omega_rad_s));
    Point::new(data, point.poles, damping)
}

/// Largest change of ln ω in a step.
fn largest(step: &DVector<f64>, damping: Damping) -> f64 {
    step.iter().step_by(damping.unknowns()).map(|s| s.abs()).fold(0.0, f64::max)
}

impl Point {
    pub(super) fn new(data: &Weighted, poles: Vec<Pole>, damping: Damping) -> Option<Self> {
        let (count, unknowns) = (poles.len(), poles.len() * damping.unknowns());
        let columns = columns(data, &poles, damping);
        let each: Vec<OneOutput> = data
            .outputs
            .par_iter()
            .map(|output| OneOutput::new(data, output, &columns, count))
            .collect::<Option<_>>()?;
        let mut found = Self {
            poles,
            static_gains: Vec::new(),
            cost: 0.0,
            normal: DMatrix::zeros(unknowns, unknowns),
            right: DVector::zeros(unknowns),
            own: Vec::new(),
        };
        for one in each {
            found.normal += one.normal;
            found.right += one.right;
            found.cost += one.cost;
            found.static_gains.push(one.gains);
            found.own.push(one.own);
        }
        (found.cost.is_finite()).then_some(found)
    }

    fn moved(&self, step: &DVector<f64>, share: f64, damping: Damping) -> Vec<Pole> {
        let unknowns = damping.unknowns();
        let moved = |(k, pole): (usize, &Pole)| Pole {
            omega_rad_s: pole.omega_rad_s * (share * step[unknowns * k]).exp(),
            damping_ratio: match damping {
                Damping::None => 0.0,
                Damping::Small => pole.damping_ratio + share * step[unknowns * k + 1],
            },
        };
        self.poles.iter().enumerate().map(moved).collect()
    }

    /// Covariance of ln ω_k (and ζ_k), pole by pole, and then of the static gains, output by output,
    /// where each response has the deviation it claims.
    pub(super) fn covariance(&self) -> Option<DMatrix<f64>> {
        let (poles, modes) = (self.normal.nrows(), self.poles.len());
        let of_poles = self.normal.clone().cholesky()?.inverse();
        let size = poles + modes * self.own.len();
        let mut all = DMatrix::zeros(size, size);
        all.view_mut((0, 0), (poles, poles)).copy_from(&of_poles);
        // ∂gains/∂poles of the best gains.
        let slopes: Vec<DMatrix<f64>> =
            self.own.iter().map(|own| -own.factor.solve(&own.across)).collect();
        for (i, slope) in slopes.iter().enumerate() {
            let at = poles + i * modes;
            let with_poles = slope * &of_poles;
            all.view_mut((at, 0), (modes, poles)).copy_from(&with_poles);
            all.view_mut((0, at), (poles, modes)).copy_from(&with_poles.transpose());
            for (j, other) in slopes.iter().enumerate() {
                let mut block = &with_poles * other.transpose();
                if i == j {
                    block += self.own[i].factor.inverse();
                }
                all.view_mut((at, poles + j * modes), (modes, modes)).copy_from(&block);
            }
        }
        Some(all)
    }
}

/// `ψ_k = ω_k²/D_k` of all poles, then its slopes by ln ω_k and ζ_k pole by pole; real parts above
/// imaginary ones.
fn columns(data: &Weighted, poles: &[Pole], damping: Damping) -> DMatrix<f64> {
    let (points, count, unknowns) = (data.omega.len(), poles.len(), damping.unknowns());
    let mut columns = DMatrix::zeros(2 * points, count * (1 + unknowns));
    for (k, pole) in poles.iter().enumerate() {
        let w = pole.omega_rad_s;
        let square = w * w;
        for (i, &omega) in data.omega.iter().enumerate() {
            let inverse = 1.0 / pole.denominator(omega);
            let value = square * inverse;
            let by_log = value
                * (2.0
                    - inverse * Complex64::new(2.0 * square, 2.0 * pole.damping_ratio * w * omega));
            let by_damping = -value * inverse * Complex64::new(0.0, 2.0 * w * omega);
            let slopes = [by_log, by_damping];
            let all = std::iter::once((k, value)).chain(
                slopes
                    .into_iter()
                    .take(unknowns)
                    .enumerate()
                    .map(|(u, z)| (count + unknowns * k + u, z)),
            );
            for (column, z) in all {
                columns[(i, column)] = z.re;
                columns[(points + i, column)] = z.im;
            }
        }
    }
    columns
}

/// What one output says of the poles, its gains at their best.
struct OneOutput {
    gains: DVector<f64>,
    cost: f64,
    normal: DMatrix<f64>,
    right: DVector<f64>,
    own: Own,
}

impl OneOutput {
    fn new(data: &Weighted, output: &Output, columns: &DMatrix<f64>, count: usize) -> Option<Self> {
        let points = data.omega.len();
        let mut rows = columns.clone();
        for mut column in rows.column_iter_mut() {
            let (re, im) = column.as_mut_slice().split_at_mut(points);
            for ((re, im), weight) in re.iter_mut().zip(im).zip(&output.weights) {
                *re *= weight;
                *im *= weight;
            }
        }
        let value = |i: usize| {
            if i < points { output.weighted[i].re } else { output.weighted[i - points].im }
        };
        let measured = DVector::from_fn(2 * points, |i, _| value(i));
        let basis = rows.columns(0, count);
        let products = products(&rows);
        let factor = products.view((0, 0), (count, count)).into_owned().cholesky()?;
        let gains = factor.solve(&basis.tr_mul(&measured));
        let left = measured - basis * &gains;
        // Slopes are those of the columns times the gains.
        let slopes = rows.columns_range(count..);
        let unknowns = slopes.ncols();
        let scale = DVector::from_fn(unknowns, |i, _| gains[i * count / unknowns]);
        let mut across = products.view((0, count), (count, unknowns)).into_owned();
        for (mut column, scale) in across.column_iter_mut().zip(&scale) {
            column *= *scale;
        }
        let normal = DMatrix::from_fn(unknowns, unknowns, |i, j| {
            products[(count + i, count + j)] * scale[i] * scale[j]
        });
        let eliminated = factor.l().solve_lower_triangular(&across)?;
        Some(Self {
            cost: left.norm_squared(),
            normal: normal - eliminated.tr_mul(&eliminated),
            // Left is across the basis: nothing of it is eliminated.
            right: slopes.tr_mul(&left).component_mul(&scale),
            gains,
            own: Own { factor, across },
        })
    }
}
