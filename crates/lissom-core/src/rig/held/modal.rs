//! An arm in the modes of its beam, scaled by energy.

use nalgebra::{DMatrix, DVector};

use crate::arm::Arm;
use crate::beam::Base;

/// Largest departure of the modal equations from the arm's own, relative to their largest rate:
/// both come from the same matrices, which are exact to some roundings each.
const AGREES: f64 = 1e-10;
/// A frequency by the beam's recursion replaces one by matrices where they differ by less than
/// this, relatively. Matrices lose the square of the range of frequencies in digits.
const SAME_FREQUENCY: f64 = 1e-6;
/// Beyond this many coordinates the decomposition takes longer than it saves.
const MOST_COORDINATES: usize = 150;

/// The arm's equations in `z = [√J·θ̇_m, w, s]`, whose square is twice the energy.
///
/// With the clamped beam's modes φ_j (mass-normed, `q − 1·θ_m = Φ·η`) and `p_j = φ_jᵀ·M·1`,
/// `w_j = η̇_j + p_j·θ̇_m` is the mode's share of the absolute motion and `s_j = ω_j·η_j` of the
/// deflection:
///
/// ```text
/// J·θ̈_m = T − V·θ̇_m + Σ ω_j·p_j·s_j + pᵀ·R·(w − p·θ̇_m)
/// ẇ = −Ω·s − R·(w − p·θ̇_m) − G·w
/// ṡ_j = ω_j·(w_j − p_j·θ̇_m)
/// ```
///
/// Without dampers that is skew-symmetric. A motor at rest leaves the rows of w and s. Only angles
/// to the fixed frame are missing: θ_m is the integral of θ̇_m.
#[derive(Debug, Clone)]
pub(in crate::rig) struct Modal {
    /// ω_j \[rad/s\].
    omega: Vec<f64>,
    /// Φ.
    shapes: DMatrix<f64>,
    /// Φᵀ·M.
    dual: DMatrix<f64>,
    /// p \[√(kg·m²)\].
    share: DVector<f64>,
    /// R, damping within the beam \[1/s\].
    relative: DMatrix<f64>,
    root_inertia: f64,
    /// Rates of z while the motor slips.
    pub(in crate::rig) slip: DMatrix<f64>,
    /// Rates of w and s while it sticks.
    pub(in crate::rig) stick: DMatrix<f64>,
}

impl Modal {
    /// `None` where the arm has no beam or too many coordinates or the modes do not give back its equations.
    pub(in crate::rig) fn new(arm: &Arm) -> Option<Self> {
        let k = arm.dynamics().len();
        if k == 0 || k > MOST_COORDINATES {
            return None;
        }
        let mass = arm.beam().mass_matrix();
        let d = arm.dynamics();
        let lower = mass.clone().cholesky()?.l();
        // L⁻¹·K·L⁻ᵀ = −Lᵀ·E·L⁻ᵀ.
        let half = lower.transpose() * &d.elastic;
        let stiffness = -lower.solve_lower_triangular(&half.transpose())?;
        let eigen = ((&stiffness + stiffness.transpose()) * 0.5).symmetric_eigen();
        let mut order: Vec<usize> = (0..k).collect();
        order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
        let exact = arm.beam().frequencies_rad_s(Base::Clamped, k);
        let mut omega = Vec::with_capacity(k);
        for (place, &column) in order.iter().enumerate() {
            let found = eigen.eigenvalues[column].sqrt();
            let better = exact.get(place).filter(|w| (**w / found - 1.0).abs() < SAME_FREQUENCY);
            omega.push(*better.unwrap_or(&found));
        }
        if !omega.iter().all(|w| w.is_finite() && *w > 0.0) {
            return None;
        }
        let vectors = DMatrix::from_fn(k, k, |i, j| eigen.eigenvectors[(i, order[j])]);
        let dual = vectors.transpose() * lower.transpose();
        let shapes = lower.transpose().solve_upper_triangular(&vectors)?;
        let share = &dual * DVector::from_element(k, 1.0);
        let in_modes = |m: Option<&DMatrix<f64>>| {
            m.map_or_else(|| DMatrix::zeros(k, k), |m| -(&dual * m * &shapes))
        };
        let relative = in_modes(d.relative.as_ref());
        let absolute = in_modes(d.absolute.as_ref());
        let root_inertia = arm.motor.inertia_kg_m2().sqrt();
        let slip = {
            let against = &relative * &share / root_inertia;
            let own = (arm.motor.viscous_nm_s_per_rad() / root_inertia + share.dot(&against))
                / root_inertia;
            let mut a = DMatrix::zeros(2 * k + 1, 2 * k + 1);
            a[(0, 0)] = -own;
            for j in 0..k {
                let (w, s) = (1 + j, 1 + k + j);
                let pull = omega[j] * share[j] / root_inertia;
                a[(0, w)] = against[j];
                a[(w, 0)] = against[j];
                a[(0, s)] = pull;
                a[(s, 0)] = -pull;
                a[(s, w)] = omega[j];
                a[(w, s)] = -omega[j];
                for i in 0..k {
                    a[(1 + i, w)] -= relative[(i, j)] + absolute[(i, j)];
                }
            }
            a
        };
        let stick = slip.view((1, 1), (2 * k, 2 * k)).into_owned();
        let modal = Self { omega, shapes, dual, share, relative, root_inertia, slip, stick };
        modal.agrees_with(arm).then_some(modal)
    }

    /// Number of coordinates.
    pub(in crate::rig) fn len(&self) -> usize {
        self.omega.len()
    }

    /// What a torque of 1 N·m does to ż.
    pub(in crate::rig) fn push(&self) -> DVector<f64> {
        let mut push = DVector::zeros(2 * self.len() + 1);
        push[0] = 1.0 / self.root_inertia;
        push
    }

    /// θ̇_m as a row on z.
    pub(in crate::rig) fn velocity(&self) -> DVector<f64> {
        self.push()
    }

    /// C_t as a row on z.
    pub(in crate::rig) fn coupling(&self) -> DVector<f64> {
        let k = self.len();
        let against = &self.relative * &self.share;
        let mut row = DVector::zeros(2 * k + 1);
        row[0] = self.share.dot(&against) / self.root_inertia;
        for j in 0..k {
            row[1 + j] = -against[j];
            row[1 + k + j] = -self.omega[j] * self.share[j];
        }
        row
    }

    /// z of a state `[θ_m, θ̇_m, q, q̇]`.
    pub(in crate::rig) fn energy(&self, x: &[f64], z: &mut [f64]) {
        let k = self.len();
        z[0] = self.root_inertia * x[1];
        let (q, v) = (&x[2..2 + k], &x[2 + k..2 + 2 * k]);
        for j in 0..k {
            let row = self.dual.row(j);
            z[1 + j] = row.iter().zip(v).map(|(d, v)| d * v).sum();
            let deflection: f64 = row.iter().zip(q).map(|(d, q)| d * (q - x[0])).sum();
            z[1 + k + j] = self.omega[j] * deflection;
        }
    }

    /// The state with the motor at `angle` that has this z.
    pub(in crate::rig) fn state(&self, angle: f64, z: &[f64], x: &mut [f64]) {
        let k = self.len();
        x[0] = angle;
        x[1] = z[0] / self.root_inertia;
        for i in 0..k {
            let row = self.shapes.row(i);
            let bent: f64 =
                row.iter().zip(&z[1 + k..]).zip(&self.omega).map(|((f, s), w)| f * s / w).sum();
            x[2 + i] = angle + bent;
            x[2 + k + i] = row.iter().zip(&z[1..]).map(|(f, w)| f * w).sum();
        }
    }

    /// q_i − θ_m as a row on z.
    pub(in crate::rig) fn deflection(&self, i: usize) -> DVector<f64> {
        let k = self.len();
        let mut row = DVector::zeros(2 * k + 1);
        for j in 0..k {
            row[1 + k + j] = self.shapes[(i, j)] / self.omega[j];
        }
        row
    }

    /// Whether rates and coupling torque are those of the arm, on a state that moves everything.
    fn agrees_with(&self, arm: &Arm) -> bool {
        let (k, len) = (self.len(), arm.state_len());
        let mut z = vec![0.0; 2 * k + 1];
        // No mode is left out, no two weigh alike.
        z.iter_mut().enumerate().for_each(|(i, z)| *z = 1.0 / (1.0 + 0.7 * i as f64));
        let (mut x, mut rates, mut back) = (vec![0.0; len], vec![0.0; len], z.clone());
        self.state(0.3, &z, &mut x);
        arm.derivative_slipping(&x, &mut rates);
        self.energy(&rates, &mut back);
        // Angles of ẋ are rates of angles: energy() takes them against θ̇_m, as it should.
        let z = DVector::from_vec(z);
        let expected = &self.slip * &z;
        let size = self.slip.amax() * z.amax();
        let torque = self.coupling();
        let torque_size = torque.amax() * z.amax();
        let gap = back.iter().zip(expected.iter()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let torque_gap = (arm.coupling_torque(&x) - torque.dot(&z)).abs();
        gap <= AGREES * size && torque_gap <= AGREES * torque_size
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::beam::{Damping, LumpedBeam, Payload, Span};
    use crate::drive::{Coulomb, Motor};

    /// Ways back and forth agree to this, relatively: some roundings.
    const ROUNDING: f64 = 1e-12;

    fn arms() -> Vec<Arm> {
        let span = |c: f64| Span {
            length_m: 0.15,
            flexural_rigidity_n_m2: 0.02,
            mass_kg: 0.04,
            damping_n_s_per_m: c,
        };
        let payload = Payload { mass_kg: 0.03, inertia_kg_m2: 2e-5, offset_m: 0.01 };
        let beam = |c: f64, n: usize| LumpedBeam::new(&vec![span(c); n]).unwrap();
        let beams = [
            beam(0.0, 1),
            beam(0.01, 4),
            beam(0.0, 3)
                .with_damping(Damping::Proportional { mass_per_s: 0.2, stiffness_s: 1e-4 })
                .unwrap(),
            beam(0.0, 3).with_damping(Damping::Modal { ratios: vec![0.01, 0.02, 0.05] }).unwrap(),
            beam(0.01, 2).with_payload(payload).unwrap(),
        ];
        let motor = Motor::new(6e-4, 1e-3, 0.25).unwrap();
        beams
            .into_iter()
            .map(|b| Arm::new(b, motor, Coulomb::symmetric(0.03).unwrap()).unwrap())
            .collect()
    }

    #[test]
    fn modes_give_back_the_arm() {
        for arm in arms() {
            let modal = Modal::new(&arm).unwrap();
            let x: Vec<f64> = (0..arm.state_len()).map(|i| (1.3 * i as f64).sin()).collect();
            let mut z = vec![0.0; 2 * modal.len() + 1];
            let mut back = vec![0.0; x.len()];
            modal.energy(&x, &mut z);
            modal.state(x[0], &z, &mut back);
            for (a, b) in x.iter().zip(&back) {
                assert!((a - b).abs() < ROUNDING, "{a} {b}");
            }
        }
    }

    #[test]
    fn without_dampers_the_rates_are_skew() {
        let mut arm = arms().swap_remove(0);
        let m = arm.motor;
        arm.motor = Motor::new(m.inertia_kg_m2(), 0.0, m.torque_constant_nm_per_a()).unwrap();
        let slip = Modal::new(&arm).unwrap().slip;
        assert_eq!(slip, -slip.transpose());
    }
}
