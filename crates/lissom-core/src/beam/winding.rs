//! How many zeros an entire function has in a disk: the argument principle.

use std::f64::consts::PI;

use num_complex::Complex64;

use crate::number::{Dual, Scaled};

/// Turn of the argument aimed at in a step.
const TURN: f64 = 0.3;
/// Largest difference between a step's turn and what the slope foretold.
const SURPRISE: f64 = 0.15;
/// Steps smaller than this pass too near a zero.
const STEP_LEAST: f64 = 1e-7;

/// Zeros of `f`, real on the real axis, with |z| < `radius`; `None` where one lies so near the
/// circle that it cannot be told on which side, or where the function is lost in rounding.
///
/// `f` is followed along the upper half circle. A step is as long as the slope f′/f allows, and is
/// halved until the argument turns as the slopes at both its ends say: no turn is lost. After
/// `steps_most` of them the function is taken to be noise; a zero takes some twenty.
///
/// # Source
/// The argument principle; `[Kravanja2000]` for following the slope.
pub(crate) fn zeros_within(
    f: impl Fn(Complex64) -> Scaled<Dual<Complex64>>,
    radius: f64,
    steps_most: usize,
) -> Option<usize> {
    // d arg f/dα on z = R·e^{jα} is Re(z·f′/f).
    let at = |angle: f64| {
        let z = Complex64::from_polar(radius, angle);
        let value = f(z).mantissa;
        let rate = (z * value.slope / value.value).re;
        (value.value.arg(), rate)
    };
    let (mut angle, mut turned) = (0.0, 0.0);
    let (mut argument, mut rate) = at(0.0);
    let mut steps = 0;
    while angle < PI {
        let mut step = (TURN / rate.abs().max(1.0)).min(PI - angle);
        loop {
            steps += 1;
            if steps > steps_most || !rate.is_finite() {
                return None;
            }
            let (next_argument, next_rate) = at(angle + step);
            let foretold = 0.5 * (rate + next_rate) * step;
            // The turn between −π and π.
            let turn = (next_argument - argument + 3.0 * PI).rem_euclid(2.0 * PI) - PI;
            if (turn - foretold).abs() < SURPRISE && foretold.abs() < 2.0 * TURN {
                (argument, rate) = (next_argument, next_rate);
                angle += step;
                turned += turn;
                break;
            }
            step *= 0.5;
            if step < STEP_LEAST {
                return None;
            }
        }
    }
    Some((turned / PI).round().max(0.0) as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zeros_in_a_disk_are_counted() {
        let roots =
            [Complex64::new(1.0, 0.0), Complex64::new(-2.0, 3.0), Complex64::new(-2.0, -3.0)];
        let f = |z: Complex64| {
            roots.iter().fold(Scaled::one(), |product: Scaled<Dual<Complex64>>, r| {
                product.times(Dual { value: z - r, slope: Complex64::from(1.0) })
            })
        };
        assert_eq!(zeros_within(f, 0.5, 10_000), Some(0));
        assert_eq!(zeros_within(f, 2.0, 10_000), Some(1));
        assert_eq!(zeros_within(f, 10.0, 10_000), Some(3));
        assert_eq!(zeros_within(f, 1.0, 10_000), None);
    }
}
