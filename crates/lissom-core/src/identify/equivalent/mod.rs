//! The lumped arm that is equivalent to a distributed one, from the responses of its points (step 5 of
//! Section 4 of the 1989 report).

use nalgebra::{DMatrix, DVector};

mod data;
mod equivalent_arm;
pub(crate) mod equivalent_error;
mod findings;
mod imaginary;
pub(crate) mod refusal;
mod responses;
mod sound;
mod standard_errors;
pub(crate) mod thresholds;
mod turned_round;
mod whole;
mod zeros;

pub use data::{Equivalent, EquivalentData, StdSource};
pub use equivalent_arm::{EquivalentArm, equivalent_arm};
pub use equivalent_error::EquivalentError;
pub use refusal::{EquivalentRefusal, PartOutside};
pub use whole::equivalent;
pub use zeros::{ResponseZero, response_zeros};

use crate::beam::{ModalForm, completed};
use crate::identify::equivalent::thresholds::POINTS_DEPENDENT;
use crate::identify::responses::rational::SharedPoles;
use crate::identify::thresholds::{CLEARLY_PRESENT, PRESENT};

/// The equivalent beam, `Θ̈ = Â·Θ + B̂·θ_m` (17): as many points of a beam as modes appear in their responses.
#[derive(Debug, Clone, PartialEq)]
pub struct EquivalentBeam {
    /// Â, points × points \[1/s²\].
    pub a: DMatrix<f64>,
    /// Standard errors of the elements of Â \[1/s²\].
    pub a_std: DMatrix<f64>,
    /// B̂, one element per point \[1/s²\].
    pub b: DVector<f64>,
    /// Standard errors of the elements of B̂ \[1/s²\].
    pub b_std: DVector<f64>,
    /// ρ: ρ_ik of point i in mode k.
    gains: DMatrix<f64>,
    /// ρ⁻¹.
    inverse: DMatrix<f64>,
    /// ω_k² of each mode.
    squares: DVector<f64>,
    /// ρ with rows that add up to one.
    completed: DMatrix<f64>,
    /// Rows whose last gain was given what they lacked.
    given_to_last: Vec<bool>,
}

/// The equivalent arm (17)-(18) in a form in which turning as one body does not bend the beam.
#[derive(Debug, Clone, PartialEq)]
pub struct StrainlessForm {
    /// Â, points × points \[1/s²\].
    pub a: DMatrix<f64>,
    /// B̂ = −Â·1 \[1/s²\].
    pub b: DVector<f64>,
    /// Ĥ \[N·m/rad\]; zero if no coupling was given.
    pub h: DVector<f64>,
    /// ĥ_{n+1} = −ΣĤ \[N·m/rad\].
    pub h_motor: f64,
    /// One minus the sum of the fitted gains at each point \[1\].
    pub missing: DVector<f64>,
    /// For each point, whether its sum of gains differs significantly from one, so that the whole difference was given
    /// to its last mode.
    pub given_to_last: Vec<bool>,
}

impl EquivalentBeam {
    /// Most that a point's gains lack of one where its last mode was given it.
    fn given(&self) -> f64 {
        let missing = self.gains.column_sum().map(|sum| (1.0 - sum).abs());
        let each = missing.iter().zip(&self.given_to_last);
        each.filter(|(_, to_last)| **to_last).map(|(m, _)| *m).fold(0.0, f64::max)
    }

    /// The form for use as an arm, with gains that add up to one at every point.
    ///
    /// If modes are left out, the fitted gains do not add up to one, and (17) as fitted would bend a beam that turns as
    /// one body, even at rest. The difference is given to the last mode of the point, as in
    /// [`TruncatedBeam`](crate::beam::TruncatedBeam). If it is within three standard errors of zero, the sum is taken
    /// as exactly one instead, and all gains of the point are adjusted according to their covariance.
    ///
    /// `coupling` is c_k of each mode \[N·m/rad\], or empty if it is unknown. `None` if the
    /// adjusted gains cannot be inverted.
    pub fn strainless(&self, coupling: &[f64]) -> Option<StrainlessForm> {
        let inverse = self.completed.clone().try_inverse()?;
        let known = |k: usize, _| coupling.get(k).copied().unwrap_or(0.0);
        let coupling = DVector::from_fn(self.squares.len(), known);
        let ModalForm { a, b, h, h_motor } =
            ModalForm::new(&self.completed, &inverse, &self.squares, &coupling);
        let missing = self.gains.column_sum().map(|sum| 1.0 - sum);
        let given_to_last = self.given_to_last.clone();
        let sound = a.iter().all(|v| v.is_finite());
        sound.then_some(StrainlessForm { a, b, h, h_motor, missing, given_to_last })
    }
}

/// Gains that add up to one at every point, and which points' last mode was given what they lack.
fn with_sum_of_one(fit: &SharedPoles, gains: &DMatrix<f64>) -> (DMatrix<f64>, Vec<bool>) {
    let (points, modes) = gains.shape();
    let mut all = completed(gains.clone());
    let first = fit.covariance.nrows() - points * modes;
    let mut given = vec![true; points];
    for (i, given) in given.iter_mut().enumerate() {
        let at = first + i * modes;
        let moves = fit.covariance.view((at, at), (modes, modes)).column_sum();
        let (missing, variance) = (1.0 - gains.row(i).sum(), moves.sum());
        if missing * missing <= PRESENT * PRESENT * variance && variance > 0.0 {
            all.set_row(i, &(gains.row(i) + moves.transpose() * (missing / variance)));
            *given = false;
        }
    }
    (all, given)
}

/// Computes Â and B̂ of (17) from transfer functions with shared poles.
///
/// ρ_ik is the static gain of point i in mode k, ρ the matrix of these gains and Ω² = diag(ω_k²). The modes move
/// according to `η̈ = Ω²·(θ_m − η)` and the points as Θ = ρ·η, so that `Â = −ρ·Ω²·ρ⁻¹` and `B̂ = ρ·Ω²·1`. This is the
/// result of (21)-(23) in exact arithmetic; polynomials of ω² would lose half of the digits. Standard errors are to
/// first order in the covariance of the fit. Modes that are left out do not contribute to the gains at rest, so Â·1 +
/// B̂ is zero only as far as ρ·1 is one.
///
/// # Errors
/// [`EquivalentError::PointsAndModes`] unless there are as many points as modes; [`EquivalentError::TooClose`] if the
/// gains of two points are too similar.
///
/// # Source
/// `[Feliu1989, Section 4, step 5, eqs. (19)-(23)]`
///
/// # Differences from the source
/// Damping of the poles is left out, because (17) has none.
pub fn equivalent_beam(fit: &SharedPoles) -> Result<EquivalentBeam, EquivalentError> {
    let (points, modes) = (fit.static_gains.len(), fit.poles.len());
    if points != modes {
        return Err(EquivalentError::PointsAndModes { points, modes });
    }
    let gains = DMatrix::from_fn(points, modes, |i, k| fit.static_gains[i][k]);
    let inverse = inverted(fit, &gains)?;
    let squares = DVector::from_fn(modes, |k, _| fit.poles[k].omega_rad_s.powi(2));
    let form = ModalForm::new(&gains, &inverse, &squares, &DVector::zeros(modes));
    let (a, b) = (form.a, form.b);
    // dÂ = −dR·Ω²·ρ⁻¹ − ρ·dΩ²·ρ⁻¹ − Â·dR·ρ⁻¹, dB̂ = dR·Ω²·1 + ρ·dΩ²·1.
    let slopes: Vec<(DMatrix<f64>, DVector<f64>)> = (0..fit.covariance.nrows())
        .map(|unknown| {
            let (d_gains, d_squares) = moved(fit, unknown);
            let by_gains = &d_gains * DMatrix::from_diagonal(&squares) + &a * &d_gains;
            let by_squares = &gains * DMatrix::from_diagonal(&d_squares);
            (-(by_gains + by_squares) * &inverse, d_gains * &squares + &gains * d_squares)
        })
        .collect();
    let a_std = DMatrix::from_fn(points, points, |i, j| {
        deviation(&fit.covariance, |u| slopes[u].0[(i, j)])
    });
    let b_std = DVector::from_fn(points, |i, _| deviation(&fit.covariance, |u| slopes[u].1[i]));
    let (completed, given_to_last) = with_sum_of_one(fit, &gains);
    Ok(EquivalentBeam { a, a_std, b, b_std, gains, inverse, squares, completed, given_to_last })
}

/// What one unknown of the fit moves: ρ, and ω_k².
fn moved(fit: &SharedPoles, unknown: usize) -> (DMatrix<f64>, DVector<f64>) {
    let (points, modes) = (fit.static_gains.len(), fit.poles.len());
    let unknowns = fit.damping.unknowns();
    let mut d_gains = DMatrix::zeros(points, modes);
    let mut d_squares = DVector::zeros(modes);
    match unknown.checked_sub(modes * unknowns) {
        Some(gain) if gain < points * modes => d_gains[(gain / modes, gain % modes)] = 1.0,
        None if unknown.is_multiple_of(unknowns) => {
            let k = unknown / unknowns;
            d_squares[k] = 2.0 * fit.poles[k].omega_rad_s.powi(2);
        }
        _ => {}
    }
    (d_gains, d_squares)
}

/// Standard error of what has the slope `by` by each unknown.
fn deviation(covariance: &DMatrix<f64>, by: impl Fn(usize) -> f64) -> f64 {
    let slope = DVector::from_fn(covariance.nrows(), |u, _| by(u));
    slope.dot(&(covariance * &slope)).max(0.0).sqrt()
}

/// ρ⁻¹, where the data tell the points apart.
fn inverted(fit: &SharedPoles, gains: &DMatrix<f64>) -> Result<DMatrix<f64>, EquivalentError> {
    let points = gains.nrows();
    let refused = |ratio: f64, mode: usize| {
        let (first, second) = most_alike(gains);
        EquivalentError::TooClose { first, second, ratio, mode }
    };
    let decomposed = gains.clone().svd(true, true);
    let (Some(left), Some(right)) = (&decomposed.u, &decomposed.v_t) else {
        return Err(refused(f64::NAN, 0));
    };
    let (at, least) = decomposed.singular_values.argmin();
    let ratio = least / decomposed.singular_values.max();
    let mode = right.row(at).transpose().iamax();
    // dσ = uᵀ·dR·v.
    let first = fit.covariance.nrows() - points * points;
    let std = deviation(&fit.covariance, |u| {
        let gain = u.checked_sub(first);
        gain.map_or(0.0, |g| left[(g / points, at)] * right[(at, g % points)])
    });
    if points > 1 && (ratio < POINTS_DEPENDENT || least < CLEARLY_PRESENT * std) {
        return Err(refused(ratio, mode));
    }
    gains.clone().try_inverse().ok_or_else(|| refused(ratio, mode))
}

/// The two points whose rows of gains point the same way most nearly.
fn most_alike(gains: &DMatrix<f64>) -> (usize, usize) {
    let cosine = |i: usize, j: usize| {
        let (a, b) = (gains.row(i), gains.row(j));
        a.dot(&b).abs() / (a.norm() * b.norm())
    };
    let pairs = (0..gains.nrows()).flat_map(|j| (0..j).map(move |i| (i, j)));
    pairs.max_by(|p, q| cosine(p.0, p.1).total_cmp(&cosine(q.0, q.1))).unwrap_or((0, 0))
}
