//! The same arm with another load at a tip.

use nalgebra::{DMatrix, DVector};

use super::modal_arm::{ModalArm, Oscillator};

impl ModalArm {
    /// Returns this arm with an additional point mass at tip `tip`. `inertia_kg_m2` is its inertia about the axis:
    /// Δm·r² for a mass Δm at the distance r from the axis; negative if mass is removed.
    ///
    /// A torque T at the tip acts on oscillator j as r_ij·T. The load therefore adds `ΔI·r_i·r_iᵀ` to the inertias
    /// `diag(k_j/ω_j²)` of the oscillators; the stiffnesses stay. With the new modes U, `UᵀMU = 1`, `UᵀKU = Ω'²`
    /// and the drive `g = Uᵀ·K·1` by the motor, oscillator j has `k'_j = g_j²/ω'_j²`, and its share at tip i is
    /// `(r·U)_ij·g_j/ω'_j²`. The zeros of θ_tip/θ_m stay where they are (property 4): at a zero the tip is at
    /// rest, and the load exerts no force. A damper at the point of the tip stays the same. Coupling of the new
    /// modes by damping is neglected.
    ///
    /// `None` if there is no such tip, if more inertia is removed than the modes have there, or if the motor does not
    /// drive all new modes.
    ///
    /// # Source
    /// `[Feliu1989, Section 3, property 4]`, with the coordinates of (17)-(18) expressed in modes.
    #[must_use]
    pub fn with_load(&self, tip: usize, inertia_kg_m2: f64) -> Option<Self> {
        let n = self.modes.len();
        let row = self.shapes.get(tip)?;
        if n == 0 || !inertia_kg_m2.is_finite() {
            return None;
        }
        let r = DMatrix::from_fn(self.shapes.len(), n, |i, j| self.shapes[i][j]);
        let own = |m: &Oscillator| m.stiffness_nm_per_rad / (m.omega_rad_s * m.omega_rad_s);
        let inertias = DVector::from_iterator(n, self.modes.iter().map(own));
        let felt = DVector::from_row_slice(row);
        let mass = DMatrix::from_diagonal(&inertias) + &felt * felt.transpose() * inertia_kg_m2;
        let stiff = DVector::from_iterator(n, self.modes.iter().map(|m| m.stiffness_nm_per_rad));
        // M = L·Lᵀ; the eigenvectors of L⁻¹·K·L⁻ᵀ are Lᵀ·U.
        let lower = mass.cholesky()?.l();
        let whitened = lower.clone().try_inverse()?;
        let symmetric = &whitened * DMatrix::from_diagonal(&stiff) * whitened.transpose();
        let eigen = symmetric.symmetric_eigen();
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
        let modes = whitened.transpose() * eigen.eigenvectors.select_columns(&order);
        let squares = DVector::from_iterator(n, order.iter().map(|k| eigen.eigenvalues[*k]));
        let driven = modes.transpose() * &stiff;
        if squares.iter().any(|s| s.is_nan() || *s <= 0.0) || driven.iter().any(|g| *g == 0.0) {
            return None;
        }
        // UᵀDU with D in the oscillators' coordinates.
        let damping = |of: &dyn Fn(&Oscillator) -> f64| {
            let each = self.modes.iter().zip(&inertias).map(|(m, i)| of(m) * i);
            let all = DMatrix::from_diagonal(&DVector::from_iterator(n, each));
            (modes.transpose() * all * &modes).diagonal()
        };
        let within = damping(&|m| m.within_per_s);
        let grounded = damping(&|m| m.grounded_per_s);
        let oscillator = |j: usize| Oscillator {
            omega_rad_s: squares[j].sqrt(),
            stiffness_nm_per_rad: driven[j] * driven[j] / squares[j],
            within_per_s: within[j],
            grounded_per_s: grounded[j],
        };
        let shown = &r * &modes;
        let share = |i: usize, j: usize| shown[(i, j)] * driven[j] / squares[j];
        let mut at_points_per_s = self.at_points_per_s.clone();
        if let Some(at_tip) = at_points_per_s.get_mut(tip) {
            let inverse = r.clone().try_inverse()?;
            let there: f64 = (0..n).map(|k| inverse[(k, tip)].powi(2) * inertias[k]).sum();
            *at_tip *= there / (there + inertia_kg_m2);
        }
        Some(Self {
            modes: (0..n).map(oscillator).collect(),
            shapes: (0..self.shapes.len()).map(|i| (0..n).map(|j| share(i, j)).collect()).collect(),
            at_points_per_s,
            ..self.clone()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arm::Arm;
    use crate::beam::{LumpedBeam, Span};
    use crate::drive::{Coulomb, Motor};

    fn arm(tip_kg: f64) -> ModalArm {
        let span = |mass_kg: f64, length_m: f64| Span {
            length_m,
            flexural_rigidity_n_m2: 0.4,
            mass_kg,
            damping_n_s_per_m: 0.01,
        };
        let spans = [span(0.04, 0.15), span(0.03, 0.2), span(tip_kg, 0.1)];
        let beam = LumpedBeam::new(&spans).unwrap();
        let motor = Motor::new(2e-3, 1e-3, 1.0).unwrap();
        let coulomb = Coulomb::symmetric(0.1).unwrap();
        ModalArm::of_arm(&Arm::new(beam, motor, coulomb).unwrap()).unwrap()
    }

    #[test]
    fn another_mass_at_the_tip_is_the_arm_built_with_it() {
        let reach = 0.45_f64;
        for times in [0.5, 2.0, 5.0] {
            let built = arm(0.02 * times);
            let loaded = arm(0.02).with_load(2, 0.02 * (times - 1.0) * reach * reach).unwrap();
            for (a, b) in loaded.modes.iter().zip(&built.modes) {
                assert!((a.omega_rad_s / b.omega_rad_s - 1.0).abs() < 1e-9, "{a:?} {b:?}");
                assert!((a.stiffness_nm_per_rad / b.stiffness_nm_per_rad - 1.0).abs() < 1e-8);
            }
            for (a, b) in loaded.shapes.iter().flatten().zip(built.shapes.iter().flatten()) {
                assert!((a - b).abs() < 1e-8);
            }
            for (a, b) in loaded.at_points_per_s.iter().zip(&built.at_points_per_s) {
                assert!((a / b - 1.0).abs() < 1e-8, "{a} {b}");
            }
        }
    }

    #[test]
    fn a_load_that_cannot_be_taken_off_is_refused() {
        assert!(arm(0.02).with_load(2, -0.03 * 0.45 * 0.45).is_none());
        assert!(arm(0.02).with_load(3, 0.01).is_none());
        assert!(arm(0.02).with_load(0, f64::NAN).is_none());
    }
}
