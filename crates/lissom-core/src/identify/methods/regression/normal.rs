//! Least squares from sums by cluster, with a covariance that holds for coloured residuals.

use crate::registers::widest;
use nalgebra::{DMatrix, DVector};

use crate::identify::methods::regression::cluster_covariance::{larger, of_few, sandwich};
use crate::identify::methods::regression::thresholds::{
    FEW_CLUSTERS, INSEPARABLE_WEIGHT, MOTION_LEAST, NOISE_FILLS, SAME_COLUMN,
};
use crate::identify::prepare::window::{WINDOW_STEP, Window};

/// Windows in a block of [`Cluster::blocks`].
const WINDOWS_IN_BLOCK: usize = 40;
/// Smallest pivot of scaled normal equations that a Cholesky factor is trusted with.
const PIVOT_LEAST: f64 = 1e-4;

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
    /// What the sensors' noise adds to these, in expectation.
    pub(crate) noise: DMatrix<f64>,
}

/// An equation, window by window.
pub(crate) trait Rows {
    /// Makes `row` that of the window which begins at sample `k`: regressors first, right side last.
    fn fill(&self, k: usize, row: &mut Vec<f64>);
}

impl Cluster {
    pub(crate) fn new(run: usize, sign: f64, columns: usize) -> Self {
        let zeros = DMatrix::zeros(columns, columns);
        Self { run, sign, rows: 0, noise: zeros.clone(), products: zeros }
    }

    /// Rows of windows all along a run of so many samples, whether it sticks or not, in blocks that the covariance takes as one.
    pub(super) fn blocks(
        run: usize,
        samples: usize,
        window: &Window,
        (equation, noise): (&impl Rows, &DMatrix<f64>),
    ) -> Vec<Self> {
        let step = ((window.len() as f64 * WINDOW_STEP) as usize).max(1);
        let starts: Vec<usize> = (0..samples - window.len()).step_by(step).collect();
        let block = |starts: &[usize]| {
            let mut block = Self::new(run, 0.0, noise.ncols());
            block.add_windows(starts.iter().copied(), equation, noise);
            block
        };
        starts.chunks(WINDOWS_IN_BLOCK).map(block).collect()
    }

    /// Adds the rows of windows from `starts` on, to each of whose products the sensors' noise adds `noise`.
    ///
    /// Compiled for the widest registers that there are.
    pub(crate) fn add_windows(
        &mut self,
        starts: impl Iterator<Item = usize>,
        equation: &impl Rows,
        noise: &DMatrix<f64>,
    ) {
        let before = self.rows;
        widest(|| self.add_each(starts, equation));
        let added = (self.rows - before) as f64;
        self.noise.zip_apply(noise, |sum, of_row| *sum += of_row * added);
    }

    /// Takes out of the products of a column with the right side what noise that both have adds.
    pub(crate) fn take_out_noise_of_right(&mut self, column: usize) {
        let right = self.products.ncols() - 1;
        self.products[(column, right)] -= self.noise[(column, right)];
        self.products[(right, column)] -= self.noise[(right, column)];
    }

    /// Adds the rows of another of the same columns.
    pub(crate) fn merge(&mut self, other: &Self) {
        self.products += &other.products;
        self.noise += &other.noise;
        self.rows += other.rows;
    }

    #[inline(always)]
    fn add_each(&mut self, starts: impl Iterator<Item = usize>, equation: &impl Rows) {
        let mut row = Vec::with_capacity(self.products.ncols());
        for k in starts {
            equation.fill(k, &mut row);
            self.add(&row);
        }
    }

    /// Adds one row, regressors first, right side last.
    #[inline(always)]
    pub(crate) fn add(&mut self, row: &[f64]) {
        let height = self.products.nrows();
        let columns = self.products.as_mut_slice().chunks_exact_mut(height);
        for (column, &a) in columns.zip(row) {
            column.iter_mut().zip(row).for_each(|(sum, b)| *sum += a * b);
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
}

impl Term {
    pub(crate) fn column(self) -> usize {
        match self {
            Self::Plain(c) | Self::Signed(c) => c,
        }
    }

    pub(crate) fn factor(self, sign: f64) -> f64 {
        match self {
            Self::Plain(_) => 1.0,
            Self::Signed(_) => sign,
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
    /// `‖y − X·q‖²·(N⁻¹)_ii` of each term q_i. Divided by q_i² it is the share by which q_i is larger in the reverse
    /// regression, of the regressor on y, which holds if the residual acts on the regressor and not on y.
    pub(crate) turned_round: DVector<f64>,
    /// Rows used.
    pub(crate) rows: usize,
    /// Clusters with rows.
    pub(crate) clusters: usize,
}

/// Normal equations of some terms.
pub(crate) struct NormalSums {
    normal: DMatrix<f64>,
    /// What the sensors' noise adds to these, in expectation.
    noise: DMatrix<f64>,
    right: DVector<f64>,
    /// Σ y².
    power: f64,
    rows: usize,
}

impl NormalSums {
    /// Of products and noise that were summed elsewhere; `None` without rows or a right side of zero.
    pub(crate) fn new(
        normal: DMatrix<f64>,
        noise: DMatrix<f64>,
        right: DVector<f64>,
        power: f64,
        rows: usize,
    ) -> Option<Self> {
        (rows > 0 && power > 0.0).then_some(Self { normal, noise, right, power, rows })
    }

    /// From the clusters' sums; `None` without rows or a right side of zero.
    pub(crate) fn of(clusters: &[Cluster], terms: &[Term]) -> Option<Self> {
        let p = terms.len();
        let right_column = clusters.first()?.products.ncols() - 1;
        let rows: usize = clusters.iter().map(|c| c.rows).sum();
        let power: f64 = clusters.iter().map(|c| c.products[(right_column, right_column)]).sum();
        if rows == 0 || power <= 0.0 {
            return None;
        }
        let factors = TermFactors::of(terms);
        let mut normal: DMatrix<f64> = DMatrix::zeros(p, p);
        let mut noise = normal.clone();
        let mut right = DVector::zeros(p);
        for part in factors.parts(clusters) {
            for j in 0..p {
                right[j] += part.right(j);
                for i in 0..p {
                    normal[(i, j)] += part.normal(i, j);
                    noise[(i, j)] += part.noise(i, j);
                }
            }
        }
        Some(Self { normal, noise, right, power, rows })
    }

    fn relative_residual_of(&self, value: &DVector<f64>) -> f64 {
        let left = self.power - 2.0 * value.dot(&self.right) + value.dot(&(&self.normal * value));
        (left.max(0.0) / self.power).sqrt()
    }
}

/// Estimates whose scores are to be found: `X'(y − X·value) + out·(noise·taken)` of each cluster.
pub(crate) struct ScoredEstimates {
    pub(crate) value: DVector<f64>,
    pub(crate) out: DMatrix<f64>,
    pub(crate) taken: DVector<f64>,
}

/// Scores of the clusters, and their sums in each run: a column each.
pub(crate) struct Scores {
    pub(crate) by_cluster: DMatrix<f64>,
    pub(crate) by_run: DMatrix<f64>,
    /// Normal equations of each cluster where they are few, for [`of_few`].
    pub(crate) normals: Vec<DMatrix<f64>>,
}

/// Solves for `terms` from the clusters' sums; `None` without rows or a right side of zero.
///
/// The sensors' noise is taken out of the regressors' products, in those directions that it does not
/// fill: in the others the estimates fall short by its share there, and what that may be counts in their
/// covariance.
pub(crate) fn solve(clusters: &[Cluster], terms: &[Term]) -> Option<Solution> {
    let p = terms.len();
    let sums = NormalSums::of(clusters, terms)?;
    let factors = TermFactors::of(terms);
    let parts = || factors.parts(clusters);
    solve_sums(&sums, |ScoredEstimates { value, out, taken }| {
        let mut by_cluster = DMatrix::zeros(p, parts().count());
        let runs = parts().map(|part| part.cluster.run).max().unwrap_or(0) + 1;
        let mut by_run = DMatrix::zeros(p, runs);
        let mut of_noise = DVector::zeros(p);
        for (part, mut score) in parts().zip(by_cluster.column_iter_mut()) {
            for i in 0..p {
                let explained: f64 = (0..p).map(|j| part.normal(i, j) * value[j]).sum();
                score[i] = part.right(i) - explained;
                of_noise[i] = (0..p).map(|j| part.noise(i, j) * taken[j]).sum();
            }
            score.gemv(1.0, out, &of_noise, 1.0);
            let mut of_run = by_run.column_mut(part.cluster.run);
            of_run += score;
        }
        let few = parts().count() <= FEW_CLUSTERS;
        let of_part = |part: NormalPart<'_>| DMatrix::from_fn(p, p, |i, j| part.normal(i, j));
        let normals = parts().take_while(|_| few).map(of_part).collect();
        Scores { by_cluster, by_run, normals }
    })
}

/// The estimates of [`solve`] alone.
pub(crate) fn values(clusters: &[Cluster], terms: &[Term]) -> Option<DVector<f64>> {
    Some(Solved::of(&NormalSums::of(clusters, terms)?)?.value)
}

/// The least-squares solution of normal equations alone.
///
/// Where noise is a small part of all products, its expectation is subtracted and a Cholesky factor solves the rest;
/// otherwise as in [`solve`].
pub(crate) fn values_of(sums: &NormalSums) -> Option<DVector<f64>> {
    let scale = sums.normal.diagonal().map(|v| 1.0 / v.max(f64::MIN_POSITIVE).sqrt());
    let p = scale.len();
    let scaled = |m: &DMatrix<f64>| DMatrix::from_fn(p, p, |i, j| m[(i, j)] * scale[i] * scale[j]);
    let factor = scaled(&(&sums.normal - &sums.noise)).cholesky();
    let well = factor.filter(|f| f.l_dirty().diagonal().iter().all(|d| *d > PIVOT_LEAST));
    match well {
        Some(factor) => Some(factor.solve(&sums.right.component_mul(&scale)).component_mul(&scale)),
        None => Some(Solved::of(sums)?.value),
    }
}

/// Normal equations solved, and what the covariance is made of.
struct Solved {
    value: DVector<f64>,
    lost: Vec<DVector<f64>>,
    inseparable: Vec<bool>,
    /// Directions in which all products are one, noise has a share of each, and what that stretches each by.
    directions: DMatrix<f64>,
    shares: DVector<f64>,
    stretched: DVector<f64>,
    inverse: DMatrix<f64>,
    out: DMatrix<f64>,
}

impl Solved {
    fn of(sums: &NormalSums) -> Option<Self> {
        let NormalSums { normal, noise, right, .. } = sums;
        let p = right.len();
        let scale = DVector::from_fn(p, |i, _| normal[(i, i)].max(f64::MIN_POSITIVE).sqrt());
        let scaled = DMatrix::from_fn(p, p, |i, j| normal[(i, j)] / (scale[i] * scale[j]));
        let eigen = scaled.symmetric_eigen();
        let largest = eigen.eigenvalues.max();
        if !(largest > 0.0 && largest.is_finite()) {
            return None;
        }
        let mut inseparable: Vec<bool> = (0..p).map(|i| normal[(i, i)] <= 0.0).collect();
        let (mut kept, mut lost) = (Vec::new(), Vec::new());
        for (k, &lambda) in eigen.eigenvalues.iter().enumerate() {
            let v = eigen.eigenvectors.column(k);
            if lambda > SAME_COLUMN * largest {
                kept.push(v.component_div(&scale) / lambda.sqrt());
            } else {
                let seen = (0..p).filter(|&i| v[i].abs() > INSEPARABLE_WEIGHT);
                seen.for_each(|i| inseparable[i] = true);
                lost.push(v.component_div(&scale));
            }
        }
        let white = DMatrix::from_columns(&kept);
        let shares = (white.transpose() * noise * &white).symmetric_eigen();
        let directions = &white * &shares.eigenvectors;
        let shares = shares.eigenvalues;
        let taken_out = shares.map(|share| if share < NOISE_FILLS { share } else { 0.0 });
        let stretched = taken_out.map(|share| 1.0 / (1.0 - share));
        let inverse = &directions * &DMatrix::from_diagonal(&stretched) * directions.transpose();
        let value: DVector<f64> = &inverse * right;
        let out = DMatrix::from_diagonal(&taken_out.map(|share| f64::from(share > 0.0)));
        let out = normal * &directions * out * directions.transpose();
        Some(Self { value, lost, inseparable, directions, shares, stretched, inverse, out })
    }
}

/// Solves normal equations whose clusters have the `scores` that estimates give them.
pub(crate) fn solve_sums(
    sums: &NormalSums,
    scores: impl FnOnce(&ScoredEstimates) -> Scores,
) -> Option<Solution> {
    let Solved { value, lost, inseparable, directions, shares, stretched, inverse, out } =
        Solved::of(sums)?;
    let p = value.len();
    let taken = out.transpose() * &value;
    let estimates = ScoredEstimates { value, out, taken };
    let Scores { by_cluster: scores, by_run, normals } = scores(&estimates);
    let value = estimates.value;
    let by_cluster = if normals.is_empty() {
        sandwich(&inverse, &scores)
    } else {
        let white = &directions * DMatrix::from_diagonal(&stretched).map(f64::sqrt);
        of_few(&white, &scores, &normals)
    };
    let present = by_run.column_iter().filter(|g| g.norm() > 0.0).count();
    // Fewer runs than this say little of their own scatter.
    let mut covariance = if present > p + 1 {
        larger(&by_cluster, &sandwich(&inverse, &by_run))
    } else {
        by_cluster
    };
    for (k, &share) in shares.iter().enumerate().filter(|(_, s)| **s >= NOISE_FILLS) {
        let direction = directions.column(k);
        let short = direction.dot(&sums.right) * share / (1.0 - share).max(MOTION_LEAST);
        covariance.ger(short * short, &direction, &direction, 1.0);
    }
    let relative_residual = sums.relative_residual_of(&value);
    Some(Solution {
        relative_residual,
        turned_round: inverse.diagonal() * (relative_residual.powi(2) * sums.power),
        value,
        covariance,
        lost,
        inseparable,
        rows: sums.rows,
        clusters: scores.ncols(),
    })
}

/// Columns of some terms, and their factors backward, without a direction and forward.
struct TermFactors {
    columns: Vec<usize>,
    factors: [Vec<f64>; 3],
}

impl TermFactors {
    fn of(terms: &[Term]) -> Self {
        let columns = terms.iter().map(|term| term.column()).collect();
        let factors = [-1.0, 0.0, 1.0].map(|sign| terms.iter().map(|t| t.factor(sign)).collect());
        Self { columns, factors }
    }

    /// What each cluster with rows adds.
    fn parts<'a>(&'a self, clusters: &'a [Cluster]) -> impl Iterator<Item = NormalPart<'a>> {
        let with_rows = clusters.iter().filter(|c| c.rows > 0);
        with_rows.map(|cluster| NormalPart::of(cluster, &self.columns, &self.factors))
    }
}

/// What a cluster adds to the normal equations of some terms.
struct NormalPart<'a> {
    cluster: &'a Cluster,
    columns: &'a [usize],
    factors: &'a [f64],
}

impl<'a> NormalPart<'a> {
    /// With the terms' factors backward, without a direction and forward.
    fn of(cluster: &'a Cluster, columns: &'a [usize], factors: &'a [Vec<f64>; 3]) -> Self {
        let [backward, none, forward] = factors;
        let factors = match cluster.sign {
            s if s > 0.0 => forward,
            s if s < 0.0 => backward,
            _ => none,
        };
        Self { cluster, columns, factors }
    }

    fn normal(&self, i: usize, j: usize) -> f64 {
        self.of_terms(&self.cluster.products, i, j)
    }

    fn noise(&self, i: usize, j: usize) -> f64 {
        self.of_terms(&self.cluster.noise, i, j)
    }

    fn right(&self, i: usize) -> f64 {
        let products = &self.cluster.products;
        products[(self.columns[i], products.ncols() - 1)] * self.factors[i]
    }

    fn of_terms(&self, products: &DMatrix<f64>, i: usize, j: usize) -> f64 {
        products[(self.columns[i], self.columns[j])] * self.factors[i] * self.factors[j]
    }
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

    /// y = 2·x + 0.3·z seen with noise of deviation `noise` in x: the sums of many rows, in expectation.
    fn noisy(noise: f64) -> Vec<Cluster> {
        (0..20)
            .map(|c| {
                let mut cluster = Cluster::new(0, 1.0, 3);
                for r in 0..50 {
                    let (x, z) = (f64::from(c * 50 + r).sin(), f64::from(c * 50 + r).cos());
                    cluster.add(&[x, z, 2.0 * x + 0.3 * z]);
                }
                let share = 50.0 * noise * noise;
                cluster.products[(0, 0)] += share;
                cluster.noise[(0, 0)] = share;
                cluster
            })
            .collect()
    }
    const BOTH: [Term; 2] = [Term::Plain(0), Term::Plain(1)];

    #[test]
    fn noise_in_a_regressor_does_not_shrink_its_estimate() {
        let s = solve(&noisy(0.5), &BOTH).unwrap();
        assert!((s.value[0] - 2.0).abs() < 1e-9 && (s.value[1] - 0.3).abs() < 1e-9, "{}", s.value);
    }

    #[test]
    fn a_regressor_that_is_noise_falls_short_and_says_so() {
        let s = solve(&noisy(3.0), &BOTH).unwrap();
        let (short, std) = (2.0 - s.value[0], s.covariance[(0, 0)].sqrt());
        assert!(short > 1.0 && short < 1.5 * std, "{} {std}", s.value);
        assert!((s.value[1] - 0.3).abs() < 0.1);
    }
}
