//! Thinning of rows, for bounded memory.

use lissom_core::record::Hold;

/// Columns that are halved in place when they are full.
///
/// A sample represents `factor` rows. A held command gets the mean over these rows, which has the same effect as the
/// rows; a measured channel keeps the value of the first row. Rows at the end that do not fill a sample are left out.
pub(super) struct Thinner {
    holds: Vec<Hold>,
    columns: Vec<Vec<f64>>,
    most: usize,
    factor: usize,
    /// Number of rows in the current sample so far.
    pending: usize,
    /// First value, or sum, of each column over these rows.
    partial: Vec<f64>,
}

impl Thinner {
    pub(super) fn new(holds: Vec<Hold>, most: usize) -> Self {
        let count = holds.len();
        Self {
            holds,
            columns: vec![Vec::new(); count],
            most: most.max(4) & !1,
            factor: 1,
            pending: 0,
            partial: vec![0.0; count],
        }
    }

    /// Makes room for so many rows.
    pub(super) fn expect(&mut self, rows: usize) {
        let samples = rows.min(self.most);
        for column in &mut self.columns {
            column.reserve_exact(samples.saturating_sub(column.len()));
        }
    }

    pub(super) fn push(&mut self, row: &[f64]) {
        let channels = self.partial.iter_mut().zip(&self.holds).zip(row);
        for ((partial, hold), &value) in channels {
            match hold {
                _ if self.pending == 0 => *partial = value,
                Hold::Sampled => *partial += value,
                Hold::Measured => {}
            }
        }
        self.pending += 1;
        if self.pending < self.factor {
            return;
        }
        self.pending = 0;
        let rows = self.factor as f64;
        for ((column, hold), &partial) in
            self.columns.iter_mut().zip(&self.holds).zip(&self.partial)
        {
            column.push(match hold {
                Hold::Sampled => partial / rows,
                Hold::Measured => partial,
            });
        }
        if self.columns.first().is_some_and(|column| column.len() >= self.most) {
            self.halve();
        }
    }

    fn halve(&mut self) {
        for (column, hold) in self.columns.iter_mut().zip(&self.holds) {
            for k in 0..column.len() / 2 {
                column[k] = match hold {
                    Hold::Sampled => f64::midpoint(column[2 * k], column[2 * k + 1]),
                    Hold::Measured => column[2 * k],
                };
            }
            column.truncate(column.len() / 2);
        }
        self.factor *= 2;
    }

    /// Rows per sample so far.
    pub(super) fn factor(&self) -> usize {
        self.factor
    }

    /// The columns, and the rows per sample.
    pub(super) fn finish(self) -> (Vec<Vec<f64>>, usize) {
        (self.columns, self.factor)
    }
}
