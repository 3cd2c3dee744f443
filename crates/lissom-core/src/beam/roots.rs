//! Roots in the complex plane, found together so that none is found twice.

use num_complex::Complex64;

/// Class of the roots of a factor (s² − z), Section 3 of the 1989 report.
///
/// # Source
/// `[Feliu1989, Section 3, property 1]`
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum RootClass {
    /// a: z < 0, two conjugate roots on the imaginary axis.
    #[cfg_attr(feature = "serde", serde(rename = "a"))]
    Imaginary,
    /// b: z ≥ 0, two real roots of opposite sign; non-minimum phase.
    #[cfg_attr(feature = "serde", serde(rename = "b"))]
    Real,
    /// c: z not real; z and its conjugate give four roots symmetric about both axes; non-minimum phase.
    #[cfg_attr(feature = "serde", serde(rename = "c"))]
    Quadruple,
}

impl RootClass {
    /// The letter in the 1989 report: a, b or c.
    pub fn letter(self) -> char {
        match self {
            Self::Imaginary => 'a',
            Self::Real => 'b',
            Self::Quadruple => 'c',
        }
    }
}

/// A pair whose imaginary part is below this, relatively, is real but for rounding.
const REAL: f64 = 1e-9;

/// Class of the roots with s² = z.
pub fn class(z: Complex64) -> RootClass {
    if z.im.abs() > REAL * z.norm() {
        RootClass::Quadruple
    } else if z.re < 0.0 {
        RootClass::Imaginary
    } else {
        RootClass::Real
    }
}

/// Sweeps of all roots.
const SWEEPS_MOST: usize = 200;

/// Relative correction at which a root stands.
const STANDS: f64 = 4.0 * f64::EPSILON;

/// All roots at once from starting points, one each, by the method of Ehrlich and Aberth.
///
/// `log_slope` is f′/f. Gives the roots and how many have not settled.
///
/// # Source
/// `[Aberth1973]`
pub(crate) fn together(
    log_slope: impl Fn(Complex64) -> Complex64,
    mut roots: Vec<Complex64>,
) -> (Vec<Complex64>, usize) {
    let count = roots.len();
    let mut moving = vec![true; count];
    // The smallest correction so far: rounding may keep a root from standing still.
    let mut least = vec![f64::INFINITY; count];
    for _ in 0..SWEEPS_MOST {
        for k in 0..count {
            if !moving[k] {
                continue;
            }
            let z = roots[k];
            let newton = log_slope(z);
            let others: Complex64 = (0..count)
                .filter(|j| *j != k && roots[*j] != z)
                .map(|j| (z - roots[j]).inv())
                .sum();
            let step = (newton - others).inv();
            if !step.is_finite() {
                // Exactly on a root.
                moving[k] = newton.is_finite();
                least[k] = 0.0;
                continue;
            }
            roots[k] -= step;
            let size = step.norm() / roots[k].norm().max(f64::MIN_POSITIVE);
            if size <= STANDS || (least[k] < 1e-12 && size >= least[k]) {
                moving[k] = false;
            }
            least[k] = least[k].min(size);
        }
        if moving.iter().all(|m| !m) {
            break;
        }
    }
    let unsettled = least.iter().filter(|l| **l > 1e-10).count();
    (roots, unsettled)
}

/// Tries for each root that is still sought.
const TRIES_EACH: usize = 60;
/// Tries in a row without a root after which the rest are given up.
const FRUITLESS_MOST: usize = 300;
/// Iterates further out than this, relative to the ring, will not come back; on a beam with mass
/// along it each costs the more the further it is out.
const ASTRAY: f64 = 100.0;
/// Newton steps of a try.
const STEPS_MOST: usize = 80;

/// `wanted` further roots, apart from those `known`, of a function real on the real axis, between
/// the moduli `low` and `high`: Newton's method with what is known divided out. Conjugates count
/// as found together.
pub(crate) fn further(
    log_slope: impl Fn(Complex64) -> Complex64,
    known: &[Complex64],
    wanted: usize,
    (low, high): (f64, f64),
) -> Vec<Complex64> {
    let mut all = known.to_vec();
    // Points that fill the half ring evenly, in a fixed order.
    let start = |k: usize| {
        let fraction = |step: f64| (0.5 + k as f64 * step).fract();
        let modulus = (low.ln() + (high / low).ln() * fraction(0.618_033_988_749_895)).exp();
        Complex64::from_polar(modulus, std::f64::consts::PI * fraction(0.414_213_562_373_095))
    };
    let mut fruitless = 0;
    for k in 0..TRIES_EACH * wanted {
        if all.len() >= known.len() + wanted || fruitless > FRUITLESS_MOST {
            break;
        }
        fruitless += 1;
        let mut z = start(k);
        let mut least = f64::INFINITY;
        for _ in 0..STEPS_MOST {
            let taken: Complex64 = all.iter().map(|r| (z - r).inv()).sum();
            let step = (log_slope(z) - taken).inv();
            if !step.is_finite() {
                break;
            }
            z -= step;
            if z.norm() > ASTRAY * high {
                break;
            }
            let size = step.norm() / z.norm();
            if size <= STANDS || (least < 1e-12 && size >= least) {
                least = size;
                break;
            }
            least = least.min(size);
        }
        // Without division by what is known, to the last digits.
        if least < 1e-10 && z.norm() <= high && z.norm() >= low {
            let polished = z - log_slope(z).inv();
            let z = if polished.is_finite() { polished } else { z };
            all.push(z);
            fruitless = 0;
            if class(z) == RootClass::Quadruple {
                all.push(z.conj());
            }
        }
    }
    all.split_off(known.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(roots: &[Complex64]) -> impl Fn(Complex64) -> Complex64 + '_ {
        |z| roots.iter().map(|r| (z - r).inv()).sum()
    }

    #[test]
    fn all_roots_are_found_from_rough_starts() {
        let truth: Vec<Complex64> =
            (1..=20).map(|k| Complex64::new(10f64.powi(k % 7), f64::from(k))).collect();
        let starts = truth.iter().map(|t| t * Complex64::new(1.3, 0.4)).collect();
        let (found, unsettled) = together(of(&truth), starts);
        assert_eq!(unsettled, 0);
        for t in &truth {
            assert!(found.iter().any(|f| (f - t).norm() < 1e-12 * t.norm()), "{t}");
        }
    }

    #[test]
    fn a_conjugate_pair_is_found_beside_known_roots() {
        let pair = Complex64::new(-3.0, 2.0);
        let known = [Complex64::new(5.0, 0.0), Complex64::new(-8.0, 0.0)];
        let all = [known[0], known[1], pair, pair.conj()];
        let found = further(of(&all), &known, 2, (0.1, 100.0));
        assert_eq!(found.len(), 2);
        assert!(found.iter().any(|f| (f - pair).norm() < 1e-12));
    }
}
