//! Derivatives of the state by all unknowns of a window, eight unknowns at a time.

#![expect(
    clippy::inline_always,
    reason = "loops over unknowns, compiled for vectors chosen at run time"
)]

use super::lanes::{LANES, Lanes, Pack};
use super::rates::Rates;
use super::series::{Ramp, Terms, input, orders};
use super::transition::Transition;
use crate::registers::widest;

/// Tangents of the unknowns in their order: the parameters, then the initial state.
#[derive(Debug, Clone)]
pub(super) struct Tangents<const D: usize> {
    packs: Vec<Pack<D>>,
    /// Where they go in a step.
    next: Vec<Pack<D>>,
}

impl<const D: usize> Tangents<D> {
    /// All zero, of `unknowns` unknowns.
    pub(super) fn new(unknowns: usize) -> Self {
        let packs = vec![[[0.0; LANES]; D]; unknowns.div_ceil(LANES)];
        Self { next: packs.clone(), packs }
    }

    /// Derivative of one state by one unknown.
    pub(super) fn entry(&mut self, state: usize, unknown: usize) -> &mut f64 {
        &mut self.packs[unknown / LANES][state][unknown % LANES]
    }

    /// Whether there is none.
    pub(super) fn is_empty(&self) -> bool {
        self.packs.is_empty()
    }

    /// Derivatives of the motor's angle and velocity by one unknown.
    pub(super) fn motor(&self, unknown: usize) -> [f64; 2] {
        [0, 1].map(|state| self.packs[unknown / LANES][state][unknown % LANES])
    }

    /// The same before the last whole piece.
    pub(super) fn before(&self, unknown: usize) -> [f64; 2] {
        [0, 1].map(|state| self.next[unknown / LANES][state][unknown % LANES])
    }

    /// Adds `s·x` to the tangent of one unknown.
    pub(super) fn add(&mut self, unknown: usize, s: f64, x: &[f64; D]) {
        for (lanes, x) in self.packs[unknown / LANES].iter_mut().zip(x) {
            lanes[unknown % LANES] += s * x;
        }
    }

    /// Takes `K·row` off, where a filter's gain K moves the state by what a reading shows beyond its prediction: `row` has the
    /// derivatives of that prediction by the unknowns.
    pub(super) fn corrected(&mut self, gain: &[f64; D], row: &[f64]) {
        for (pack, row) in self.packs.iter_mut().zip(row.as_chunks::<LANES>().0) {
            for (lanes, gain) in pack.iter_mut().zip(gain) {
                for (own, shown) in lanes.iter_mut().zip(row) {
                    *own -= gain * shown;
                }
            }
        }
    }

    /// The derivatives by unit changes of the state, row by row, which begin anew; they are the unknowns from `first` on.
    pub(super) fn take_units(&mut self, first: usize) -> [[f64; D]; D] {
        let found = std::array::from_fn(|i| std::array::from_fn(|j| *self.entry(i, first + j)));
        self.set_units(first);
        found
    }

    /// Unit changes of the state as unknowns from `first` on.
    pub(super) fn set_units(&mut self, first: usize) {
        for i in 0..D {
            for j in 0..D {
                *self.entry(i, first + j) = f64::from(u8::from(i == j));
            }
        }
    }

    /// Multiplies the derivatives of one state.
    pub(super) fn scale(&mut self, state: usize, factor: f64) {
        for pack in &mut self.packs {
            pack[state].iter_mut().for_each(|v| *v *= factor);
        }
    }

    /// `Σ c_i·∂x_i/∂u` of every unknown, into `row`, whose length is a multiple of [`LANES`]: what follows
    /// the unknowns among the last of these becomes zero.
    pub(super) fn seen(&self, c: &[f64; D], row: &mut [f64]) {
        widest(|| seen(&self.packs, c, row));
    }

    /// Over a whole piece from the state `x` under the net torque `from`, which changes by `change`.
    /// What torques add that are parameters themselves is left out.
    pub(super) fn over(&mut self, piece: &Transition<D>, x: &[f64; D], from: f64, change: f64) {
        widest(|| over(&self.packs, &mut self.next, piece, (x, from, change)));
        std::mem::swap(&mut self.packs, &mut self.next);
    }

    /// The same along a series, after `time_s`.
    pub(super) fn along(&mut self, rates: &Rates<D>, terms: &Terms<D>, net: Ramp, time_s: f64) {
        widest(|| along(&mut self.packs, rates, terms, net, time_s));
    }

    /// Its numbers, [`LANES`] unknowns at a time.
    pub(super) fn packs(&self) -> &[Pack<D>] {
        &self.packs
    }
}

#[inline(always)]
fn over<const D: usize>(
    packs: &[Pack<D>],
    next: &mut [Pack<D>],
    piece: &Transition<D>,
    (x, from, change): (&[f64; D], f64, f64),
) {
    for (k, (old, next)) in packs.iter().zip(next).enumerate() {
        let by = piece.by_parameter.get(k);
        for (i, new) in next.iter_mut().enumerate() {
            let mut sum = [0.0; LANES];
            for (column, old) in piece.own.phi.iter().zip(old) {
                add(&mut sum, column[i], old);
            }
            if let Some(by) = by {
                add_products(&mut sum, x, &by.phi[i]);
                add(&mut sum, from, &by.push[i]);
                add(&mut sum, change, &by.ramp[i]);
            }
            *new = sum;
        }
    }
}

#[inline(always)]
fn seen<const D: usize>(packs: &[Pack<D>], c: &[f64; D], row: &mut [f64]) {
    // Speeds are seen by no angle.
    let mut counts = [(0.0, 0); D];
    let mut some = 0;
    for (i, c) in c.iter().enumerate().filter(|(_, c)| **c != 0.0) {
        counts[some] = (*c, i);
        some += 1;
    }
    for (pack, row) in packs.iter().zip(row.as_chunks_mut::<LANES>().0) {
        let mut sum = [0.0; LANES];
        for (c, i) in &counts[..some] {
            add(&mut sum, *c, &pack[*i]);
        }
        *row = sum;
    }
}

#[inline(always)]
fn along<const D: usize>(
    packs: &mut [Pack<D>],
    rates: &Rates<D>,
    terms: &Terms<D>,
    net: Ramp,
    time_s: f64,
) {
    let most = orders(rates, time_s);
    for (k, pack) in packs.iter_mut().enumerate() {
        let by = rates.by_parameter.get(k);
        let (mut term, mut power) = (*pack, 1.0);
        for (n, of_order) in terms.iter().enumerate().take(most) {
            let old = term;
            power *= time_s;
            let share = 1.0 / (n as f64 + 1.0);
            for (i, next) in term.iter_mut().enumerate() {
                let mut sum = [0.0; LANES];
                add_products(&mut sum, &rates.a[i], &old);
                if let Some((a, b)) = by {
                    add_products(&mut sum, of_order, &a[i]);
                    add(&mut sum, input(n, net), &b[i]);
                }
                *next = sum.map(|v| v * share);
                add(&mut pack[i], power, next);
            }
        }
    }
}

#[inline(always)]
fn add(sum: &mut Lanes, s: f64, x: &Lanes) {
    for (sum, x) in sum.iter_mut().zip(x) {
        *sum += s * x;
    }
}

#[inline(always)]
fn add_products<const D: usize>(sum: &mut Lanes, x: &[f64; D], rows: &[Lanes; D]) {
    for (x, row) in x.iter().zip(rows) {
        add(sum, *x, row);
    }
}
