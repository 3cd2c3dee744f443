//! The motion within a phase as a Taylor series in time.

use super::rates::Rates;
use crate::lti::first_root::ORDER_MOST;

/// Largest (rate × step): 2²⁵/25! is 2e-18.
const REACH: f64 = 2.0;
/// Orders that count at any rate: a torque that is linear in time moves the angle by its cube.
const ORDERS_LEAST: usize = 3;
/// A term of a series below this share of the whole does not count.
const LEAST: f64 = 1e-19;

/// Net torque on the motor, linear in time.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ramp {
    /// At the beginning \[N·m\].
    pub(super) from: f64,
    /// Per time \[N·m/s\].
    pub(super) slope: f64,
}

impl Ramp {
    pub(super) const NONE: Self = Self { from: 0.0, slope: 0.0 };

    pub(super) fn after(self, time_s: f64) -> Self {
        Self { from: self.from + self.slope * time_s, ..self }
    }
    pub(super) fn less(self, torque: f64) -> Self {
        Self { from: self.from - torque, ..self }
    }
}

/// Coefficients of `x(t) = Σ x_n·tⁿ`.
pub(super) type Terms<const D: usize> = [[f64; D]; ORDER_MOST + 1];

/// `M·x`.
pub(super) fn times<const D: usize>(m: &[[f64; D]; D], x: &[f64; D]) -> [f64; D] {
    let mut y = [0.0; D];
    for (y, row) in y.iter_mut().zip(m) {
        for (m, x) in row.iter().zip(x) {
            *y += m * x;
        }
    }
    y
}

/// `y += s·x`.
pub(super) fn add<const D: usize>(y: &mut [f64; D], s: f64, x: &[f64; D]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += s * x;
    }
}

/// The time over which one series holds to rounding.
pub(super) fn reach_s<const D: usize>(rates: &Rates<D>) -> f64 {
    REACH / rates.rate_per_s
}

/// Orders that count over `time_s`: with `r` the rates' bound, what is left of `(r·t)ⁿ/n!` is below
/// rounding.
pub(super) fn orders<const D: usize>(rates: &Rates<D>, time_s: f64) -> usize {
    let (mut left, mut n) = (1.0, 0);
    while n < ORDERS_LEAST || (n < ORDER_MOST && left > LEAST) {
        n += 1;
        left *= rates.rate_per_s * time_s / n as f64;
    }
    n
}

/// `(n + 1)·x_{n+1} = A·x_n + b·w_n`, w_0 and w_1 of the ramp; as many as count within `most_s`.
pub(super) fn terms<const D: usize>(
    rates: &Rates<D>,
    x: &[f64; D],
    net: Ramp,
    most_s: f64,
) -> Terms<D> {
    let mut terms = [[0.0; D]; ORDER_MOST + 1];
    terms[0] = *x;
    for n in 0..orders(rates, most_s) {
        let mut next = times(&rates.a, &terms[n]);
        add(&mut next, input(n, net), &rates.b);
        terms[n + 1] = next.map(|v| v / (n as f64 + 1.0));
    }
    terms
}

/// Torque's coefficient of order `n`.
pub(super) fn input(n: usize, net: Ramp) -> f64 {
    match n {
        0 => net.from,
        1 => net.slope,
        _ => 0.0,
    }
}

/// x at `time_s`.
pub(super) fn value<const D: usize>(terms: &Terms<D>, time_s: f64) -> [f64; D] {
    let mut x = [0.0; D];
    for term in terms.iter().rev() {
        for (x, c) in x.iter_mut().zip(term) {
            *x = *x * time_s + c;
        }
    }
    x
}
