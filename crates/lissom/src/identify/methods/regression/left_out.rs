//! The regression without each run in turn: which run the others do not predict.

use nalgebra::{DMatrix, DVector};

use crate::identify::methods::regression::normal::{Cluster, Term, solve};

/// Most runs for which this is done.
const RUNS_MOST: usize = 64;
/// With fewer runs none is beside others.
const RUNS_LEAST: usize = 3;

/// The solution without one run.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct RunLeftOut {
    /// Which of the runs used.
    pub(crate) run: usize,
    /// Share of its torque that the others' solution leaves, over the share that it leaves of theirs.
    pub(crate) residual: f64,
    /// The terms without it.
    pub(crate) value: DVector<f64>,
    /// Their covariance.
    pub(crate) covariance: DMatrix<f64>,
}

/// One for each run of three or more.
pub(super) fn runs_left_out(clusters: &[Cluster], terms: &[Term]) -> Vec<RunLeftOut> {
    let sums = by_run(clusters);
    let mut runs: Vec<usize> = sums.iter().map(|c| c.run).collect();
    runs.dedup();
    if !(RUNS_LEAST..=RUNS_MOST).contains(&runs.len()) {
        return Vec::new();
    }
    let without = |&run: &usize| {
        let (own, others): (Vec<Cluster>, Vec<Cluster>) =
            sums.iter().cloned().partition(|c| c.run == run);
        let solution = solve(&others, terms)?;
        let residual = left(&own, terms, &solution.value) / left(&others, terms, &solution.value);
        let told = residual.is_finite() && !solution.inseparable.iter().any(|lost| *lost);
        let (value, covariance) = (solution.value, solution.covariance);
        told.then_some(RunLeftOut { run, residual, value, covariance })
    };
    runs.iter().filter_map(without).collect()
}

/// Sums by run and direction, ascending in the run.
fn by_run(clusters: &[Cluster]) -> Vec<Cluster> {
    let mut sums: Vec<Cluster> = Vec::new();
    for cluster in clusters.iter().filter(|c| c.rows > 0) {
        let same =
            |c: &&mut Cluster| c.run == cluster.run && c.sign.total_cmp(&cluster.sign).is_eq();
        match sums.iter_mut().rev().take(3).find(same) {
            Some(sum) => sum.merge(cluster),
            None => sums.push(cluster.clone()),
        }
    }
    sums
}

/// ‖y − X·q‖/‖y‖.
fn left(clusters: &[Cluster], terms: &[Term], value: &DVector<f64>) -> f64 {
    let (mut left, mut power) = (0.0, 0.0);
    for cluster in clusters {
        let last = cluster.products.ncols() - 1;
        let mut taken = DVector::zeros(last + 1);
        for (term, value) in terms.iter().zip(value) {
            taken[term.column()] += term.factor(cluster.sign) * value;
        }
        taken[last] = -1.0;
        left += taken.dot(&(&cluster.products * &taken));
        power += cluster.products[(last, last)];
    }
    (left.max(0.0) / power).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Six runs of y = 2·x + 0.3, one of which has twice the slope.
    #[test]
    fn the_run_that_differs_is_the_one_the_others_do_not_predict() {
        let mut clusters = Vec::new();
        for run in 0..6_u32 {
            let slope = if run == 4 { 4.0 } else { 2.0 };
            let mut cluster = Cluster::new(run as usize, 1.0, 3);
            for k in 0..50 {
                let x = f64::from(7 * run + k).sin();
                let noise = 0.01 * f64::from(13 * k + run).cos();
                cluster.add(&[x, 1.0, slope * x + 0.3 + noise]);
            }
            clusters.push(cluster);
        }
        let found = runs_left_out(&clusters, &[Term::Plain(0), Term::Plain(1)]);
        let worst = found.iter().max_by(|a, b| a.residual.total_cmp(&b.residual)).unwrap();
        assert_eq!((found.len(), worst.run), (6, 4));
        assert!(worst.residual > 20.0 && (worst.value[0] - 2.0).abs() < 0.01, "{worst:?}");
        assert!(found.iter().filter(|r| r.run != 4).all(|r| r.residual < 3.0));
    }
}
