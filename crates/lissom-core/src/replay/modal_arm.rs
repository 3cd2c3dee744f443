//! The model that is replayed: motor, dry friction, and the beam as oscillators.

use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

use crate::eigenvalues::eigenvalues;
use crate::friction::DryTerms;
use crate::load::{GravityLoad, PositionTorque, TorqueRipple};

/// Largest number of modes of a replayed arm.
pub const MOST_MODES: usize = 4;
/// Most that an arm's fastest rate may turn in a sample \[rad\]: a simulation takes so many more parts of a sample,
/// and no real arm is logged so coarsely.
pub(crate) const TURN_MOST: f64 = 3000.0;

/// One mode of the clamped beam, as an oscillator of inertia k/ω² on the motor.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Oscillator {
    /// Natural frequency ω with the motor clamped \[rad/s\].
    #[cfg_attr(feature = "serde", serde(rename = "natural_frequency_rad_s"))]
    pub omega_rad_s: f64,
    /// Stiffness k: coupling torque of this mode per angle of the motor, with the masses held \[N·m/rad\].
    #[cfg_attr(feature = "serde", serde(rename = "stiffness"))]
    pub stiffness_nm_per_rad: f64,
    /// Damping within the beam, d = 2ζω \[1/s\].
    #[cfg_attr(feature = "serde", serde(rename = "damping_within_per_s"))]
    pub within_per_s: f64,
    /// Damping against the fixed frame, a = 2ζω \[1/s\].
    #[cfg_attr(feature = "serde", serde(rename = "damping_grounded_per_s"))]
    pub grounded_per_s: f64,
}

impl Oscillator {
    /// Inertia k/ω² of the oscillator \[kg·m²\].
    pub fn inertia_kg_m2(&self) -> f64 {
        self.stiffness_nm_per_rad / (self.omega_rad_s * self.omega_rad_s)
    }

    /// `d·s + ω²`: what the motor's angle does to it.
    fn driven(&self, s: Complex64) -> Complex64 {
        s * self.within_per_s + self.omega_rad_s * self.omega_rad_s
    }

    /// All of its own damping, 2ζω with the motor clamped.
    fn damping_per_s(&self) -> f64 {
        self.within_per_s + self.grounded_per_s
    }
}

/// A model of an arm in modal coordinates: the motor with its friction, and the beam as oscillators on it.
///
/// ```text
/// J·θ̈ = τ − g_s·sin θ_log − g_c·cos θ_log − Σ_r B_r·cos k_rθ_log + C_r·sin k_rθ_log − V_±·θ̇ − F_± − Σ k_j·(θ − ψ_j) + (k_j·d_j/ω_j²)·(θ̇ − ψ̇_j)
/// ψ̈_j = ω_j²·(θ − ψ_j) + d_j·(θ̇ − ψ̇_j) − a_j·ψ̇_j − Σ_l (r⁻¹·diag(c)·r)_jl·ψ̇_l
/// θ_i = θ + Σ r_ij·(ψ_j − θ)
/// ```
///
/// θ is the angle of the motor, ψ_j the angle of oscillator j and θ_i the angle of tip i \[rad\]; τ is the torque
/// of the command \[N·m\]. F_± is dry friction, V_± viscous friction of the present direction. k_j, ω_j, d_j and
/// a_j are the stiffness, frequency and damping of oscillator j ([`Oscillator`]); c_i is the damping of the point
/// of tip i against the fixed frame, possible if there are as many tips as modes. θ_log is the logged angle of the
/// motor, so that gravity and torque ripples are inputs like the command, linear between samples, and the equations stay
/// linear. θ_i is read later by `tip_lags_s`.
///
/// Any beam with modes has this form, for any distribution of its mass: oscillator j is the clamped mode j, and `r_ij`
/// its share at point i. Σ_j r_ij = 1 if all modes are included. On linear axes m, N and kg replace rad, N·m and kg·m².
///
/// # Source
/// `[Feliu1989, eqs. (14), (15), (17), (18)]` in modal coordinates.
#[derive(Debug, Clone, PartialEq)]
pub struct ModalArm {
    /// Inertia J \[kg·m²\].
    pub inertia_kg_m2: f64,
    /// Viscous friction V_+ forward and V_− backward \[N·m·s/rad\].
    pub viscous_nm_s_per_rad: [f64; 2],
    /// Coulomb friction, mean of both directions, (F_+ − F_−)/2 \[N·m\].
    pub coulomb_nm: f64,
    /// Offset (F_+ + F_−)/2 \[N·m\]: a constant load, or a difference of friction by direction.
    pub offset_nm: f64,
    /// Terms of dry friction besides Coulomb friction and offset; part of F_±.
    pub dry_terms: DryTerms,
    /// Modes of the beam with the motor clamped.
    pub modes: Vec<Oscillator>,
    /// r_ij of tip i (outer index) and mode j (inner index) \[1\].
    pub shapes: Vec<Vec<f64>>,
    /// Damping c_i at the point of each tip \[1/s\]; empty unless there are as many tips as modes.
    pub at_points_per_s: Vec<f64>,
    /// Gravity on the motor. It acts in replays only; linear responses do not contain it.
    pub gravity: Option<GravityLoad>,
    /// Torque ripples (cogging) of the motor. They act in replays only, like gravity.
    pub torque_ripples: Vec<TorqueRipple>,
    /// Lag of the command \[s\]: the torque acts this much later than it is logged.
    pub command_lag_s: f64,
    /// Lag of each tip \[s\]: a reading shows the angle of its point this much earlier; empty if there are no lags.
    pub tip_lags_s: Vec<f64>,
}

impl ModalArm {
    /// Gravity and torque ripples together.
    pub fn position_torque(&self) -> PositionTorque {
        PositionTorque::new(self.gravity, &self.torque_ripples)
    }

    /// Natural frequency |s| \[rad/s\] and damping ratio −Re s/|s| of each mode with the motor clamped, ascending. If
    /// there are dampers at points, they couple the oscillators, and |s| differs from ω.
    pub fn clamped_modes(&self) -> Vec<(f64, f64)> {
        let n = self.modes.len();
        let coupled = self.points_in_modes().and_then(|points| {
            // ω_j·ψ_j beside ψ̇_j: of one size.
            let a = DMatrix::from_fn(2 * n, 2 * n, |i, k| match (i < n, k < n) {
                (true, false) if k - n == i => self.modes[i].omega_rad_s,
                (false, true) if i - n == k => -self.modes[k].omega_rad_s,
                (false, false) => {
                    let own = if i == k { self.modes[i - n].damping_per_s() } else { 0.0 };
                    -own - points[(i - n, k - n)]
                }
                _ => 0.0,
            });
            let upper: Vec<_> = eigenvalues(&a)?.into_iter().filter(|s| s.im > 0.0).collect();
            let modes = upper.iter().map(|s| (s.norm(), -s.re / s.norm())).collect::<Vec<_>>();
            (modes.len() == n).then_some(modes)
        });
        let mut modes = coupled.unwrap_or_else(|| {
            let omega = self.modes.iter().map(|m| m.omega_rad_s);
            omega.zip(self.damping_ratios()).collect()
        });
        modes.sort_by(|a, b| a.0.total_cmp(&b.0));
        modes
    }

    /// ζ_j of every oscillator with the motor clamped, to first order in the dampers at points \[1\].
    pub fn damping_ratios(&self) -> Vec<f64> {
        let at_points = self.points_in_modes();
        self.modes
            .iter()
            .enumerate()
            .map(|(j, m)| {
                let points = at_points.as_ref().map_or(0.0, |p| p[(j, j)]);
                0.5 * (m.damping_per_s() + points) / m.omega_rad_s
            })
            .collect()
    }

    /// r⁻¹·diag(c)·r, where there are dampers at points.
    pub(crate) fn points_in_modes(&self) -> Option<DMatrix<f64>> {
        let n = self.modes.len();
        if n == 0 || self.at_points_per_s.len() != n {
            return None;
        }
        let r = DMatrix::from_fn(n, n, |i, j| self.shapes[i][j]);
        let damped = DMatrix::from_fn(n, n, |i, j| self.at_points_per_s[i] * self.shapes[i][j]);
        r.lu().solve(&damped)
    }

    /// The same arm without modes of stiffness zero, which only tips show.
    #[must_use]
    pub fn without_light_modes(mut self) -> Self {
        let is_heavy = |mode: &Oscillator| mode.stiffness_nm_per_rad != 0.0;
        let heavy: Vec<usize> =
            (0..self.modes.len()).filter(|j| is_heavy(&self.modes[*j])).collect();
        if heavy.len() < self.modes.len() {
            self.modes = heavy.iter().map(|j| self.modes[*j]).collect();
            let of_heavy = |row: &Vec<f64>| heavy.iter().map(|j| row[*j]).collect();
            self.shapes = self.shapes.iter().map(of_heavy).collect();
            self.at_points_per_s.clear();
        }
        self
    }

    /// Coupling Σk_j: torque per angle of the motor with the masses of the beam held \[N·m/rad\].
    pub fn coupling_nm_per_rad(&self) -> f64 {
        self.modes.iter().map(|m| m.stiffness_nm_per_rad).sum()
    }

    /// Coupling κ_i of each tip \[N·m/rad\], `C_t = Σκ_i(θ_m − θ_i)`: κ·r = k. `None` unless
    /// there are as many tips as modes.
    pub fn coupling_by_tip(&self) -> Option<Vec<f64>> {
        self.by_tip(|mode| mode.stiffness_nm_per_rad)
    }

    /// Torque of damping within the beam by tip, κ'_i \[N·m·s/rad\]: `C_t = Σκ_i(θ_m − θ_i) + κ'_i(θ̇_m − θ̇_i)`, where
    /// `κ'·r = k·d/ω²`. `None` unless there are as many tips as modes.
    pub fn coupling_rate_by_tip(&self) -> Option<Vec<f64>> {
        self.by_tip(|mode| {
            mode.stiffness_nm_per_rad * mode.within_per_s / (mode.omega_rad_s * mode.omega_rad_s)
        })
    }

    /// What each tip carries of a torque that is `of_mode`'s sum; `None` unless there are as many tips as modes.
    fn by_tip(&self, of_mode: impl Fn(&Oscillator) -> f64) -> Option<Vec<f64>> {
        let n = self.modes.len();
        if self.shapes.len() != n || n == 0 {
            return None;
        }
        let shares = DMatrix::from_fn(n, n, |j, i| self.shapes[i][j]);
        let torque = DVector::from_fn(n, |j, _| of_mode(&self.modes[j]));
        Some(shares.lu().solve(&torque)?.iter().copied().collect())
    }

    /// Frequency response θ_m per torque at ω, without dry friction \[rad/(N·m)\]:
    /// `1/(J·s² + V·s + Σ k_j(1 + d_j·s/ω_j²)·(1 − ψ_j/θ))` at s = jω. V is the mean of both directions.
    pub fn motor_response(&self, omega_rad_s: f64) -> Complex64 {
        let s = Complex64::new(0.0, omega_rad_s);
        let [forward, backward] = self.viscous_nm_s_per_rad;
        let rigid = s * (s * self.inertia_kg_m2 + 0.5 * (forward + backward));
        let pull = |(m, psi): (&Oscillator, &Complex64)| {
            let square = m.omega_rad_s * m.omega_rad_s;
            m.stiffness_nm_per_rad * m.driven(s) / square * (1.0 - psi)
        };
        let follow = self.follow(s);
        1.0 / self.modes.iter().zip(follow.iter()).map(pull).fold(rigid, |sum, p| sum + p)
    }

    /// Frequency response θ_i/θ_m of a tip at ω, `1 + Σ r_ij·(ψ_j/θ − 1)` at s = jω \[1\].
    ///
    /// # Panics
    /// If there is no such tip.
    pub fn tip_response(&self, tip: usize, omega_rad_s: f64) -> Complex64 {
        let follow = self.follow(Complex64::new(0.0, omega_rad_s));
        let shown = self.shapes[tip].iter().zip(follow.iter()).map(|(r, psi)| r * (psi - 1.0));
        shown.fold(Complex64::ONE, |sum, p| sum + p)
    }

    /// ψ_j/θ of every mode.
    fn follow(&self, s: Complex64) -> DVector<Complex64> {
        let n = self.modes.len();
        let points = self.points_in_modes();
        let own = |m: &Oscillator| s * (s + m.damping_per_s()) + m.omega_rad_s * m.omega_rad_s;
        let left = DMatrix::from_fn(n, n, |i, j| {
            let points = s * points.as_ref().map_or(0.0, |p| p[(i, j)]);
            if i == j { own(&self.modes[i]) + points } else { points }
        });
        let right = DVector::from_fn(n, |j, _| self.modes[j].driven(s));
        // A factorisation of nothing is refused by the library.
        let solved = if n == 0 { None } else { left.lu().solve(&right) };
        solved.unwrap_or_else(|| DVector::zeros(n))
    }

    /// A bound on how fast the state can change \[1/s\]: frequencies and the rates of all damping.
    pub(crate) fn rate_bound(&self) -> f64 {
        let j = self.inertia_kg_m2;
        let most = |a: f64, b: f64| if b.is_nan() { b } else { a.max(b) };
        let viscous = self.viscous_nm_s_per_rad.iter().map(|v| v.abs() / j).fold(0.0, most);
        let of_mode = |m: &Oscillator| {
            let carried = m.stiffness_nm_per_rad.abs() / (j * m.omega_rad_s * m.omega_rad_s);
            m.omega_rad_s * (1.0 + carried).sqrt()
                + m.within_per_s.abs() * (1.0 + carried)
                + m.grounded_per_s.abs()
        };
        let modes = self.modes.iter().map(of_mode).sum::<f64>();
        viscous + modes + self.at_points_per_s.iter().map(|c| c.abs()).fold(0.0, most)
    }

    /// Modes and shapes of `θ̈_i = −Σ_l K_il·(θ_l − θ_m) + (1 − s_i)·θ̈_m − …`, with the rows of K by tip \[1/s²\]:
    /// `(ω_j, r_ij)`, ascending in frequency. `None` unless all frequencies are real, positive and distinct.
    ///
    /// Each column of r is an eigenvector of K. The columns are scaled so that row i adds up to s_i: one if there are no
    /// further modes, since all points turn with the motor if nothing is deflected (property 2, B = −A·1).
    pub fn modes_of(stiffness: &DMatrix<f64>, sums: &[f64]) -> Option<(Vec<f64>, Vec<Vec<f64>>)> {
        let n = stiffness.nrows();
        let mut squares: Vec<f64> = eigenvalues(stiffness)?
            .into_iter()
            .map(|z| if z.im.abs() < 1e-9 * z.norm() { z.re } else { f64::NAN })
            .collect();
        squares.sort_by(f64::total_cmp);
        if n == 0 || squares.iter().any(|s| !(*s > 0.0 && s.is_finite())) {
            return None;
        }
        let mut vectors = DMatrix::zeros(n, n);
        for (j, square) in squares.iter().enumerate() {
            vectors.set_column(j, &eigenvector(stiffness, *square)?);
        }
        let scale = vectors.clone().lu().solve(&DVector::from_column_slice(sums))?;
        let shapes = (0..n).map(|i| (0..n).map(|j| vectors[(i, j)] * scale[j]).collect()).collect();
        Some((squares.iter().map(|s| s.sqrt()).collect(), shapes))
    }
}

/// Eigenvector of an eigenvalue that is known to rounding: inverse iteration beside it.
fn eigenvector(matrix: &DMatrix<f64>, value: f64) -> Option<DVector<f64>> {
    let n = matrix.nrows();
    let shift = value * (1.0 + 1e-12) + f64::MIN_POSITIVE;
    let lu = (matrix - DMatrix::identity(n, n) * shift).lu();
    let mut vector = DVector::from_fn(n, |i, _| 1.0 + 0.3 * i as f64);
    for _ in 0..3 {
        vector = lu.solve(&vector)?.normalize();
    }
    vector.iter().all(|v| v.is_finite()).then_some(vector)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn modes_of_two_masses_give_back_their_matrix() {
        let k = DMatrix::from_row_slice(2, 2, &[900.0, -250.0, -700.0, 400.0]);
        let (omega, shapes) = ModalArm::modes_of(&k, &[1.0; 2]).unwrap();
        let r = DMatrix::from_fn(2, 2, |i, j| shapes[i][j]);
        let squares = DMatrix::from_diagonal(&DVector::from_fn(2, |j, _| omega[j] * omega[j]));
        let back = &r * squares * r.clone().try_inverse().unwrap();
        assert!((back - k).norm() < 1e-9);
        assert!((shapes[0].iter().sum::<f64>() - 1.0).abs() < 1e-12 && omega[0] < omega[1]);
    }

    #[test]
    fn a_beam_that_would_push_has_no_modes() {
        assert!(ModalArm::modes_of(&DMatrix::from_element(1, 1, -4.0), &[1.0]).is_none());
    }
}
