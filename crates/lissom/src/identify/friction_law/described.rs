//! How well a law describes other windows than it was found from.

use nalgebra::DVector;

use super::rows::{Column, Sampled};
use crate::identify::regression::Term;

/// A law with its figures.
pub(super) struct Described {
    pub(super) columns: Vec<Column>,
    pub(super) terms: Vec<Term>,
    pub(super) value: DVector<f64>,
}

impl Described {
    /// What it leaves on some windows.
    pub(super) fn left(&self, sampled: &Sampled<'_>) -> Left {
        let mut left = Left::default();
        sampled.rows(&self.columns, &[], |place, row| {
            let y = row[row.len() - 1];
            let terms = self.terms.iter().zip(&self.value);
            let explained: f64 =
                terms.map(|(t, v)| t.factor(place.sign) * row[t.column()] * v).sum();
            let (rest, level) = (y - explained, place.sign * row[2]);
            left.square += rest * rest;
            left.power += y * y;
            left.by_level += rest * level;
            left.level += level * level;
        });
        left
    }
}

/// Sums over windows of what a law leaves.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Left {
    square: f64,
    power: f64,
    by_level: f64,
    level: f64,
}

impl Left {
    /// ‖y − X·q‖/‖y‖.
    pub(super) fn relative_residual(&self) -> f64 {
        (self.square / self.power).sqrt()
    }

    /// Friction against the motion beyond the law's in these windows without those of `others`, [N·m].
    pub(super) fn more_friction_without(&self, others: &Self) -> f64 {
        (self.by_level - others.by_level) / (self.level - others.level)
    }
}
