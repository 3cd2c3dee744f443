//! The matrices of (10), (13) and (15).

use nalgebra::{DMatrix, DVector};

use super::three_moment::ThreeMoment;
use super::{BeamError, LumpedBeam};

/// Largest number of masses for which matrices are built; the other methods of a beam need no matrices.
pub const MOST_MASSES: usize = 2000;

/// The matrices of a lumped beam as in the 1989 report, with the force F_n and the torque T_n on the tip:
///
/// `m_i·θ̈_i = Σ_j EI·a_ij·θ_j + EI·b_i·θ_m + p_i·T_n + q_i·F_n` (13),
/// `C_t = Σ h_i·θ_i + h_{n+1}·θ_m + h_{n+2}·T_n` (15),
/// `(u_13 … u_n3) = U·(y(L_1) … y(L_n), T_n)` (10).
///
/// No matrix contains a mass: this is the separation property. F_n and T_n act at the last mass. The inertia of a
/// payload is not contained; it acts through F_n and T_n.
///
/// # Source
/// `[Feliu1989, eqs. (10), (13), (15)]`
///
/// # Differences from the source
/// EI may differ between spans, and the beam may begin at a hub radius; EI is contained in `ei_a`, `ei_b` and `h`. Each
/// element is a sum of terms of one sign, exact to a few roundings.
#[derive(Debug, Clone, PartialEq)]
pub struct BeamMatrices {
    /// `EI·A`, n × n \[N/m\].
    pub ei_a: DMatrix<f64>,
    /// `EI·B`, n elements \[N/m\]; `A·1 + B = 0`.
    pub ei_b: DVector<f64>,
    /// `P`, n elements \[1/m²\]: mass times angular acceleration, per tip torque.
    pub p: DVector<f64>,
    /// `Q`, n elements \[1/m\]: mass times angular acceleration, per tip force; `(0 … 0, 1/L_n)`.
    pub q: DVector<f64>,
    /// `U`, n × (n+1) \[1/m³; last column 1/(N·m²)\]: coefficients u_i3 of (1) per deflection and per tip torque.
    pub u: DMatrix<f64>,
    /// `H = (h_1 … h_n)` \[N·m/rad\]: coupling torque per angle of each mass.
    pub h: DVector<f64>,
    /// `h_{n+1}` \[N·m/rad\]: coupling torque per angle of the motor; `ΣH + h_{n+1} = 0`.
    pub h_motor: f64,
    /// `h_{n+2}` \[1\]: coupling torque per tip torque.
    pub h_torque: f64,
}

impl BeamMatrices {
    pub(super) fn of(beam: &LumpedBeam) -> Result<Self, BeamError> {
        let n = beam.len();
        if n > MOST_MASSES {
            return Err(BeamError::TooManyMasses { found: n, most: MOST_MASSES });
        }
        let statics = ThreeMoment::new(beam.spans(), beam.hub_radius_m(), false);
        let l = beam.position_m();
        let stiffness = statics.stiffness();
        let moments = statics.moments();
        let turn = statics.turn();
        let by_turn = statics.forces(&turn);
        let torque = statics.tip_torque();
        let by_torque = statics.forces(&torque);
        let last = beam.spans()[n - 1].length_m;
        let span = |i: usize| &beam.spans()[i];
        // M_n of span n is the tip's torque.
        let direct = |i: usize| match n - 1 - i {
            0 => 1.0 / last,
            1 => -1.0 / last,
            _ => 0.0,
        };
        let made = Self {
            ei_a: DMatrix::from_fn(n, n, |i, j| -stiffness[(i, j)] * l[j] / l[i]),
            ei_b: DVector::from_fn(n, |i, _| by_turn[i] / l[i]),
            p: DVector::from_fn(n, |i, _| (direct(i) - by_torque[i]) / l[i]),
            q: DVector::from_fn(n, |i, _| if i + 1 == n { 1.0 / l[i] } else { 0.0 }),
            u: DMatrix::from_fn(n, n + 1, |i, j| {
                let scale = 6.0 * span(i).flexural_rigidity_n_m2 * span(i).length_m;
                let at = |joint: usize| match (joint < n, j < n) {
                    (true, true) => moments[(joint, j)],
                    (true, false) => torque[joint],
                    (false, true) => 0.0,
                    (false, false) => 1.0,
                };
                (at(i + 1) - at(i)) / scale
            }),
            h: DVector::from_fn(n, |j, _| {
                let column: Vec<f64> = moments.column(j).iter().copied().collect();
                -statics.about_axis(&column, 0.0) * l[j]
            }),
            h_motor: statics.about_axis(&turn, 0.0),
            h_torque: -statics.about_axis(&torque, 1.0),
        };
        let finite = made.ei_a.iter().chain(made.u.iter()).chain(made.ei_b.iter());
        let finite = finite.chain(made.h.iter()).all(|v| v.is_finite()) && made.h_motor.is_finite();
        if finite { Ok(made) } else { Err(BeamError::OutOfRange { quantity: "the stiffness" }) }
    }
}
