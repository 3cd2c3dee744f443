//! A root between two points of opposite sign.

use crate::number::Scaled;

/// Halvings of the interval after which doubles are exhausted.
const STEPS_MOST: usize = 400;

/// The root of `f` between `a` and `b`, to the last bits, by Brent's method.
///
/// `f` gives scaled numbers of opposite sign at the two ends. Their common exponent is taken from
/// the larger end, so that characteristic functions of any size do.
///
/// # Source
/// `[Brent1973, ch. 4]`
pub(crate) fn root(f: impl Fn(f64) -> Scaled<f64>, a: f64, b: f64) -> f64 {
    let (fa, fb) = (f(a), f(b));
    // Near the smaller end's size nothing saturates where it matters.
    let exponent = fa.exponent.min(fb.exponent);
    let at = |x: f64| f(x).at(exponent);
    let (mut a, mut b, mut fa, mut fb) = (a, b, fa.at(exponent), fb.at(exponent));
    let (mut c, mut fc) = (a, fa);
    let mut step = b - a;
    let mut before = step;
    for _ in 0..STEPS_MOST {
        if (fb > 0.0) == (fc > 0.0) {
            (c, fc) = (a, fa);
            step = b - a;
            before = step;
        }
        if fc.abs() < fb.abs() {
            (a, b, c) = (b, c, b);
            (fa, fb, fc) = (fb, fc, fb);
        }
        let tolerance = f64::EPSILON * b.abs();
        let half = 0.5 * (c - b);
        if half.abs() <= tolerance || fb == 0.0 {
            break;
        }
        if before.abs() >= tolerance && fa.abs() > fb.abs() {
            let s = fb / fa;
            let (mut p, mut q);
            if a.total_cmp(&c).is_eq() {
                p = 2.0 * half * s;
                q = 1.0 - s;
            } else {
                let (u, r) = (fa / fc, fb / fc);
                p = s * (2.0 * half * u * (u - r) - (b - a) * (r - 1.0));
                q = (u - 1.0) * (r - 1.0) * (s - 1.0);
            }
            if p > 0.0 {
                q = -q;
            }
            p = p.abs();
            if 2.0 * p < (3.0 * half * q - (tolerance * q).abs()).min((before * q).abs()) {
                before = step;
                step = p / q;
            } else {
                step = half;
                before = half;
            }
        } else {
            step = half;
            before = half;
        }
        (a, fa) = (b, fb);
        b += if step.abs() > tolerance { step } else { tolerance.copysign(half) };
        fb = at(b);
    }
    b
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_a_root_of_a_function_of_any_size() {
        for exponent in [-3000, 0, 3000] {
            let f = |x: f64| Scaled { mantissa: x * x * x - 2.0, exponent };
            assert!((root(f, 0.0, 5.0) - 2f64.cbrt()).abs() < 1e-15);
        }
    }
}
