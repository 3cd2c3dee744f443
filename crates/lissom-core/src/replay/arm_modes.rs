//! A lumped arm in the modes of its clamped beam, and the model of it that a replay uses.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use super::modal_arm::{MOST_MODES, ModalArm, Oscillator};
use crate::arm::Arm;
use crate::beam::BeamDynamics;
use crate::friction::DryTerms;

/// The modes of an arm of point masses, and its states in modal coordinates.
#[derive(Debug, Clone)]
pub struct ArmModes<'a> {
    arm: &'a Arm,
    dynamics: &'a BeamDynamics,
    omega_rad_s: Vec<f64>,
    stiffness_nm_per_rad: DVector<f64>,
    /// r_ij of coordinate i and mode j.
    shapes: DMatrix<f64>,
    /// From q_i − θ_m to ψ_j − θ_m.
    inverse: DMatrix<f64>,
}

impl<'a> ArmModes<'a> {
    /// Computes the modes; `None` if the modes of the beam are not distinct. A rigid joint has no modes.
    pub fn of(arm: &'a Arm) -> Option<Self> {
        let dynamics = arm.dynamics();
        let n = dynamics.len();
        let (omega_rad_s, shapes) = if n == 0 {
            (Vec::new(), Vec::new())
        } else {
            let elastic = &dynamics.elastic;
            ModalArm::modes_of(&-elastic, &vec![1.0; elastic.nrows()])?
        };
        let shapes = DMatrix::from_fn(n, n, |i, j| shapes[i][j]);
        let inverse = shapes.clone().try_inverse()?;
        let stiffness_nm_per_rad = -(shapes.transpose() * &dynamics.coupling);
        Some(Self { arm, dynamics, omega_rad_s, stiffness_nm_per_rad, shapes, inverse })
    }

    /// Natural frequency ω of each mode with the motor clamped, ascending \[rad/s\].
    pub fn omega_rad_s(&self) -> &[f64] {
        &self.omega_rad_s
    }

    /// Inertia k/ω² of a mode \[kg·m²\].
    pub fn inertia_kg_m2(&self, mode: usize) -> f64 {
        self.stiffness_nm_per_rad[mode] / (self.omega_rad_s[mode] * self.omega_rad_s[mode])
    }

    /// Builds a model with only the modes `kept`; the inertia of all others turns with the motor. The masses `tips` are
    /// its tips. Coupling of modes by dampers is neglected.
    pub fn cut(&self, kept: &[usize], tips: Range<usize>) -> ModalArm {
        let within = self.damping(self.dynamics.relative.as_ref());
        let grounded = self.damping(self.dynamics.absolute.as_ref());
        let left_out = (0..self.omega_rad_s.len()).filter(|j| !kept.contains(j));
        let mode = |&j: &usize| Oscillator {
            within_per_s: within[j].max(0.0),
            grounded_per_s: grounded[j].max(0.0),
            ..self.undamped(j)
        };
        let row = |i: usize| kept.iter().map(|j| self.shapes[(i, *j)]).collect();
        ModalArm {
            inertia_kg_m2: self.arm.motor.inertia_kg_m2()
                + left_out.map(|j| self.inertia_kg_m2(j)).sum::<f64>(),
            modes: kept.iter().map(mode).collect(),
            shapes: tips.map(row).collect(),
            ..self.rigid()
        }
    }

    /// All modes and masses, dampers where they are: at masses, or against the frame in each mode. `None` for
    /// a payload that turns beside dampers at masses.
    pub(super) fn whole(&self) -> Option<ModalArm> {
        let (n, masses) = (self.omega_rad_s.len(), self.arm.beam().len());
        let by_modes = self.arm.beam().lumped().is_none();
        let at_points_per_s = match &self.dynamics.absolute {
            _ if by_modes => Vec::new(),
            None if n == masses => vec![0.0; n],
            None => Vec::new(),
            Some(m) if n == masses => m.diagonal().iter().map(|g| -g).collect(),
            Some(_) => return None,
        };
        let within = self.damping(self.dynamics.relative.as_ref());
        let grounded = self.damping(self.dynamics.absolute.as_ref().filter(|_| by_modes));
        let mode = |j: usize| Oscillator {
            within_per_s: within[j],
            grounded_per_s: grounded[j],
            ..self.undamped(j)
        };
        let row = |i: usize| self.shapes.row(i).iter().copied().collect();
        Some(ModalArm {
            modes: (0..n).map(mode).collect(),
            shapes: (0..masses).map(row).collect(),
            at_points_per_s,
            ..self.rigid()
        })
    }

    /// State `[θ, θ̇, ψ_1, ψ̇_1, …]` of the modes `kept`, computed from the arm's state `[θ, θ̇, q_1.., q̇_1..]`:
    /// `q_i − θ = Σ r_ij·(ψ_j − θ)`.
    pub fn state(&self, kept: &[usize], x: &[f64]) -> Vec<f64> {
        let n = self.omega_rad_s.len();
        let modal = |q: &[f64], from: f64| &self.inverse * DVector::from_fn(n, |i, _| q[i] - from);
        let (angles, rates) = (modal(&x[2..2 + n], x[0]), modal(&x[2 + n..2 + 2 * n], x[1]));
        let mut state = vec![x[0], x[1]];
        state.extend(kept.iter().flat_map(|&j| [x[0] + angles[j], x[1] + rates[j]]));
        state
    }

    /// Diagonal of −r⁻¹·D·r \[1/s\].
    fn damping(&self, matrix: Option<&DMatrix<f64>>) -> DVector<f64> {
        let zero = || DVector::zeros(self.omega_rad_s.len());
        matrix.map_or_else(zero, |m| -(&self.inverse * m * &self.shapes).diagonal())
    }

    fn undamped(&self, mode: usize) -> Oscillator {
        Oscillator {
            omega_rad_s: self.omega_rad_s[mode],
            stiffness_nm_per_rad: self.stiffness_nm_per_rad[mode],
            within_per_s: 0.0,
            grounded_per_s: 0.0,
        }
    }

    fn rigid(&self) -> ModalArm {
        let (motor, friction) = (&self.arm.motor, &self.arm.coulomb);
        ModalArm {
            inertia_kg_m2: motor.inertia_kg_m2(),
            viscous_nm_s_per_rad: [motor.viscous_nm_s_per_rad(); 2],
            coulomb_nm: 0.5 * (friction.forward() + friction.backward()),
            offset_nm: 0.5 * (friction.forward() - friction.backward()),
            dry_terms: DryTerms::default(),
            modes: Vec::new(),
            shapes: Vec::new(),
            at_points_per_s: Vec::new(),
            gravity: None,
            torque_ripples: Vec::new(),
            command_lag_s: 0.0,
            tip_lags_s: Vec::new(),
        }
    }
}

impl ModalArm {
    /// Builds the model of an arm of point masses with all its modes; all masses are tips, in order from the motor.
    ///
    /// `None` for an arm without distinct modes, with more than [`MOST_MODES`] modes, or with both a payload that
    /// resists turning and dampers at masses.
    pub fn of_arm(arm: &Arm) -> Option<Self> {
        let modes = ArmModes::of(arm)?;
        if modes.omega_rad_s().len() > MOST_MODES { None } else { modes.whole() }
    }
}
