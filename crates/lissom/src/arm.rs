//! The coupled arm: beam and drive joined by the coupling torque (15).

use num_complex::Complex64;

use nalgebra::{DMatrix, DVector};

use crate::beam::LumpedBeam;
use crate::drive::{Coulomb, Motor};

/// A single-link flexible arm with a friction joint.
///
/// State `x = [θ_m, θ̇_m, θ_1..θ_n, θ̇_1..θ̇_n]`.
///
/// # Source
/// `[Feliu1989, eqs. (13)-(15)]`
#[derive(Debug, Clone)]
pub struct Arm {
    /// Linear part of the motor.
    pub motor: Motor,
    /// Its Coulomb friction.
    pub coulomb: Coulomb,
    beam: LumpedBeam,
    acceleration: DMatrix<f64>,
    acceleration_motor: DVector<f64>,
    damping: DVector<f64>,
}

impl Arm {
    /// Joins a beam to a drive through the coupling torque (15).
    pub fn new(beam: LumpedBeam, motor: Motor, coulomb: Coulomb) -> Self {
        let n = beam.len();
        let mass = |i: usize| beam.spans()[i].mass_kg;
        let acceleration = DMatrix::from_fn(n, n, |i, j| beam.ei_a()[(i, j)] / mass(i));
        let acceleration_motor = DVector::from_fn(n, |i, _| beam.ei_b()[i] / mass(i));
        let damping = DVector::from_fn(n, |i, _| beam.spans()[i].damping_n_s_per_m / mass(i));
        Self { motor, coulomb, beam, acceleration, acceleration_motor, damping }
    }

    /// The beam.
    pub fn beam(&self) -> &LumpedBeam {
        &self.beam
    }

    /// Number of states, 2 + 2n.
    pub fn state_len(&self) -> usize {
        2 + 2 * self.beam.len()
    }

    /// Coupling torque C_t of (15) in state `x` \[N·m\].
    pub fn coupling_torque(&self, x: &[f64]) -> f64 {
        let n = self.beam.len();
        // Differences from the motor's line: (15) with ΣH + h_m = 0, free of cancellation.
        self.beam.h().iter().zip(&x[2..2 + n]).map(|(h, theta)| h * (theta - x[0])).sum()
    }

    /// Homogeneous part of ẋ while the motor slips: friction and drive torque left out.
    pub(crate) fn derivative_slipping(&self, x: &[f64], out: &mut [f64]) {
        out[0] = x[1];
        out[1] = (-self.motor.viscous_nm_s_per_rad * x[1] - self.coupling_torque(x))
            / self.motor.inertia_kg_m2;
        self.derivative_beam(x, out);
    }

    /// ẋ while the motor sticks.
    pub(crate) fn derivative_sticking(&self, x: &[f64], out: &mut [f64]) {
        out[0] = 0.0;
        out[1] = 0.0;
        self.derivative_beam(x, out);
    }

    fn derivative_beam(&self, x: &[f64], out: &mut [f64]) {
        let n = self.beam.len();
        for i in 0..n {
            out[2 + i] = x[2 + n + i];
            let elastic: f64 = (0..n).map(|j| self.acceleration[(i, j)] * (x[2 + j] - x[0])).sum();
            out[2 + n + i] = elastic - self.damping[i] * x[2 + n + i];
        }
    }

    /// A bound on how fast the state can change: a norm of the state matrix \[1/s\].
    pub(crate) fn rate_bound(&self) -> f64 {
        let n = self.beam.len();
        let stiffness = (0..n)
            .map(|i| self.acceleration.row(i).abs().sum() + self.acceleration_motor[i].abs())
            .fold(0.0, f64::max);
        let coupling =
            (self.beam.h().abs().sum() + self.beam.h_motor().abs()) / self.motor.inertia_kg_m2;
        let rate = self.motor.viscous_nm_s_per_rad / self.motor.inertia_kg_m2;
        (stiffness + coupling).sqrt() + rate + self.damping.max()
    }

    /// Responses θ_i/θ_m at `omega_rad_s`, motor to each mass.
    ///
    /// Solves (13) with tip loads zero and `s = jω`: `(M·s² + D·s − EI·A)·Θ = EI·B·θ_m`. `None`
    /// exactly on an undamped pole.
    ///
    /// # Source
    /// `[Feliu1989, eq. (16)]`, with the damping of each mass added.
    pub fn tip_response(&self, omega_rad_s: f64) -> Option<Vec<Complex64>> {
        let n = self.beam.len();
        let s = Complex64::new(0.0, omega_rad_s);
        let matrix = nalgebra::DMatrix::<nalgebra::Complex<f64>>::from_fn(n, n, |i, j| {
            let inertial = if i == j { s * s + s * self.damping[i] } else { Complex64::ZERO };
            inertial - self.acceleration[(i, j)]
        });
        let right = DVector::from_fn(n, |i, _| Complex64::from(self.acceleration_motor[i]));
        let solved = matrix.lu().solve(&right)?;
        Some(solved.iter().copied().collect())
    }

    /// Response θ_m/i of the linear part at `omega_rad_s` \[rad/A\]: what is left when Coulomb
    /// friction is taken away.
    ///
    /// `G(jω) = K/(J·s² + V·s + Σ h_i·(θ_i/θ_m − 1))` with `s = jω`. `None` exactly on an undamped
    /// pole of the beam.
    ///
    /// ```
    /// # use lissom::{arm::Arm, beam::{LumpedBeam, Span}, drive::{Coulomb, Motor}};
    /// # let (l, m) = (0.2, 0.05);
    /// # let span = Span { length_m: l, flexural_rigidity_n_m2: 0.004, mass_kg: m, damping_n_s_per_m: 0.0 };
    /// # let beam = LumpedBeam::new(&[span]).unwrap();
    /// let motor = Motor::new(6e-4, 0.0, 0.25)?; // J, V, K
    /// let arm = Arm::new(beam, motor, Coulomb::symmetric(0.03)?);
    /// let (w, rigid) = (1e-3, 6e-4 + m * l * l); // slowly, the arm turns as one body
    /// let g = arm.motor_response(w).unwrap();
    /// assert!((g.re * rigid * w * w / -0.25 - 1.0).abs() < 1e-6);
    /// # Ok::<(), lissom::drive::DriveError>(())
    /// ```
    ///
    /// # Source
    /// `[Feliu1989, eqs. (13)-(16)]`; the G(ω) that (26) and (30) speak of.
    pub fn motor_response(&self, omega_rad_s: f64) -> Option<Complex64> {
        let tips = self.tip_response(omega_rad_s)?;
        let coupling: Complex64 =
            self.beam.h().iter().zip(&tips).map(|(h, theta)| (theta - 1.0) * *h).sum();
        let s = Complex64::new(0.0, omega_rad_s);
        let inverse =
            s * s * self.motor.inertia_kg_m2 + s * self.motor.viscous_nm_s_per_rad + coupling;
        Some(self.motor.torque_constant_nm_per_a / inverse)
    }
}
