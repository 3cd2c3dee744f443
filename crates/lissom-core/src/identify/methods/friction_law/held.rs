//! How well a law predicts data that were left out of its fit.

use nalgebra::{DMatrix, DVector};

use crate::identify::methods::friction_law::law_rows::{FOLDS, KINDS, LawRows, weights};
use crate::identify::methods::regression::{Cluster, Term, values};

/// Squared residuals on what was left out.
pub(super) struct Held {
    /// Of each block, with its phase left out.
    pub(super) each: Vec<f64>,
    /// Sum, with each kind of stretch left out.
    pub(super) stretches: f64,
}

impl Held {
    pub(super) fn of(rows: &LawRows, terms: &[Term]) -> Option<Self> {
        let classes = rows.classes();
        let of_fold = |fold: usize| by_direction(&classes[fold * KINDS..(fold + 1) * KINDS]);
        let folds = without_each(&(0..FOLDS).map(of_fold).collect::<Vec<_>>(), terms)?;
        let taken = folds.iter().map(|value| {
            let value = value.as_ref()?;
            Some([-1.0, 1.0].map(|sign| weights(terms, value, sign)))
        });
        let taken: Vec<_> = taken.collect();
        let each = rows.blocks().iter().map(|block| {
            let taken = taken[block.fold()].as_ref();
            taken.map_or(0.0, |taken| rows.squared(block, &taken[usize::from(block.sign > 0.0)]))
        });
        let of_kind = |kind: usize| by_direction(classes.iter().skip(kind).step_by(KINDS));
        let sums: Vec<[Cluster; 2]> = (0..KINDS).map(of_kind).collect();
        let kinds = without_each(&sums, terms)?;
        let stretches = kinds.iter().zip(&sums).map(|(value, sums)| {
            let of = |sum: &Cluster, value| squared(&sum.products, terms, value, sum.sign);
            value.as_ref().map_or(0.0, |value| sums.iter().map(|sum| of(sum, value)).sum::<f64>())
        });
        Some(Self { each: each.collect(), stretches: stretches.sum() })
    }

    pub(super) fn phases(&self) -> f64 {
        self.each.iter().sum()
    }

    /// By how many standard errors `other` is better, block by block.
    pub(super) fn paired(&self, other: &Self) -> f64 {
        let n = self.each.len() as f64;
        let better: Vec<f64> = self.each.iter().zip(&other.each).map(|(a, b)| a - b).collect();
        let mean = better.iter().sum::<f64>() / n;
        let square: f64 = better.iter().map(|b| (b - mean).powi(2)).sum();
        mean / (square / (n * (n - 1.0))).sqrt().max(f64::MIN_POSITIVE)
    }
}

/// Sums of clusters, forward and backward.
pub(super) fn by_direction<'a>(clusters: impl IntoIterator<Item = &'a Cluster>) -> [Cluster; 2] {
    let mut clusters = clusters.into_iter().peekable();
    let width = clusters.peek().map_or(0, |c| c.products.ncols());
    let mut sums = [1.0, -1.0].map(|sign| Cluster::new(0, sign, width));
    for cluster in clusters {
        sums[usize::from(cluster.sign < 0.0)].merge(cluster);
    }
    sums
}

/// Estimates with one group of rows after another left out, of which `sums` are the sums; `None` of groups without rows.
pub(super) fn without_each(
    sums: &[[Cluster; 2]],
    terms: &[Term],
) -> Option<Vec<Option<DVector<f64>>>> {
    let add = |sum: &mut [Cluster; 2], own: &[Cluster; 2]| {
        sum.iter_mut().zip(own).for_each(|(sum, own)| sum.merge(own));
    };
    // Of the groups before each and after it: a difference of sums would lose digits.
    let mut sum =
        by_direction(sums.first()?).map(|all| Cluster::new(0, all.sign, all.products.ncols()));
    let mut after = sum.clone();
    let mut before = Vec::with_capacity(sums.len());
    for own in sums {
        before.push(sum.clone());
        add(&mut sum, own);
    }
    let mut estimates = Vec::with_capacity(sums.len());
    for (own, mut others) in sums.iter().zip(before).rev() {
        add(&mut others, &after);
        add(&mut after, own);
        let rows: usize = own.iter().map(|c| c.rows).sum();
        estimates.push(if rows == 0 { None } else { Some(values(&others, terms)?) });
    }
    estimates.reverse();
    Some(estimates)
}

/// ‖y − X·q‖² from the products of rows.
fn squared(products: &DMatrix<f64>, terms: &[Term], value: &DVector<f64>, sign: f64) -> f64 {
    let right = products.ncols() - 1;
    let mut q = DVector::zeros(products.ncols());
    for (t, v) in terms.iter().zip(value.iter()) {
        q[t.column()] += t.factor(sign) * v;
    }
    q[right] = -1.0;
    q.dot(&(products * &q)).max(0.0)
}
