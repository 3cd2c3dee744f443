//! A beam and a motor, joined by the coupling torque (15).

use nalgebra::DMatrix;
use num_complex::Complex64;

use crate::beam::{Beam, BeamDynamics, BeamError, Roots, angle_per_current};
use crate::drive::{Coulomb, Motor};
use crate::lti::{StateSpace, ZeroPoleGain};

/// A single-link flexible arm whose joint has Coulomb friction.
///
/// The state is `x = [θ_m, θ̇_m, q_1 … q_k, q̇_1 … q̇_k]`, in rad and rad/s. q are the angles θ_1 … θ_n of the masses
/// or points, from base to tip. If the payload resists turning ([`Payload::turns`](crate::beam::Payload::turns)),
/// q_{n+1} is the slope of the beam at its tip and k = n + 1; otherwise k = n.
///
/// # Source
/// `[Feliu1989, eqs. (13)-(15)]`
#[derive(Debug, Clone)]
pub struct Arm {
    /// Linear part of the motor.
    pub motor: Motor,
    /// Coulomb friction of the joint.
    pub coulomb: Coulomb,
    beam: Beam,
    dynamics: BeamDynamics,
}

impl Arm {
    /// Joins a beam to a motor with friction, by the coupling torque (15).
    ///
    /// # Errors
    /// [`BeamError::TooManyMasses`] if the beam has more masses than matrices are built for (the methods
    /// of [`Beam`] itself need no matrices). [`BeamError::OutOfRange`] if an element of a matrix is too
    /// large or too small for a double.
    pub fn new(beam: impl Into<Beam>, motor: Motor, coulomb: Coulomb) -> Result<Self, BeamError> {
        let beam = beam.into();
        let dynamics = beam.dynamics()?;
        Ok(Self { motor, coulomb, beam, dynamics })
    }

    /// The beam.
    pub fn beam(&self) -> &Beam {
        &self.beam
    }

    /// The beam's equation of motion.
    pub fn dynamics(&self) -> &BeamDynamics {
        &self.dynamics
    }

    /// Number of states, 2 + 2k: see [`Arm`].
    pub fn state_len(&self) -> usize {
        2 + 2 * self.dynamics.len()
    }

    /// Coupling torque C_t of (15) in state `x` \[N·m\], without forces or torques on the tip:
    /// `C_t = Σ h_i·(θ_i − θ_m)`, plus the torque of damping within the beam. Positive if the beam holds the motor back
    /// from turning forward.
    pub fn coupling_torque(&self, x: &[f64]) -> f64 {
        let k = self.dynamics.len();
        // Differences from the motor's line: (15) with ΣH + h_m = 0, free of cancellation.
        let against = |h: &nalgebra::DVector<f64>, x: &[f64], motor: f64| -> f64 {
            h.iter().zip(x).map(|(h, q)| h * (q - motor)).sum()
        };
        let elastic = against(&self.dynamics.coupling, &x[2..2 + k], x[0]);
        let rate = self.dynamics.coupling_rate.as_ref();
        elastic + rate.map_or(0.0, |g| against(g, &x[2 + k..2 + 2 * k], x[1]))
    }

    /// Homogeneous part of ẋ while the motor slips: friction and drive torque left out.
    pub(crate) fn derivative_slipping(&self, x: &[f64], out: &mut [f64]) {
        out[0] = x[1];
        out[1] = (-self.motor.viscous_nm_s_per_rad() * x[1] - self.coupling_torque(x))
            / self.motor.inertia_kg_m2();
        self.derivative_beam(x, out);
    }

    /// ẋ while the motor sticks.
    pub(crate) fn derivative_sticking(&self, x: &[f64], out: &mut [f64]) {
        out[0] = 0.0;
        out[1] = 0.0;
        self.derivative_beam(x, out);
    }

    fn derivative_beam(&self, x: &[f64], out: &mut [f64]) {
        let k = self.dynamics.len();
        let (q, v) = (&x[2..2 + k], &x[2 + k..2 + 2 * k]);
        let row = |m: &DMatrix<f64>, i: usize, x: &[f64], motor: f64| -> f64 {
            x.iter().enumerate().map(|(j, q)| m[(i, j)] * (q - motor)).sum()
        };
        for i in 0..k {
            out[2 + i] = v[i];
            let mut a = row(&self.dynamics.elastic, i, q, x[0]);
            if let Some(relative) = &self.dynamics.relative {
                a += row(relative, i, v, x[1]);
            }
            if let Some(absolute) = &self.dynamics.absolute {
                a += row(absolute, i, v, 0.0);
            }
            out[2 + k + i] = a;
        }
    }

    /// A state of `before`, an arm of as many masses, as one of this arm: angles and velocities go on.
    /// The slope of a tip that begins to turn is that of the massless beam.
    pub(crate) fn take_over(&self, before: &Self, x: &[f64]) -> Vec<f64> {
        let (n, k, was) = (self.beam.len(), self.dynamics.len(), before.dynamics.len());
        let mut out = x[..2 + n].to_vec();
        let rates = &x[2 + was..2 + was + n];
        // The end of a massless beam carries no moment: that row of the stiffness, taken out of E by
        // the tip's share in the mass matrix.
        let d = &self.dynamics;
        let (own, mixed) = if k > n { (d.force[n - 1], d.force[n]) } else { (1.0, 0.0) };
        let slope = |motor: f64, q: &[f64]| {
            let row = |j: usize| own * d.elastic[(n, j)] - mixed * d.elastic[(n - 1, j)];
            let bent: f64 = (0..n).map(|j| row(j) * (q[j] - motor)).sum();
            motor - bent / row(n)
        };
        if k > n {
            out.push(if was > n { x[2 + n] } else { slope(x[0], &x[2..2 + n]) });
        }
        out.extend(rates);
        if k > n {
            out.push(if was > n { x[2 + was + n] } else { slope(x[1], rates) });
        }
        out
    }

    /// A bound on how fast the state can change: a norm of the state matrix \[1/s\].
    pub(crate) fn rate_bound(&self) -> f64 {
        let d = &self.dynamics;
        let rows = |m: &DMatrix<f64>| {
            m.row_iter().map(|r| r.iter().map(|v| v.abs()).sum()).fold(0.0, f64::max)
        };
        let inertia = self.motor.inertia_kg_m2();
        let all = |m: Option<&DMatrix<f64>>| m.map_or(0.0, rows);
        let stiffness: f64 = rows(&d.elastic) * 2.0 + 2.0 * d.coupling.abs().sum() / inertia;
        let damping = all(d.relative.as_ref()) * 2.0
            + all(d.absolute.as_ref())
            + 2.0 * d.coupling_rate.as_ref().map_or(0.0, |g| g.abs().sum()) / inertia;
        stiffness.sqrt() + self.motor.viscous_nm_s_per_rad() / inertia + damping
    }

    /// Frequency responses θ_i/θ_m at `omega_rad_s`, from the motor to each mass \[rad/rad\].
    ///
    /// On an undamped pole they are very large.
    ///
    /// # Source
    /// `[Feliu1989, eq. (16)]`, with damping added.
    pub fn tip_response(&self, omega_rad_s: f64) -> Vec<Complex64> {
        self.beam.response(Complex64::new(0.0, omega_rad_s)).angles
    }

    /// Frequency response θ_m/i at `omega_rad_s` \[rad/A\] of the linear part, without Coulomb friction.
    ///
    /// `G(jω) = K/(J·s² + V·s + C_t/θ_m)` with `s = jω`.
    ///
    /// ```
    /// # use lissom::{arm::Arm, beam::{LumpedBeam, Span}, drive::{Coulomb, Motor}};
    /// # let (l, m) = (0.2, 0.05);
    /// # let span = Span { length_m: l, flexural_rigidity_n_m2: 0.004, mass_kg: m, damping_n_s_per_m: 0.0 };
    /// # let beam = LumpedBeam::new(&[span]).unwrap();
    /// let motor = Motor::new(6e-4, 0.0, 0.25)?; // J, V, K
    /// let arm = Arm::new(beam, motor, Coulomb::symmetric(0.03)?).unwrap();
    /// let (w, rigid) = (1e-3, 6e-4 + m * l * l); // slowly, the arm turns as one body
    /// let g = arm.motor_response(w);
    /// assert!((g.re * rigid * w * w / -0.25 - 1.0).abs() < 1e-6);
    /// # Ok::<(), lissom::drive::DriveError>(())
    /// ```
    ///
    /// # Source
    /// `[Feliu1989, eqs. (13)-(16)]`; it is the G(ω) of (26) and (30).
    pub fn motor_response(&self, omega_rad_s: f64) -> Complex64 {
        let s = Complex64::new(0.0, omega_rad_s);
        let coupling = self.beam.response(s).coupling_nm_per_rad;
        self.motor.torque_constant_nm_per_a() / (self.motor.impedance(s) + coupling)
    }

    /// Poles of θ_m/i \[1/s\]: those of the whole arm without Coulomb friction.
    ///
    /// # Source
    /// `[Feliu1989, eqs. (13)-(15)]`
    pub fn poles(&self) -> Roots {
        self.beam.motor_poles(&self.motor)
    }

    /// Transfer function θ_m/i \[rad/A\] without Coulomb friction. Its zeros are the poles of
    /// the beam with the motor clamped.
    ///
    /// # Source
    /// `[Feliu1989, eqs. (13)-(15)]`; the form of (35).
    pub fn motor_function(&self) -> ZeroPoleGain {
        self.beam.motor_function(&self.motor)
    }

    /// Transfer function θ_i/i \[rad/A\] of mass `mass`, counted from 0 at the base, without Coulomb friction; `None`
    /// if there is no such mass.
    pub fn angle_function(&self, mass: usize) -> Option<ZeroPoleGain> {
        let angle = self.beam.angle_function(mass)?;
        Some(angle_per_current(&angle, &self.motor_function(), &self.motor))
    }

    /// State space model of the whole arm (13)-(15) without Coulomb friction.
    ///
    /// Inputs: current \[A\], tip force F_n \[N\], tip torque T_n \[N·m\]. Outputs: angle of the motor \[rad\], angle
    /// of each mass \[rad\], coupling torque \[N·m\]. The states are those of [`Arm`].
    ///
    /// # Source
    /// `[Feliu1989, eqs. (13)-(15)]`
    pub fn state_space(&self) -> StateSpace {
        let d = &self.dynamics;
        let (k, n, len) = (d.len(), self.beam.len(), self.state_len());
        let j = self.motor.inertia_kg_m2();
        let mut a = DMatrix::zeros(len, len);
        let mut unit = vec![0.0; len];
        let mut column = vec![0.0; len];
        for c in 0..len {
            unit[c] = 1.0;
            self.derivative_slipping(&unit, &mut column);
            a.column_mut(c).copy_from_slice(&column);
            unit[c] = 0.0;
        }
        let mut b = DMatrix::zeros(len, 3);
        b[(1, 0)] = self.motor.torque_constant_nm_per_a() / j;
        b[(1, 2)] = -d.coupling_torque / j;
        for i in 0..k {
            b[(2 + k + i, 1)] = d.force[i];
            b[(2 + k + i, 2)] = d.torque[i];
        }
        let mut c = DMatrix::zeros(n + 2, len);
        c[(0, 0)] = 1.0;
        for i in 0..n {
            c[(1 + i, 2 + i)] = 1.0;
        }
        for state in 0..len {
            unit[state] = 1.0;
            c[(n + 1, state)] = self.coupling_torque(&unit);
            unit[state] = 0.0;
        }
        let mut direct = DMatrix::zeros(n + 2, 3);
        direct[(n + 1, 2)] = d.coupling_torque;
        let angles = || (1..=n).map(|i| format!("theta_{i}_rad"));
        let slope = || (k > n).then(|| "tip_slope_rad".to_owned());
        let mut states = vec!["motor_rad".to_owned(), "motor_rad_per_s".to_owned()];
        states.extend(angles().chain(slope()));
        states.extend(angles().chain(slope()).map(|name| format!("{name}_per_s")));
        let mut outputs = vec!["motor_rad".to_owned()];
        outputs.extend(angles());
        outputs.push("coupling_torque_nm".to_owned());
        let inputs = ["current_a", "tip_force_n", "tip_torque_nm"];
        let inputs = inputs.map(str::to_owned).to_vec();
        StateSpace { a, b, c, d: direct, states, inputs, outputs }
    }
}
