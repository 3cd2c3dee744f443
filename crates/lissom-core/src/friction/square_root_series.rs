//! Taylor coefficients of a square root along a motion.

use super::taylor_row::Row;

/// Coefficients of `r = √p`, one after the other: `r_k = (p_k − Σ_{j=1}^{k−1} r_j·r_{k−j})/(2·r_0)`.
#[derive(Debug, Clone, Default)]
pub(super) struct SquareRootSeries {
    root: Row,
}

impl SquareRootSeries {
    /// The coefficient of order `k`, from that of p, which is positive at order 0.
    pub(super) fn next(&mut self, k: usize, square: f64) -> f64 {
        let root = &mut self.root;
        root[k] = if k == 0 {
            square.sqrt()
        } else {
            let products: f64 = (1..k).map(|j| root[j] * root[k - j]).sum();
            (square - products) / (2.0 * root[0])
        };
        root[k]
    }
}
