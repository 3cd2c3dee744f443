//! How well a law describes windows from which it was not fitted.

use nalgebra::DVector;

use crate::identify::methods::friction_law::law_term::Column;
use crate::identify::methods::friction_law::rows::{Sampled, fixed, used};
use crate::identify::methods::regression::Term;

/// A law with its estimates.
pub(super) struct Described {
    pub(super) columns: Vec<Column>,
    pub(super) terms: Vec<Term>,
    pub(super) value: DVector<f64>,
}

impl Described {
    /// What it leaves on some windows.
    pub(super) fn left(&self, sampled: &Sampled<'_>) -> Left {
        let mut left = Left::default();
        let noise = [1.0, -1.0].map(|sign| sampled.noise_powers(&self.by_column(sampled, sign)));
        let (columns, terms) = used(sampled.campaign, &self.columns, &self.terms);
        for (place, row) in sampled.rows(&columns, &[]).iter() {
            let y = row.right();
            let explained: f64 = terms
                .iter()
                .zip(&self.value)
                .map(|(t, v)| t.factor(place.sign) * row.column(t.column()) * v)
                .sum();
            let (rest, level) = (y - explained, place.sign * row.column(2));
            left.square += rest * rest;
            left.noise += noise[usize::from(place.sign < 0.0)][place.run];
            left.power += y * y;
            left.by_level += rest * level;
            left.level += level * level;
        }
        left
    }

    /// What the law takes of each column that the motor's regression has, in a direction.
    fn by_column(&self, sampled: &Sampled<'_>, sign: f64) -> DVector<f64> {
        let mut taken = DVector::zeros(fixed(sampled.campaign));
        for (term, value) in self.terms.iter().zip(&self.value) {
            if let Some(of_column) = taken.get_mut(term.column()) {
                *of_column += term.factor(sign) * value;
            }
        }
        taken
    }
}

/// Sums over windows of what a law leaves.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Left {
    square: f64,
    noise: f64,
    power: f64,
    by_level: f64,
    level: f64,
}

impl Left {
    /// ‖y − X·q‖/‖y‖.
    pub(super) fn relative(&self) -> f64 {
        (self.square / self.power).sqrt()
    }

    /// ‖y − X·q‖/‖y‖, without what the sensors' noise makes of it in expectation.
    pub(super) fn beyond_noise(&self) -> f64 {
        ((self.square - self.noise).max(0.0) / self.power).sqrt()
    }

    /// Friction against the motion beyond the law's in these windows without those of `others`, [N·m].
    pub(super) fn more_friction_without(&self, others: &Self) -> f64 {
        (self.by_level - others.by_level) / (self.level - others.level)
    }
}
