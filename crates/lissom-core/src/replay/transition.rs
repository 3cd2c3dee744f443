//! Matrices for a whole part of a sample in which there is no event.

use super::lanes::{MatrixPack, Pack};
use super::series::add;

/// `x(h) = Φ·x + γ·w(0) + ρ·(w(h) − w(0))` for a net torque w that is linear in time, with the
/// derivatives of Φ, γ and ρ.
#[derive(Debug, Clone)]
pub(super) struct Transition<const D: usize> {
    pub(super) duration_s: f64,
    pub(super) own: Step<D>,
    pub(super) by_parameter: Vec<StepPack<D>>,
}

/// Φ, column by column, γ and ρ.
#[derive(Debug, Clone)]
pub(super) struct Step<const D: usize> {
    pub(super) phi: [[f64; D]; D],
    pub(super) push: [f64; D],
    pub(super) ramp: [f64; D],
}

/// Their derivatives by some parameters; Φ row by row.
#[derive(Debug, Clone)]
pub(super) struct StepPack<const D: usize> {
    pub(super) phi: MatrixPack<D>,
    pub(super) push: Pack<D>,
    pub(super) ramp: Pack<D>,
}

impl<const D: usize> Step<D> {
    /// The state after the piece.
    pub(super) fn apply(&self, x: &[f64; D], from: f64, change: f64) -> [f64; D] {
        let mut y = [0.0; D];
        for (x, column) in x.iter().zip(&self.phi) {
            add(&mut y, *x, column);
        }
        add(&mut y, from, &self.push);
        add(&mut y, change, &self.ramp);
        y
    }
}
