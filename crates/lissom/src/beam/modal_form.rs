//! Modes seen at as many points, in the form (17)-(18).

use nalgebra::{DMatrix, DVector};

/// Â, B̂, Ĥ and ĥ of modes `η̈_k = ω_k²·(θ_m − η_k)` that points see as Θ = R·η and the motor as
/// `C_t = Σ c_k·(θ_m − η_k)`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ModalForm {
    /// `Â = −R·Ω²·R⁻¹`.
    pub(crate) a: DMatrix<f64>,
    /// `B̂ = R·Ω²·1`.
    pub(crate) b: DVector<f64>,
    /// `Ĥ = −cᵀ·R⁻¹`.
    pub(crate) h: DVector<f64>,
    /// `ĥ = Σ c_k`.
    pub(crate) h_motor: f64,
}

impl ModalForm {
    /// Of shares R (points × modes), their inverse, ω_k² and c_k.
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

/// Shares with what their rows lack of one given to the last mode: turning the arm as one body then strains
/// nothing (Â·1 + B̂ = 0, Ĥ·1 + ĥ = 0), and all modes but the last keep theirs.
pub(crate) fn completed(mut shares: DMatrix<f64>) -> DMatrix<f64> {
    let last = shares.ncols().saturating_sub(1);
    for mut row in shares.row_iter_mut() {
        row[last] = 1.0 - row.columns(0, last).sum();
    }
    shares
}
