//! The offset and drift at which a signal follows the motor's motion best.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::even_signal::EvenSignal;
use super::regressors::{Follows, Regressors};

/// Order of the autoregressive model of the residual.
const ORDER: usize = 12;
/// Blocks of time whose scatter gives the standard errors.
const BLOCKS: usize = 12;
/// Added to the diagonal of the normal equations, as a share of its mean.
const RIDGE: f64 = 1e-9;
/// Largest change of offset in one step, in steps of the grid.
const FARTHEST: f64 = 2.0;
/// Largest change of drift in one step.
const MOST_DRIFT: f64 = 1e-3;
/// A smaller change of offset, in steps of the grid, ends the search.
const CONVERGED: f64 = 1e-3;
/// Rows for each regressor that a fit needs.
const ROWS_PER_REGRESSOR: usize = 4;

/// The clock of another log: its stamp is `offset_s + (1 + drift)·t` at the time t of the reference.
#[derive(Debug, Clone)]
pub(super) struct Fit {
    pub(super) offset_s: f64,
    pub(super) drift: f64,
    /// Standard error of the offset in the middle of the common time.
    pub(super) offset_std_s: f64,
    pub(super) drift_std: f64,
    /// Middle of the common time on the reference \[s\].
    pub(super) middle_s: f64,
    /// Length of the common time \[s\].
    pub(super) length_s: f64,
    pub(super) rows: usize,
    pub(super) regressors: usize,
    /// Share of the signal that follows.
    pub(super) explained: f64,
    /// Variance of what the fit cannot predict.
    pub(super) innovation: f64,
    /// Variance of what the past of the signal alone cannot predict.
    pub(super) innovation_alone: f64,
    /// Coefficients of the residual's autoregressive model, after 1.
    whitening: Vec<f64>,
}

/// How to fit.
#[derive(Debug, Clone, Copy)]
pub(super) struct Effort {
    pub(super) steps: usize,
    pub(super) with_drift: bool,
    /// Whether the residual is made white. The vibrations of the arm, which do not follow, then count less.
    pub(super) whitened: bool,
}

/// Linear equations of a step.
struct Step {
    offset_s: f64,
    drift: f64,
    middle_s: f64,
    fit: Fit,
}

/// Fits from an offset on; `None` if too little time is common.
pub(super) fn fit(
    motion: &Regressors<'_>,
    other: &EvenSignal,
    offset_s: f64,
    effort: Effort,
) -> Option<Fit> {
    let (mut offset_s, mut drift, mut whitening) = (offset_s, 0.0, Vec::new());
    let mut last = None;
    for k in 0..effort.steps {
        let step = step(motion, other, (offset_s, drift), &whitening, effort)?;
        let limit = FARTHEST * motion.step_s;
        let (change, tilt) =
            (step.offset_s.clamp(-limit, limit), step.drift.clamp(-MOST_DRIFT, MOST_DRIFT));
        offset_s += change - tilt * step.middle_s;
        drift += tilt;
        if effort.whitened && k > 0 {
            whitening.clone_from(&step.fit.whitening);
        }
        let is_done = k > 2 && change.abs() < CONVERGED * motion.step_s;
        last = Some(Fit { offset_s, drift, ..step.fit });
        if is_done {
            break;
        }
    }
    last
}

/// One step of Gauss and Newton: the regressors' weights, and the changes of offset and drift.
fn step(
    motion: &Regressors<'_>,
    other: &EvenSignal,
    (offset_s, drift): (f64, f64),
    whitening: &[f64],
    effort: Effort,
) -> Option<Step> {
    let with_drift = effort.with_drift;
    let margin_s = (motion.reach as f64 + 1.0) * motion.step_s;
    let (first_s, last_s) = (motion.motion.start_s + margin_s, motion.motion.end_s() - margin_s);
    let time = |k: &usize| (other.time_s(*k) - offset_s) / (1.0 + drift);
    let rows: Vec<usize> = (0..other.values.len())
        .filter(|k| (first_s..last_s).contains(&time(k)) && motion.holds(time(k)))
        .collect();
    let count = motion.count();
    if rows.len() < ROWS_PER_REGRESSOR * (count + 2) + whitening.len() {
        return None;
    }
    let middle_s = rows.iter().map(time).sum::<f64>() / rows.len() as f64;
    // The regressors, and their rates of change.
    let mut x = DMatrix::zeros(rows.len(), count + 1 + usize::from(with_drift));
    let mut rate = DMatrix::zeros(rows.len(), count);
    let (mut now, mut after, mut before) = (vec![0.0; count], vec![0.0; count], vec![0.0; count]);
    let half = 0.5 * motion.step_s;
    for (row, k) in rows.iter().enumerate() {
        let at = time(k);
        motion.write(at, &mut now);
        motion.write(at + half, &mut after);
        motion.write(at - half, &mut before);
        for column in 0..count {
            x[(row, column)] = now[column];
            rate[(row, column)] = (after[column] - before[column]) / motion.step_s;
        }
    }
    if motion.follows == Follows::Torque {
        // The sign of speed does not change in slip.
        rate.column_mut(3).fill(0.0);
    }
    let y = DVector::from_iterator(rows.len(), rows.iter().map(|k| other.values[*k]));
    let (whole, white_y) = (x.columns(0, count).into_owned(), filtered(&y, whitening));
    let weights = solve(&filtered_columns(&whole, whitening), &white_y)?.0;
    let slope = rate * weights;
    x.column_mut(count).copy_from(&(-&slope));
    if with_drift {
        let tilted = slope.iter().zip(&rows).map(|(s, k)| -s * (time(k) - middle_s));
        x.column_mut(count + 1).copy_from(&DVector::from_iterator(rows.len(), tilted));
    }
    let white_x = filtered_columns(&x, whitening);
    let (solution, inverse) = solve(&white_x, &white_y)?;
    let residual = &y - &x * &solution;
    let innovation = &white_y - &white_x * &solution;
    let covariance = robust(&white_x, &innovation, &inverse);
    let std = |k: usize| covariance[(k, k)].max(0.0).sqrt();
    let mean = y.mean();
    let about = y.map(|v| v - mean);
    let alone = filtered(&about, &autoregressive(&about));
    let variance = |v: &DVector<f64>| v.norm_squared() / v.len() as f64;
    let fit = Fit {
        offset_s,
        drift,
        offset_std_s: std(count),
        drift_std: if with_drift { std(count + 1) } else { 0.0 },
        middle_s,
        length_s: (other.step_s * (rows[rows.len() - 1] - rows[0]) as f64).max(other.step_s),
        rows: rows.len(),
        regressors: count,
        explained: 1.0 - residual.norm_squared() / about.norm_squared().max(f64::MIN_POSITIVE),
        innovation: variance(&innovation),
        innovation_alone: variance(&alone),
        whitening: autoregressive(&residual),
    };
    let drift = if with_drift { solution[count + 1] } else { 0.0 };
    Some(Step { offset_s: solution[count], drift, middle_s, fit })
}

/// The solution of a linear regression, and the inverse of its normal matrix.
fn solve(x: &DMatrix<f64>, y: &DVector<f64>) -> Option<(DVector<f64>, DMatrix<f64>)> {
    let scale: Vec<f64> =
        x.column_iter().map(|c| 1.0 / c.norm().max(f64::MIN_POSITIVE.sqrt())).collect();
    let mut scaled = x.clone();
    for (mut column, scale) in scaled.column_iter_mut().zip(&scale) {
        column *= *scale;
    }
    let mut normal = scaled.transpose() * &scaled;
    for k in 0..normal.ncols() {
        normal[(k, k)] += RIDGE;
    }
    let factors: Cholesky<f64, Dyn> = normal.cholesky()?;
    let scale = DVector::from_vec(scale);
    let solution = factors.solve(&scaled.tr_mul(y)).component_mul(&scale);
    let mut inverse = factors.inverse();
    for (mut column, outer) in inverse.column_iter_mut().zip(&scale) {
        column.component_mul_assign(&scale);
        column *= *outer;
    }
    solution.iter().all(|v| v.is_finite()).then_some((solution, inverse))
}

/// Covariance of the solution by the scatter between blocks of time.
fn robust(x: &DMatrix<f64>, residual: &DVector<f64>, inverse: &DMatrix<f64>) -> DMatrix<f64> {
    let mut scatter = DMatrix::zeros(x.ncols(), x.ncols());
    for block in 0..BLOCKS {
        let (first, end) = (block * x.nrows() / BLOCKS, (block + 1) * x.nrows() / BLOCKS);
        let score = x.rows(first, end - first).tr_mul(&residual.rows(first, end - first));
        scatter += &score * score.transpose();
    }
    let blocks = BLOCKS as f64;
    inverse * scatter * inverse * (blocks / (blocks - 1.0))
}

/// Coefficients a of the model y_k + Σ a_j·y_(k−j) = white noise, by the recursion of Levinson and Durbin.
fn autoregressive(y: &DVector<f64>) -> Vec<f64> {
    let n = y.len();
    if n <= ORDER {
        return Vec::new();
    }
    let correlation = |k: usize| y.rows(0, n - k).dot(&y.rows(k, n - k)) / n as f64;
    let r: Vec<f64> = (0..=ORDER).map(correlation).collect();
    let mut error = r[0] * (1.0 + 1e-6);
    if error <= 0.0 {
        return Vec::new();
    }
    let mut a: Vec<f64> = Vec::new();
    for k in 1..=ORDER {
        let sum: f64 = r[k] + a.iter().enumerate().map(|(j, a)| a * r[k - 1 - j]).sum::<f64>();
        let reflection = -sum / error;
        let reversed: Vec<f64> = a.iter().rev().copied().collect();
        a.iter_mut().zip(&reversed).for_each(|(a, b)| *a += reflection * b);
        a.push(reflection);
        error *= 1.0 - reflection * reflection;
        if error <= 0.0 {
            break;
        }
    }
    a
}

fn filtered(y: &DVector<f64>, a: &[f64]) -> DVector<f64> {
    let value = |k: usize| y[k] + a.iter().enumerate().map(|(j, a)| a * y[k - 1 - j]).sum::<f64>();
    DVector::from_iterator(y.len() - a.len(), (a.len()..y.len()).map(value))
}

fn filtered_columns(x: &DMatrix<f64>, a: &[f64]) -> DMatrix<f64> {
    let (p, rows) = (a.len(), x.nrows() - a.len());
    let mut out = x.rows(p, rows).into_owned();
    for (mut column, from) in out.column_iter_mut().zip(x.column_iter()) {
        for (j, a) in a.iter().enumerate() {
            column.axpy(*a, &from.rows(p - 1 - j, rows), 1.0);
        }
    }
    out
}
