//! The linear part of a replayed arm: rational responses and a state space, dry friction left out.

use nalgebra::DMatrix;

use super::modal_arm::{ModalArm, Oscillator};
use crate::lti::{StateSpace, TransferFunction, add, multiply};

/// Sums that are zero in exact arithmetic are so to this share of their terms.
const ROUNDING: f64 = 1e-9;

/// A polynomial in s, coefficients in descending powers.
type Polynomial = Vec<f64>;

impl ModalArm {
    /// Transfer function θ_m per unit of command, without dry friction and with a monic denominator; V is the mean of
    /// both directions. It is `K·Δ/((J·s² + V·s)·Δ + Σ k_j(1 + d_j·s/ω_j²)·Δ_j)`, where Δ is the determinant of the
    /// equations of the clamped beam and Δ_j the same with column j replaced, so that `1 − ψ_j/θ = Δ_j/Δ`. It does not
    /// contain the lag of the command.
    pub fn motor_function(&self, torque_per_command: f64) -> TransferFunction {
        let clamped = self.clamped_equations();
        let shared = determinant(&clamped);
        let [forward, backward] = self.viscous_nm_s_per_rad;
        let rigid = multiply(&[self.inertia_kg_m2, 0.5 * (forward + backward), 0.0], &shared);
        let behind = self.behind();
        let pull = |(j, m): (usize, &Oscillator)| {
            let k = m.stiffness_nm_per_rad;
            let damper = k * m.within_per_s / (m.omega_rad_s * m.omega_rad_s);
            multiply(&[damper, k], &determinant(&replaced(&clamped, j, &behind)))
        };
        let den = self.modes.iter().enumerate().map(pull).fold(rigid, |sum, p| add(&sum, &p));
        TransferFunction { num: multiply(&[torque_per_command], &shared), den }.monic()
    }

    /// Transfer function θ_i/θ_m of a tip, with a monic denominator: `1 + Σ r_ij·(ψ_j/θ − 1)`. It does not contain the
    /// lag of the tip.
    ///
    /// # Panics
    /// If there is no such tip.
    pub fn tip_function(&self, tip: usize) -> TransferFunction {
        let clamped = self.clamped_equations();
        let shared = determinant(&clamped);
        let driven: Vec<Polynomial> = self
            .modes
            .iter()
            .map(|m| vec![m.within_per_s, m.omega_rad_s * m.omega_rad_s])
            .collect();
        let shape = &self.shapes[tip];
        // What the modes leave of one turns with the motor.
        let share = 1.0 - shape.iter().sum::<f64>();
        let size = shape.iter().fold(1.0, |sum, r| sum + r.abs());
        let with_motor = if share.abs() > ROUNDING * size { share } else { 0.0 };
        let of_mode =
            |(j, r): (usize, &f64)| multiply(&[*r], &determinant(&replaced(&clamped, j, &driven)));
        let own = multiply(&[with_motor], &shared);
        let num = shape.iter().enumerate().map(of_mode).fold(own, |sum, p| add(&sum, &p));
        let zeros = num.iter().take_while(|c| **c == 0.0).count().min(num.len() - 1);
        TransferFunction { num: num[zeros..].to_vec(), den: shared }.monic()
    }

    /// State space model `ẋ = A·x + B·u` without dry friction, with `x = [θ_m, θ̇_m, ψ_1, ψ̇_1, …]`. The input u is the
    /// command; the outputs are θ_m and the angle of each of `tips`, given by index and name. `unit` is the unit of
    /// angles (`rad` or `m`).
    pub fn state_space(
        &self,
        torque_per_command: f64,
        tips: &[(usize, String)],
        unit: &str,
    ) -> StateSpace {
        let n = 2 + 2 * self.modes.len();
        let j = self.inertia_kg_m2;
        let [forward, backward] = self.viscous_nm_s_per_rad;
        let points = self.points_in_modes();
        let mut a = DMatrix::zeros(n, n);
        a[(0, 1)] = 1.0;
        a[(1, 1)] = -0.5 * (forward + backward) / j;
        let mut states = vec![format!("motor_{unit}"), format!("motor_{unit}_per_s")];
        for (i, m) in self.modes.iter().enumerate() {
            let (q, w2, k) = (2 + 2 * i, m.omega_rad_s * m.omega_rad_s, m.stiffness_nm_per_rad);
            let damper = k * m.within_per_s / w2;
            a[(1, 0)] -= k / j;
            a[(1, 1)] -= damper / j;
            a[(1, q)] = k / j;
            a[(1, q + 1)] = damper / j;
            a[(q, q + 1)] = 1.0;
            (a[(q + 1, 0)], a[(q + 1, q)]) = (w2, -w2);
            a[(q + 1, 1)] = m.within_per_s;
            a[(q + 1, q + 1)] -= m.within_per_s + m.grounded_per_s;
            for l in points.iter().flat_map(|p| 0..p.ncols()) {
                a[(q + 1, 3 + 2 * l)] -= points.as_ref().map_or(0.0, |p| p[(i, l)]);
            }
            states.push(format!("mode_{}_{unit}", i + 1));
            states.push(format!("mode_{}_{unit}_per_s", i + 1));
        }
        let mut b = DMatrix::zeros(n, 1);
        b[(1, 0)] = torque_per_command / j;
        let mut c = DMatrix::zeros(1 + tips.len(), n);
        c[(0, 0)] = 1.0;
        let mut outputs = vec![format!("motor_{unit}")];
        for (row, (tip, name)) in tips.iter().enumerate() {
            c[(1 + row, 0)] = 1.0 - self.shapes[*tip].iter().sum::<f64>();
            for (i, r) in self.shapes[*tip].iter().enumerate() {
                c[(1 + row, 2 + 2 * i)] = *r;
            }
            outputs.push(format!("{name}_{unit}"));
        }
        let d = DMatrix::zeros(1 + tips.len(), 1);
        StateSpace { a, b, c, d, states, inputs: vec!["command".to_owned()], outputs }
    }

    /// Row j, column l: what ψ_l does in the equation of mode j with the motor clamped.
    fn clamped_equations(&self) -> Vec<Vec<Polynomial>> {
        let points = self.points_in_modes();
        let damped = |j: usize, l: usize| points.as_ref().map_or(0.0, |p| p[(j, l)]);
        let entry = |j: usize, l: usize| {
            let m = &self.modes[j];
            if j == l {
                let damping = m.within_per_s + m.grounded_per_s + damped(j, j);
                vec![1.0, damping, m.omega_rad_s * m.omega_rad_s]
            } else {
                vec![damped(j, l), 0.0]
            }
        };
        let n = self.modes.len();
        (0..n).map(|j| (0..n).map(|l| entry(j, l)).collect()).collect()
    }

    /// What drives θ − ψ_j where the motor turns: `s² + (a_j + Σ_l P_jl)·s`.
    fn behind(&self) -> Vec<Polynomial> {
        let points = self.points_in_modes();
        let of_mode = |(j, m): (usize, &Oscillator)| {
            let at_points = points.as_ref().map_or(0.0, |p| p.row(j).sum());
            vec![1.0, m.grounded_per_s + at_points, 0.0]
        };
        self.modes.iter().enumerate().map(of_mode).collect()
    }
}

/// A matrix with one column replaced: Cramer's rule.
fn replaced(matrix: &[Vec<Polynomial>], column: usize, by: &[Polynomial]) -> Vec<Vec<Polynomial>> {
    let mut out = matrix.to_vec();
    for (row, entry) in out.iter_mut().zip(by) {
        row[column].clone_from(entry);
    }
    out
}

/// Determinant along the first column. There are four modes at most.
fn determinant(matrix: &[Vec<Polynomial>]) -> Polynomial {
    let Some((first, below)) = matrix.split_first() else { return vec![1.0] };
    if below.is_empty() {
        return first[0].clone();
    }
    let of_row = |i: usize| {
        let rest = matrix.iter().enumerate().filter(|(k, _)| *k != i);
        let minor: Vec<Vec<Polynomial>> = rest.map(|(_, row)| row[1..].to_vec()).collect();
        let sign = if i.is_multiple_of(2) { 1.0 } else { -1.0 };
        multiply(&multiply(&[sign], &matrix[i][0]), &determinant(&minor))
    };
    (0..matrix.len()).map(of_row).fold(Vec::new(), |sum, term| add(&sum, &term))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::replay::DryTerms;

    /// Damping of all three kinds, the points' coupling the modes.
    fn arm() -> ModalArm {
        let mode = |omega_rad_s, stiffness_nm_per_rad, within_per_s, grounded_per_s| Oscillator {
            omega_rad_s,
            stiffness_nm_per_rad,
            within_per_s,
            grounded_per_s,
        };
        ModalArm {
            inertia_kg_m2: 2e-3,
            viscous_nm_s_per_rad: [3e-3, 5e-3],
            coulomb_nm: 0.1,
            offset_nm: 0.0,
            dry_terms: DryTerms::default(),
            modes: vec![mode(8.0, 2.0, 0.3, 0.2), mode(70.0, 1.0, 4.0, 0.5)],
            shapes: vec![vec![0.6, 0.4], vec![1.3, -0.3]],
            at_points_per_s: vec![0.7, 0.1],
            gravity: None,
            torque_ripples: Vec::new(),
            command_lag_s: 0.0,
            tip_lags_s: Vec::new(),
        }
    }

    const OMEGA_RAD_S: [f64; 7] = [0.3, 3.0, 7.9, 9.5, 40.0, 69.0, 300.0];

    #[test]
    fn all_forms_respond_alike() {
        let constant = 0.3;
        let mut arm = arm();
        for shapes in [arm.shapes.clone(), vec![vec![0.6, 0.3], vec![1.3, -0.35]]] {
            arm.shapes = shapes;
            let tips = [0, 1].map(|i| (i, format!("tip{i}")));
            let space = arm.state_space(constant, &tips, "rad");
            let motor = arm.motor_function(constant);
            assert_eq!((motor.num.len(), motor.den.len()), (5, 7));
            for w in OMEGA_RAD_S {
                let exact = constant * arm.motor_response(w);
                let whole = space.response(w).unwrap();
                assert!((motor.response(w) / exact - 1.0).norm() < 1e-12, "{w}");
                assert!((whole[0] / exact - 1.0).norm() < 1e-10, "{w}");
                for i in 0..2 {
                    let exact_tip = arm.tip_response(i, w);
                    let tip = arm.tip_function(i).response(w);
                    assert!((tip / exact_tip - 1.0).norm() < 1e-10, "{w} {i}");
                    assert!((whole[1 + i] / (exact * exact_tip) - 1.0).norm() < 1e-10, "{w} {i}");
                }
            }
        }
    }

    /// A tip that all modes make up has no share of the motor's own turn: three poles more than zeros
    /// with damping in the beam.
    #[test]
    fn a_tip_that_all_modes_make_up_lags() {
        let tip = arm().tip_function(0);
        assert_eq!((tip.num.len(), tip.den.len()), (4, 5));
        assert!((tip.response(1e-6).norm() - 1.0).abs() < 1e-9);
    }

    #[test]
    fn a_rigid_arm_is_one_over_its_inertia() {
        let rigid = ModalArm {
            modes: Vec::new(),
            shapes: Vec::new(),
            at_points_per_s: Vec::new(),
            ..arm()
        };
        let motor = rigid.motor_function(1.0);
        assert_eq!((motor.num, motor.den.len()), (vec![500.0], 3));
        assert_eq!(rigid.state_space(1.0, &[], "rad").a.nrows(), 2);
    }
}
