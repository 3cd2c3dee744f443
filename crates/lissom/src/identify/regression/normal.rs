//! Least squares from sums by cluster, with a covariance that holds for coloured residuals.

use nalgebra::{DMatrix, DVector};

/// Smallest eigenvalue of the scaled normal matrix, relative to the largest, that still counts:
/// below it two columns are the same to 1e-5.
const RANK: f64 = 1e-10;
/// Weight in a direction of deficient rank from which on a parameter is called inseparable.
const SHARE: f64 = 0.2;

/// Products of the columns `[x_1 … x_p, y]`, summed over the rows of one cluster.
#[derive(Debug, Clone)]
pub(crate) struct Cluster {
    /// Run it belongs to.
    pub(crate) run: usize,
    /// Direction of slip, +1 or −1 (0 where it has no meaning).
    pub(crate) sign: f64,
    /// Rows summed.
    pub(crate) rows: usize,
    /// (p + 1)² products.
    pub(crate) products: DMatrix<f64>,
}

impl Cluster {
    pub(crate) fn new(run: usize, sign: f64, columns: usize) -> Self {
        Self { run, sign, rows: 0, products: DMatrix::zeros(columns, columns) }
    }

    /// Adds one row, regressors first, right side last.
    pub(crate) fn add(&mut self, row: &[f64]) {
        for (i, &a) in row.iter().enumerate() {
            for (j, &b) in row[..=i].iter().enumerate() {
                self.products[(i, j)] += a * b;
                if i != j {
                    self.products[(j, i)] += a * b;
                }
            }
        }
        self.rows += 1;
    }
}

/// How a parameter's regressor comes from a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Term {
    /// The column itself.
    Plain(usize),
    /// Times the direction of slip.
    Signed(usize),
    /// In forward phases only.
    Forward(usize),
    /// In backward phases only.
    Backward(usize),
}

impl Term {
    pub(crate) fn column(self) -> usize {
        match self {
            Self::Plain(c) | Self::Signed(c) | Self::Forward(c) | Self::Backward(c) => c,
        }
    }
    pub(crate) fn factor(self, sign: f64) -> f64 {
        match self {
            Self::Plain(_) => 1.0,
            Self::Signed(_) => sign,
            Self::Forward(_) => f64::from(sign > 0.0),
            Self::Backward(_) => f64::from(sign < 0.0),
        }
    }
}

/// A least-squares solution.
#[derive(Debug, Clone)]
pub(crate) struct Solution {
    /// Parameters, one a term.
    pub(crate) value: DVector<f64>,
    /// Covariance: clusters and runs each taken as independent, the larger variance of the two.
    pub(crate) covariance: DMatrix<f64>,
    /// Changes of all terms, up to a factor, that the rows do not show.
    pub(crate) lost: Vec<DVector<f64>>,
    /// Terms that the rows cannot tell from others.
    pub(crate) inseparable: Vec<bool>,
    /// ‖y − X·q‖/‖y‖.
    pub(crate) relative_residual: f64,
    /// Rows used.
    pub(crate) rows: usize,
    /// Clusters with rows.
    pub(crate) clusters: usize,
}

/// Solves for `terms` from the clusters' sums; `None` without rows or a right side of zero.
pub(crate) fn solve(clusters: &[Cluster], terms: &[Term]) -> Option<Solution> {
    let p = terms.len();
    let right_column = clusters.first()?.products.ncols() - 1;
    let parts: Vec<(usize, DMatrix<f64>, DVector<f64>)> = clusters
        .iter()
        .filter(|c| c.rows > 0)
        .map(|c| {
            let f = |t: &Term| t.factor(c.sign);
            let x = DMatrix::from_fn(p, p, |i, j| {
                c.products[(terms[i].column(), terms[j].column())] * f(&terms[i]) * f(&terms[j])
            });
            let y = DVector::from_fn(p, |i, _| {
                c.products[(terms[i].column(), right_column)] * f(&terms[i])
            });
            (c.run, x, y)
        })
        .collect();
    let rows: usize = clusters.iter().map(|c| c.rows).sum();
    let power: f64 = clusters.iter().map(|c| c.products[(right_column, right_column)]).sum();
    if rows == 0 || power <= 0.0 {
        return None;
    }
    let normal = parts.iter().fold(DMatrix::zeros(p, p), |sum, part| sum + &part.1);
    let right = parts.iter().fold(DVector::zeros(p), |sum, part| sum + &part.2);
    let scale = DVector::from_fn(p, |i, _| normal[(i, i)].max(f64::MIN_POSITIVE).sqrt());
    let scaled = DMatrix::from_fn(p, p, |i, j| normal[(i, j)] / (scale[i] * scale[j]));
    let eigen = scaled.symmetric_eigen();
    let largest = eigen.eigenvalues.max();
    if !(largest > 0.0 && largest.is_finite()) {
        return None;
    }
    let mut inseparable: Vec<bool> = (0..p).map(|i| normal[(i, i)] <= 0.0).collect();
    let mut inverse = DMatrix::zeros(p, p);
    let mut lost = Vec::new();
    for (k, &lambda) in eigen.eigenvalues.iter().enumerate() {
        let v = eigen.eigenvectors.column(k);
        if lambda > RANK * largest {
            inverse += v * v.transpose() / lambda;
        } else {
            (0..p).filter(|&i| v[i].abs() > SHARE).for_each(|i| inseparable[i] = true);
            lost.push(v.component_div(&scale));
        }
    }
    let inverse = DMatrix::from_fn(p, p, |i, j| inverse[(i, j)] / (scale[i] * scale[j]));
    let value: DVector<f64> = &inverse * &right;

    let by_cluster = sandwich(&inverse, parts.iter().map(|(_, x, y)| y - x * &value));
    let runs = parts.iter().map(|part| part.0).max().unwrap_or(0) + 1;
    let mut by_run = vec![DVector::zeros(p); runs];
    for (run, x, y) in &parts {
        by_run[*run] += y - x * &value;
    }
    let present = by_run.iter().filter(|g| g.norm() > 0.0).count();
    // Fewer runs than this say little of their own scatter.
    let covariance = if present > p + 1 {
        larger(&by_cluster, &sandwich(&inverse, by_run.into_iter()))
    } else {
        by_cluster
    };
    let left = power - 2.0 * value.dot(&right) + value.dot(&(&normal * &value));
    Some(Solution {
        value,
        covariance,
        lost,
        inseparable,
        relative_residual: (left.max(0.0) / power).sqrt(),
        rows,
        clusters: parts.len(),
    })
}

/// `N⁻¹·(Σ g·gᵀ)·N⁻¹` with g the score of each group, and C/(C − 1) for their number.
fn sandwich(inverse: &DMatrix<f64>, scores: impl Iterator<Item = DVector<f64>>) -> DMatrix<f64> {
    let p = inverse.nrows();
    let mut middle = DMatrix::zeros(p, p);
    let mut groups = 0.0_f64;
    for g in scores {
        middle.ger(1.0, &g, &g, 1.0);
        groups += 1.0;
    }
    inverse * middle * inverse * (groups / (groups - 1.0).max(1.0))
}

/// The first covariance, stretched where the second has the larger variance.
fn larger(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    let p = a.nrows();
    let stretch: Vec<f64> = (0..p)
        .map(|i| {
            if b[(i, i)] > a[(i, i)] && a[(i, i)] > 0.0 {
                (b[(i, i)] / a[(i, i)]).sqrt()
            } else {
                1.0
            }
        })
        .collect();
    DMatrix::from_fn(p, p, |i, j| a[(i, j)] * stretch[i] * stretch[j])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn clusters(both_directions: bool) -> Vec<Cluster> {
        (0..10)
            .map(|c| {
                let sign = if both_directions && c % 2 == 1 { -1.0 } else { 1.0 };
                let mut cluster = Cluster::new(0, sign, 3);
                for r in 0..5 {
                    let x = f64::from(c * 5 + r).sin();
                    // y = 2·x + 0.3·sign + 0.1
                    cluster.add(&[x, 1.0, 2.0 * x + 0.3 * sign + 0.1]);
                }
                cluster
            })
            .collect()
    }
    const TERMS: [Term; 3] = [Term::Plain(0), Term::Signed(1), Term::Plain(1)];

    #[test]
    fn exact_rows_are_solved_exactly() {
        let s = solve(&clusters(true), &TERMS).unwrap();
        for (found, expected) in s.value.iter().zip([2.0, 0.3, 0.1]) {
            assert!((found - expected).abs() < 1e-12);
        }
        assert!(s.relative_residual < 1e-7 && s.inseparable.iter().all(|i| !i));
    }

    #[test]
    fn one_direction_cannot_tell_friction_from_a_load() {
        let s = solve(&clusters(false), &TERMS).unwrap();
        assert_eq!(s.inseparable, [false, true, true]);
        // Friction up and the load down by as much, or the other way round.
        let [lost] = &s.lost[..] else { panic!("{:?}", s.lost) };
        assert!((lost[1] + lost[2]).abs() < 1e-9 * lost[1].abs() && lost[0].abs() < 1e-9);
        assert!((s.value[0] - 2.0).abs() < 1e-12);
    }
}
