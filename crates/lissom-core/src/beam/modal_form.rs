//! Modes seen at as many points, in the form (17)-(18).

use nalgebra::{DMatrix, DVector, Schur};
use num_complex::Complex64;

/// Â, B̂, Ĥ and ĥ of modes `η̈_k = ω_k²·(θ_m − η_k)` that points see as Θ = ρ·η and the motor as
/// `C_t = Σ c_k·(θ_m − η_k)`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ModalForm {
    /// `Â = −ρ·Ω²·ρ⁻¹`.
    pub(crate) a: DMatrix<f64>,
    /// `B̂ = ρ·Ω²·1`.
    pub(crate) b: DVector<f64>,
    /// `Ĥ = −cᵀ·ρ⁻¹`.
    pub(crate) h: DVector<f64>,
    /// `ĥ = Σ c_k`.
    pub(crate) h_motor: f64,
}

impl ModalForm {
    /// Of shares ρ (points × modes), their inverse, ω_k² and c_k.
    ///
    /// # Source
    /// What `[Feliu1989, eqs. (19)-(23)]` and step 6 come to in exact numbers.
    pub(crate) fn new(
        shares: &DMatrix<f64>,
        inverse: &DMatrix<f64>,
        squares: &DVector<f64>,
        coupling: &DVector<f64>,
    ) -> Self {
        Self {
            a: -(shares * DMatrix::from_diagonal(squares) * inverse),
            b: shares * squares,
            h: -inverse.tr_mul(coupling),
            h_motor: coupling.sum(),
        }
    }
}

/// Sweeps for the eigenvalues at most.
const SWEEPS: usize = 10_000;

/// The roots in z = s² of `Σ_k r_k/(z + ω_k²)`, by their size; none where the residues r_k vanish or no
/// eigenvalues are found. Residues that cancel leave one near infinity.
///
/// They are the eigenvalues of `D − D·1·rᵀ/Σr`, D = −Ω², but one that is zero.
pub(crate) fn zero_squares(residues: &[f64], squares: &[f64]) -> Vec<Complex64> {
    let size: f64 = residues.iter().map(|r| r.abs()).sum();
    if residues.len() < 2 || size == 0.0 || !size.is_finite() {
        return Vec::new();
    }
    let total: f64 = residues.iter().sum();
    let total = total.abs().max(f64::EPSILON * size).copysign(total);
    let modes = residues.len();
    let matrix = DMatrix::from_fn(modes, modes, |i, k| {
        let own = if i == k { 1.0 } else { 0.0 };
        -squares[i] * (own - residues[k] / total)
    });
    let Some(schur) = Schur::try_new(matrix, f64::EPSILON, SWEEPS) else { return Vec::new() };
    let mut roots: Vec<Complex64> = schur.complex_eigenvalues().iter().copied().collect();
    roots.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
    roots.into_iter().skip(1).filter(|z| z.is_finite()).collect()
}

/// Shares with what their rows lack of one given to the last mode: turning the arm as one body then strains
/// nothing (Â·1 + B̂ = 0, Ĥ·1 + ĥ = 0), and all modes but the last keep theirs.
pub(crate) fn completed(mut shares: DMatrix<f64>) -> DMatrix<f64> {
    let last = shares.ncols().saturating_sub(1);
    for mut row in shares.row_iter_mut() {
        row[last] = 1.0 - row.columns(0, last).sum();
    }
    shares
}
