//! What a whole piece of a sample does where nothing happens in it, as matrices.

use super::rates::Rates;
use super::series::{Ramp, add, reach_s, tangent, terms, times, value};

/// `x(h) = Φ·x + γ·w(0) + ρ·(w(h) − w(0))` for a net torque w that is linear in time, with the
/// derivatives of Φ, γ and ρ.
#[derive(Debug, Clone)]
pub(super) struct Transition<const D: usize> {
    pub(super) duration_s: f64,
    pub(super) own: Step<D>,
    pub(super) by_parameter: Vec<Step<D>>,
}

/// Φ, γ and ρ.
#[derive(Debug, Clone)]
pub(super) struct Step<const D: usize> {
    pub(super) phi: [[f64; D]; D],
    pub(super) push: [f64; D],
    pub(super) ramp: [f64; D],
}

impl<const D: usize> Step<D> {
    fn zero() -> Self {
        Self { phi: [[0.0; D]; D], push: [0.0; D], ramp: [0.0; D] }
    }

    /// Its share of the state after the piece.
    pub(super) fn apply(&self, x: &[f64; D], from: f64, change: f64) -> [f64; D] {
        let mut y = times(&self.phi, x);
        add(&mut y, from, &self.push);
        add(&mut y, change, &self.ramp);
        y
    }
}

impl<const D: usize> Transition<D> {
    pub(super) fn new(rates: &Rates<D>, duration_s: f64) -> Self {
        let mut found = Self {
            duration_s,
            own: Step::zero(),
            by_parameter: vec![Step::zero(); rates.by_parameter.len()],
        };
        // Column by column: from each unit state, from a unit torque, from a unit ramp.
        for column in 0..D + 2 {
            let mut x = [0.0; D];
            let mut net = Ramp { from: 0.0, slope: 0.0 };
            match column.checked_sub(D) {
                None => x[column] = 1.0,
                Some(0) => net.from = 1.0,
                Some(_) => net.slope = 1.0 / duration_s,
            }
            let (x, tangents) = whole(rates, x, net, duration_s);
            for (step, x) in std::iter::once(&mut found.own)
                .chain(&mut found.by_parameter)
                .zip(std::iter::once(&x).chain(&tangents))
            {
                match column.checked_sub(D) {
                    None => step.phi.iter_mut().zip(x).for_each(|(row, v)| row[column] = *v),
                    Some(0) => step.push = *x,
                    Some(_) => step.ramp = *x,
                }
            }
        }
        found
    }
}

/// State and tangents by the matrices' parameters after `duration_s`.
fn whole<const D: usize>(
    rates: &Rates<D>,
    mut x: [f64; D],
    mut net: Ramp,
    duration_s: f64,
) -> ([f64; D], Vec<[f64; D]>) {
    let parts = (duration_s / reach_s(rates)).ceil().max(1.0);
    let part_s = duration_s / parts;
    let still = Ramp { from: 0.0, slope: 0.0 };
    let mut tangents = vec![[0.0; D]; rates.by_parameter.len()];
    for _ in 0..parts as usize {
        let series = terms(rates, &x, net);
        for (s, by) in tangents.iter_mut().zip(&rates.by_parameter) {
            *s = tangent(rates, &series, net, s, Some(by), still, part_s);
        }
        x = value(&series, part_s);
        net = net.after(part_s);
    }
    (x, tangents)
}
