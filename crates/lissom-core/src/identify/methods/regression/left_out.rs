//! The regression without each run in turn: finds a run that the others do not predict.

use nalgebra::{DMatrix, DVector};

use crate::identify::methods::regression::normal::{Cluster, Term, solve};
use crate::identify::methods::regression::run_difference::{RunDifference, RunSums};
use crate::identify::methods::regression::thresholds::{
    UNLIKE_MISFIT, UNLIKE_NEXT, UNLIKE_NEXT_OF_FASTEST, UNLIKE_SPOILS, UNLIKE_USUAL,
};

use crate::identify::thresholds::PRESENT;
use crate::record::Run;

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
    /// Share of the run's torque by which the others' solution, moved as far as its standard errors allow, differs from the
    /// run's own.
    pub(crate) misfit: f64,
    /// Whether no other run is as fast, or none is as slow.
    pub(crate) fastest_or_slowest: bool,
    /// What is different in it.
    pub(crate) difference: RunDifference,
}

/// The run that is unlike all others: their parameters describe it worst, its misfit is large, and far above the usual one and
/// the next. Or they leave far more of its torque than of theirs: such a run may spoil the parameters that all others are
/// compared with.
pub(crate) fn unlike_others(runs: &[RunLeftOut]) -> Option<&RunLeftOut> {
    let spoils = worst(runs, |r| r.residual).filter(|(run, _, next)| {
        (!run.fastest_or_slowest || run.difference.is_gross())
            && run.residual > UNLIKE_SPOILS * next
    });
    let alone = || {
        worst(runs, |r| r.misfit).filter(|(run, usual, next)| {
            let beyond = if run.fastest_or_slowest { UNLIKE_NEXT_OF_FASTEST } else { UNLIKE_NEXT };
            run.misfit > UNLIKE_MISFIT
                && run.misfit > UNLIKE_USUAL * usual
                && run.misfit > beyond * next
        })
    };
    spoils.or_else(alone).map(|(run, ..)| run)
}

/// The run with the largest value, the median of the other values, and the largest of these.
fn worst(runs: &[RunLeftOut], of: impl Fn(&RunLeftOut) -> f64) -> Option<(&RunLeftOut, f64, f64)> {
    let worst = runs.iter().max_by(|a, b| of(a).total_cmp(&of(b)))?;
    let mut others: Vec<f64> = runs.iter().filter(|r| r.run != worst.run).map(&of).collect();
    others.sort_by(f64::total_cmp);
    Some((worst, *others.get(others.len() / 2)?, *others.last()?))
}

/// One for each run of three or more, of so many rad/s each.
pub(super) fn runs_left_out(
    clusters: &[Cluster],
    terms: &[Term],
    speeds: &[f64],
) -> Vec<RunLeftOut> {
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
        let phases = clusters.iter().filter(|c| c.run == run && c.rows > 0).count();
        let sums = RunSums::of(&own, terms, phases);
        let of_others = left(&others, terms, &solution.value);
        let own_left = sums.share_left(&solution.value);
        let residual = own_left / of_others;
        let told = residual.is_finite() && !solution.inseparable.iter().any(|lost| *lost);
        let (value, covariance) = (solution.value, solution.covariance);
        // A run that is the only one to show a parameter is not unlike the others: these may move towards it by so many of
        // their standard errors.
        let wide = &covariance * PRESENT.powi(2);
        let misfit = sums.misfit(&value, &wide, of_others).unwrap_or(0.0);
        let difference = sums.difference(&value, own_left, of_others);
        let beside = || speeds.iter().enumerate().filter(|(i, _)| *i != run).map(|(_, s)| *s);
        let fastest_or_slowest =
            beside().all(|s| s < speeds[run]) || beside().all(|s| s > speeds[run]);
        told.then_some(RunLeftOut {
            run,
            residual,
            value,
            covariance,
            misfit,
            fastest_or_slowest,
            difference,
        })
    };
    runs.iter().filter_map(without).collect()
}

/// Speed, root mean square.
pub(super) fn rms_speed(run: &Run) -> f64 {
    let sum: f64 = run.motor().windows(2).map(|w| (w[1] - w[0]).powi(2)).sum();
    (sum / run.len() as f64).sqrt() / run.sample_time_s()
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

    /// Six runs of y = 2·a + 0.5·b ± 0.3 + 0.1 in two directions, one of which has twice the first slope.
    #[test]
    fn the_run_that_differs_is_the_one_the_others_do_not_predict() {
        let mut clusters = Vec::new();
        for run in 0..6_u32 {
            let slope = if run == 4 { 4.0 } else { 2.0 };
            for sign in [1.0, -1.0] {
                let mut cluster = Cluster::new(run as usize, sign, 4);
                for k in 0..50 {
                    let (a, b) = (f64::from(7 * run + k).sin(), f64::from(3 * k + run).cos());
                    let noise = 0.01 * f64::from(13 * k + run).cos();
                    cluster.add(&[a, b, 1.0, slope * a + 0.5 * b + 0.3 * sign + 0.1 + noise]);
                }
                clusters.push(cluster);
            }
        }
        let terms = [Term::Plain(0), Term::Plain(1), Term::Signed(2), Term::Plain(2)];
        let found = runs_left_out(&clusters, &terms, &[1.0; 6]);
        let worst = found.iter().max_by(|a, b| a.residual.total_cmp(&b.residual)).unwrap();
        assert_eq!((found.len(), worst.run), (6, 4));
        assert!(worst.residual > 20.0 && (worst.value[0] - 2.0).abs() < 0.01, "{worst:?}");
        assert!(found.iter().filter(|r| r.run != 4).all(|r| r.residual < 3.0));
        let unlike = unlike_others(&found).unwrap();
        assert_eq!(unlike.run, 4);
        let RunDifference::Inertia { factor } = unlike.difference else { panic!("{unlike:?}") };
        assert!((factor - 2.0).abs() < 0.05, "{factor}");
    }
}
