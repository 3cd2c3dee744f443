//! Zeros of the points' responses, with standard errors.

use num_complex::Complex64;

use crate::beam::{RootClass, class, zero_squares};
use crate::identify::equivalent::deviation;
use crate::identify::equivalent::thresholds::{MODES_ABOVE_ERROR, ZERO_KNOWN};
use crate::identify::estimate::Estimate;
use crate::identify::responses::rational::SharedPoles;

/// Newton's steps at most.
const STEPS: usize = 40;
/// Imaginary part of s², as a share of its size, that eigenvalues of a real root may have by rounding.
const MEET: f64 = 1e-7;

/// A zero of θ_i/θ_m without damping: a root in s².
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ResponseZero {
    /// Root s² \[1/s²\]; for a conjugate pair, the one with the positive imaginary part.
    pub square: Complex64,
    /// Class of the zero: a, on the imaginary axis; b, a real pair; c, a quadruple.
    pub class: RootClass,
    /// Magnitude |s| of the zero \[rad/s\].
    pub omega_rad_s: Estimate,
    /// Whether |s| is outside the measured frequencies. Modes that are left out may then move it to any place.
    pub outside: bool,
}

/// Computes the zeros of the response of output `output`, `Σ_k ρ_ik·ω_k²/(s² + ω_k²)`, ascending in magnitude.
///
/// Zeros outside the measured frequencies are left out if their standard error is a tenth of their magnitude or more.
/// Zeros are eigenvalues, refined by Newton's method. Standard errors are to first order:
/// `dz = −Σ dr_k/(z + ω_k²)/f′ + Σ r_k·dω_k²/(z + ω_k²)²/f′`, with the sum f, z = s², r_k = ρ_ik·ω_k², and
/// `d|s| = Re(dz/z)·|s|/2`. For a zero that is off the imaginary axis or outside the measured frequencies, a tenth of
/// the shift by poles above these frequencies is added, because one such pole stands for many modes.
///
/// # Source
/// `[Feliu1989, Section 3, property 1; eq. (19)]`
pub fn response_zeros(fit: &SharedPoles, output: usize) -> Vec<ResponseZero> {
    let Some(gains) = fit.static_gains.get(output) else { return Vec::new() };
    let squares: Vec<f64> = fit.poles.iter().map(|p| p.omega_rad_s.powi(2)).collect();
    let residues: Vec<f64> = gains.iter().zip(&squares).map(|(g, s)| g * s).collect();
    let (low, high) = fit.range_rad_s;
    let mut zeros: Vec<ResponseZero> = zero_squares(&residues, &squares)
        .into_iter()
        .filter(|z| z.im >= -MEET * z.norm())
        .map(|z| refined(&residues, &squares, z))
        .map(|square| {
            let value = square.norm().sqrt();
            let std = spread(fit, output, &residues, &squares, square);
            let outside = !(low..=high).contains(&value);
            ResponseZero {
                square,
                class: class(square),
                omega_rad_s: Estimate { value, std },
                outside,
            }
        })
        .collect();
    // Beyond the frequencies most are of the poles that stand for all modes there.
    zeros.retain(|z| !z.outside || z.omega_rad_s.std < ZERO_KNOWN * z.omega_rad_s.value);
    zeros.sort_by(|a, b| a.omega_rad_s.value.total_cmp(&b.omega_rad_s.value));
    zeros
}

/// Σ r_k/(z + ω_k²) and its derivative.
fn value(residues: &[f64], squares: &[f64], z: Complex64) -> (Complex64, Complex64) {
    let each = residues.iter().zip(squares);
    each.fold(Default::default(), |(f, slope), (r, s)| {
        let inverse = 1.0 / (z + s);
        (f + r * inverse, slope - r * inverse * inverse)
    })
}

fn refined(residues: &[f64], squares: &[f64], mut z: Complex64) -> Complex64 {
    // Two real ones stay real.
    if z.im.abs() < MEET * z.norm() {
        z.im = 0.0;
    }
    for _ in 0..STEPS {
        let (f, slope) = value(residues, squares, z);
        let step = f / slope;
        if !step.is_finite() || step.norm() > 0.1 * z.norm() {
            break;
        }
        z -= step;
        if step.norm() <= f64::EPSILON * z.norm() {
            break;
        }
    }
    z
}

fn spread(
    fit: &SharedPoles,
    output: usize,
    residues: &[f64],
    squares: &[f64],
    z: Complex64,
) -> f64 {
    let (modes, unknowns) = (fit.poles.len(), fit.damping.unknowns());
    let slope = value(residues, squares, z).1;
    let size = z.norm().sqrt();
    // By r_k at constant ω_k², and by ω_k² at constant r_k.
    let by_residue = |k: usize| -1.0 / ((z + squares[k]) * slope);
    let by_square = |k: usize| residues[k] / ((z + squares[k]).powi(2) * slope);
    let first = modes * unknowns + output * modes;
    // On the imaginary axis within the frequencies the response is measured; elsewhere it is what the model says,
    // in which a pole or two stand for all modes above.
    let (low, high) = fit.range_rad_s;
    let measured = class(z) == RootClass::Imaginary && (low..=high).contains(&size);
    let each = residues.iter().zip(squares).filter(|(_, s)| s.sqrt() > high);
    let above: Complex64 = each.map(|(r, s)| r / (z + s)).sum();
    let left_out = if measured { 0.0 } else { MODES_ABOVE_ERROR };
    let by_modes_left_out = 0.5 * size * left_out * (above / (slope * z)).norm();
    let by_covariance = deviation(&fit.covariance, |u| {
        let dz = if u < modes * unknowns {
            let k = u / unknowns;
            let moved = by_residue(k) * residues[k] + by_square(k) * squares[k];
            if u.is_multiple_of(unknowns) { 2.0 * moved } else { Complex64::default() }
        } else {
            match u.checked_sub(first) {
                Some(k) if k < modes => by_residue(k) * squares[k],
                _ => Complex64::default(),
            }
        };
        0.5 * size * (dz / z).re
    });
    by_covariance.hypot(by_modes_left_out)
}
