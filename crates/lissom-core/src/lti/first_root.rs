//! First root of a polynomial on an interval.

/// Value at `t` of `Σ c_k·t^k`.
pub(crate) fn value(c: &[f64], t: f64) -> f64 {
    c.iter().rev().fold(0.0, |sum, &a| sum * t + a)
}

/// First `t` in `(0, end]` at which a polynomial that is positive just after 0 stops being so.
///
/// Intervals on which a bound from the Taylor coefficients about the middle keeps the polynomial
/// positive are passed over, the others halved: no crossing is stepped over, not even a pair of
/// close ones, down to intervals of `end·2⁻⁵²`.
pub(crate) fn first_nonpositive(c: &[f64], end: f64) -> Option<f64> {
    // What is no number has no root, and would be halved for ever.
    if !c.iter().all(|a| a.is_finite()) {
        return None;
    }
    descend(c, 0.0, end, 52)
}

/// First `t` in `[0, end]` at which a polynomial that is not negative at 0 becomes so.
///
/// Leading coefficients that add no more than `rounding` over the interval count as zero: at zero
/// the first that counts decides, and where none does the polynomial stays where it is.
pub(crate) fn first_used_up(c: &[f64], end: f64, rounding: f64) -> Option<f64> {
    let mut reach = 1.0;
    for (k, a) in c.iter().enumerate() {
        if (a * reach).abs() > rounding {
            return if *a > 0.0 { first_nonpositive(&c[k..], end) } else { Some(0.0) };
        }
        reach *= end;
    }
    None
}

fn descend(c: &[f64], from: f64, to: f64, depth: u32) -> Option<f64> {
    let radius = 0.5 * (to - from);
    let middle = from + radius;
    if positive_on(c, middle, radius) {
        return None;
    }
    if depth == 0 {
        return (value(c, to) <= 0.0).then_some(to);
    }
    // Once the polynomial falls all the way the crossing is single, and Newton's method with
    // bisection as its fence ends the search.
    if value(c, to) <= 0.0 && falling_on(c, middle, radius) {
        return Some(single_crossing(c, from, to));
    }
    descend(c, from, middle, depth - 1).or_else(|| descend(c, middle, to, depth - 1))
}

/// Σ of the magnitudes of the Taylor terms of order ≥ 1 about `middle`, at distance `radius`.
fn positive_on(c: &[f64], middle: f64, radius: f64) -> bool {
    let mut shifted = [0.0; ORDER_MOST + 1];
    let shifted = shift(c, middle, &mut shifted);
    let spread: f64 = shifted[1..].iter().rev().fold(0.0, |sum, a| (sum + a.abs()) * radius);
    shifted[0] - spread > 0.0
}

fn falling_on(c: &[f64], middle: f64, radius: f64) -> bool {
    let mut shifted = [0.0; ORDER_MOST + 1];
    let shifted = shift(c, middle, &mut shifted);
    if shifted.len() < 2 {
        return false;
    }
    let spread: f64 = shifted[2..]
        .iter()
        .enumerate()
        .rev()
        .fold(0.0, |sum, (k, a)| (sum + (k as f64 + 2.0) * a.abs()) * radius);
    shifted[1] + spread < 0.0
}

/// Highest order of the polynomials here.
pub(crate) const ORDER_MOST: usize = 24;

/// Taylor coefficients about `at`, by repeated synthetic division.
fn shift<'a>(c: &[f64], at: f64, out: &'a mut [f64; ORDER_MOST + 1]) -> &'a [f64] {
    let n = c.len().min(ORDER_MOST + 1);
    out[..n].copy_from_slice(&c[..n]);
    for first in 0..n {
        for k in (first..n.saturating_sub(1)).rev() {
            out[k] += at * out[k + 1];
        }
    }
    &out[..n]
}

fn single_crossing(c: &[f64], from: f64, to: f64) -> f64 {
    let (mut low, mut high) = (from, to);
    let mut t = 0.5 * (low + high);
    // Newton doubles the digits; the fence halves when Newton leaves it: 100 is never reached.
    for _ in 0..100 {
        let (mut f, mut slope) = (0.0, 0.0);
        for &a in c.iter().rev() {
            slope = slope * t + f;
            f = f * t + a;
        }
        if f > 0.0 {
            low = t;
        } else {
            high = t;
        }
        let newton = t - f / slope;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        if (next - t).abs() <= f64::EPSILON * to {
            return next;
        }
        t = next;
    }
    high
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_first_of_two_close_roots() {
        // (t − 0.5)(t − 0.5000001): positive, negative for 1e-7, positive.
        let (a, b) = (0.5, 0.500_000_1);
        let t = first_nonpositive(&[a * b, -(a + b), 1.0], 1.0).unwrap();
        assert!((t - a).abs() < 1e-9, "{t}");
    }

    #[test]
    fn a_polynomial_that_only_comes_near_zero_has_none() {
        assert_eq!(first_nonpositive(&[0.25 + 1e-9, -1.0, 1.0], 1.0), None);
    }

    #[test]
    fn a_root_beyond_the_end_is_not_one() {
        assert_eq!(first_nonpositive(&[1.0, -1.0], 0.999), None);
        let t = first_nonpositive(&[1.0, -1.0], 1.5).unwrap();
        assert!((t - 1.0).abs() < 1e-15);
    }
}
