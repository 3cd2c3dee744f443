//! A beam of point masses at its tips: the conditions that its modes must satisfy.

use nalgebra::{DMatrix, DVector};

use super::modal_arm::ModalArm;

/// Weight of a higher mode's stiffness beside the first's and beside all shapes: it is known worse.
const HIGHER: f64 = 0.1;
/// Least inertia to begin with, as a share of the mean.
const LEAST_SHARE: f64 = 0.05;

/// A beam whose mass is concentrated at its tips, in terms of inertias, frequencies and an orthogonal matrix.
///
/// With I_i = m_i·l_i² at tip i, the kinetic energy `½ΣI_i·θ̇_i²` equals `½Σμ_j·ψ̇_j²`, μ_j = k_j/ω_j², for any motion
/// `θ_i = Σ_j r_ij·ψ_j` (Σ_j r_ij = 1). Hence `rᵀ·diag(I)·r = diag(μ)`, and with an orthogonal matrix Q
///
/// ```text
/// s_j = Σ_i Q_ij·√I_i    r_ij = Q_ij·s_j/√I_i    k_j = ω_j²·s_j²
/// ```
///
/// This has n(n − 1)/2 unknowns fewer than independent frequencies, stiffnesses and shapes. A mode that no run excites
/// follows from the other modes and from the shape of the beam below its frequency.
///
/// # Source
/// The symmetry of stiffness and mass behind `[Feliu1989, eqs. (10), (17), (18)]`.
#[derive(Debug, Clone, PartialEq)]
pub struct PointMasses {
    /// Inertia I_i of each tip about the axis \[kg·m²\].
    pub inertia_kg_m2: Vec<f64>,
    /// Frequency ω_j of each mode with the motor clamped \[rad/s\].
    pub omega_rad_s: Vec<f64>,
    /// Orthogonal matrix Q, tips × modes.
    pub rotation: DMatrix<f64>,
}

/// One coordinate of [`PointMasses`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BeamCoordinate {
    /// Frequency ω of a mode \[rad/s\].
    Frequency(usize),
    /// Inertia I of a tip \[kg·m²\].
    Inertia(usize),
    /// Rotation of two columns of Q, the first towards the second \[rad\].
    Turn(usize, usize),
}

impl PointMasses {
    /// Builds a beam of point masses close to an arm with as many tips as modes (modes ascending); `None` for other
    /// arms, and if there is no such beam.
    pub fn nearest(arm: &ModalArm) -> Option<Self> {
        let n = arm.modes.len();
        if n < 2 || arm.shapes.len() != n {
            return None;
        }
        let mu: Vec<f64> =
            arm.modes.iter().map(|m| m.stiffness_nm_per_rad / m.omega_rad_s.powi(2)).collect();
        if mu.iter().any(|m| !(*m > 0.0 && m.is_finite())) {
            return None;
        }
        let r = DMatrix::from_fn(n, n, |i, j| arm.shapes[i][j] / mu[j].sqrt());
        let pairs: Vec<(usize, usize)> = (0..n).flat_map(|j| (j..n).map(move |l| (j, l))).collect();
        let weight = |(j, l): (usize, usize)| if j == l && j > 0 { HIGHER } else { 1.0 };
        let left = DMatrix::from_fn(pairs.len(), n, |p, i| {
            weight(pairs[p]) * r[(i, pairs[p].0)] * r[(i, pairs[p].1)]
        });
        let right = DVector::from_fn(pairs.len(), |p, _| {
            if pairs[p].0 == pairs[p].1 { weight(pairs[p]) } else { 0.0 }
        });
        let solved = left.svd(true, true).solve(&right, 1e-9).ok()?;
        let mean = mu.iter().sum::<f64>() / n as f64;
        let root: Vec<f64> = solved.iter().map(|i| i.max(LEAST_SHARE * mean).sqrt()).collect();
        let mut scaled = DMatrix::from_fn(n, n, |i, j| root[i] * r[(i, j)]);
        for mut column in scaled.column_iter_mut() {
            let length = column.norm();
            column /= if length > 0.0 { length } else { 1.0 };
        }
        let scaled = scaled.svd(true, true);
        let mut rotation = scaled.u? * scaled.v_t?;
        for mut column in rotation.column_iter_mut() {
            let s: f64 = column.iter().zip(&root).map(|(q, r)| q * r).sum();
            if s < 0.0 {
                column.neg_mut();
            }
        }
        let omega_rad_s = arm.modes.iter().map(|m| m.omega_rad_s).collect();
        let found =
            Self { inertia_kg_m2: root.iter().map(|r| r * r).collect(), omega_rad_s, rotation };
        found.rotation.iter().all(|q| q.is_finite()).then_some(found)
    }

    /// Number of masses.
    pub fn len(&self) -> usize {
        self.inertia_kg_m2.len()
    }

    /// Never true for a beam from [`nearest`](Self::nearest).
    pub fn is_empty(&self) -> bool {
        self.inertia_kg_m2.is_empty()
    }

    /// All coordinates, in order.
    pub fn coordinates(&self) -> Vec<BeamCoordinate> {
        let n = self.len();
        let turns = (0..n).flat_map(|j| (j + 1..n).map(move |l| BeamCoordinate::Turn(j, l)));
        let scales =
            (0..n).map(BeamCoordinate::Frequency).chain((0..n).map(BeamCoordinate::Inertia));
        scales.chain(turns).collect()
    }

    /// s_j.
    fn shares(&self) -> DVector<f64> {
        let root = DVector::from_iterator(self.len(), self.inertia_kg_m2.iter().map(|i| i.sqrt()));
        self.rotation.transpose() * root
    }

    /// Sets the modes and shapes of an arm to those of this beam.
    pub fn put_into(&self, arm: &mut ModalArm) {
        let s = self.shares();
        for (j, mode) in arm.modes.iter_mut().enumerate() {
            mode.omega_rad_s = self.omega_rad_s[j];
            mode.stiffness_nm_per_rad = (self.omega_rad_s[j] * s[j]).powi(2);
        }
        for (i, row) in arm.shapes.iter_mut().enumerate() {
            let root = self.inertia_kg_m2[i].sqrt();
            row.iter_mut().enumerate().for_each(|(j, r)| *r = self.rotation[(i, j)] * s[j] / root);
        }
    }

    /// Adds `change` to one coordinate.
    pub fn shift(&mut self, coordinate: BeamCoordinate, change: f64) {
        match coordinate {
            BeamCoordinate::Frequency(j) => self.omega_rad_s[j] += change,
            BeamCoordinate::Inertia(i) => self.inertia_kg_m2[i] += change,
            BeamCoordinate::Turn(j, l) => self.turn(j, l, change),
        }
    }

    fn turn(&mut self, first: usize, second: usize, angle_rad: f64) {
        let (sin, cos) = angle_rad.sin_cos();
        for i in 0..self.len() {
            let (a, b) = (self.rotation[(i, first)], self.rotation[(i, second)]);
            self.rotation[(i, first)] = cos * a + sin * b;
            self.rotation[(i, second)] = cos * b - sin * a;
        }
    }

    /// Derivatives of ω_j, k_j and r_ij (tips × modes) by one coordinate.
    pub fn derivative(&self, by: BeamCoordinate) -> BeamDerivative {
        let n = self.len();
        let s = self.shares();
        let root: Vec<f64> = self.inertia_kg_m2.iter().map(|i| i.sqrt()).collect();
        let mut omega = DVector::zeros(n);
        let mut ds = DVector::zeros(n);
        let mut dq = DMatrix::zeros(n, n);
        let mut droot = DVector::zeros(n);
        match by {
            BeamCoordinate::Frequency(j) => omega[j] = 1.0,
            BeamCoordinate::Inertia(i) => {
                droot[i] = 0.5 / root[i];
                ds = self.rotation.row(i).transpose() * droot[i];
            }
            BeamCoordinate::Turn(j, l) => {
                dq.set_column(j, &self.rotation.column(l));
                dq.set_column(l, &(-self.rotation.column(j)));
                (ds[j], ds[l]) = (s[l], -s[j]);
            }
        }
        let stiffness = DVector::from_fn(n, |j, _| {
            let w = self.omega_rad_s[j];
            2.0 * w * s[j] * (s[j] * omega[j] + w * ds[j])
        });
        let shapes = DMatrix::from_fn(n, n, |i, j| {
            let q = self.rotation[(i, j)];
            (dq[(i, j)] * s[j] + q * ds[j] - q * s[j] * droot[i] / root[i]) / root[i]
        });
        BeamDerivative { omega, stiffness, shapes }
    }
}

/// Derivatives of the modes by one coordinate of [`PointMasses`].
#[derive(Debug, Clone, PartialEq)]
pub struct BeamDerivative {
    /// Derivative of ω_j.
    pub omega: DVector<f64>,
    /// Derivative of k_j.
    pub stiffness: DVector<f64>,
    /// Derivative of r_ij.
    pub shapes: DMatrix<f64>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arm::Arm;
    use crate::beam::{LumpedBeam, Span};
    use crate::drive::{Coulomb, Motor};

    fn three_masses() -> ModalArm {
        let span = |length_m, mass_kg| Span {
            length_m,
            flexural_rigidity_n_m2: 0.02,
            mass_kg,
            damping_n_s_per_m: 0.0,
        };
        let beam = LumpedBeam::new(&[span(0.1, 0.06), span(0.15, 0.04), span(0.12, 0.05)]).unwrap();
        let motor = Motor::new(8e-4, 2e-3, 0.3).unwrap();
        let arm = Arm::new(beam, motor, Coulomb::symmetric(0.05).unwrap()).unwrap();
        ModalArm::of_arm(&arm).unwrap()
    }

    #[test]
    fn a_beam_of_point_masses_is_found_whole() {
        let arm = three_masses();
        let masses = PointMasses::nearest(&arm).unwrap();
        let distance: [f64; 3] = [0.1, 0.25, 0.37];
        for ((found, l), m) in masses.inertia_kg_m2.iter().zip(distance).zip([0.06, 0.04, 0.05]) {
            assert!((found / (m * l * l) - 1.0).abs() < 1e-9, "{found}");
        }
        let mut back = arm.clone();
        masses.put_into(&mut back);
        for (a, b) in arm.modes.iter().zip(&back.modes) {
            assert!((a.stiffness_nm_per_rad / b.stiffness_nm_per_rad - 1.0).abs() < 1e-9);
        }
        let apart = |a: &[f64], b: &[f64]| a.iter().zip(b).any(|(a, b)| (a - b).abs() > 1e-9);
        assert!(!arm.shapes.iter().zip(&back.shapes).any(|(a, b)| apart(a, b)));
    }

    #[test]
    fn derivatives_are_those_of_differences() {
        let arm = three_masses();
        let masses = PointMasses::nearest(&arm).unwrap();
        for by in masses.coordinates() {
            let moved = |change: f64| {
                let mut masses = masses.clone();
                masses.shift(by, change);
                let mut arm = arm.clone();
                masses.put_into(&mut arm);
                arm
            };
            let step = match by {
                BeamCoordinate::Frequency(j) => 1e-6 * masses.omega_rad_s[j],
                BeamCoordinate::Inertia(i) => 1e-6 * masses.inertia_kg_m2[i],
                BeamCoordinate::Turn(..) => 1e-6,
            };
            let (up, down) = (moved(step), moved(-step));
            let found = masses.derivative(by);
            for j in 0..3 {
                let slope = |of: &dyn Fn(&ModalArm) -> f64| (of(&up) - of(&down)) / (2.0 * step);
                let size = arm.modes[j].stiffness_nm_per_rad / step;
                let stiffness = slope(&|a| a.modes[j].stiffness_nm_per_rad);
                assert!((found.stiffness[j] - stiffness).abs() < 1e-8 * size, "{by:?}");
                for i in 0..3 {
                    let shape = slope(&|a| a.shapes[i][j]);
                    assert!((found.shapes[(i, j)] - shape).abs() < 1e-8 / step, "{by:?}");
                }
            }
        }
    }
}
