//! The beam of an arm: given by its spans, given by its modes, or absent.

use nalgebra::DMatrix;
use num_complex::Complex64;

use super::transfer::driven;
use super::{
    Base, BeamDynamics, BeamError, BeamResponse, LumpedBeam, ModalBeam, Mode, Payload, Roots, Span,
    motor_function, motor_poles,
};
use crate::drive::Motor;
use crate::lti::ZeroPoleGain;

const NO_PAYLOAD: &Payload = &Payload { mass_kg: 0.0, inertia_kg_m2: 0.0, offset_m: 0.0 };

/// The beam of an arm.
///
/// Transfer functions, poles and responses below are those of the linear arm: Coulomb friction is left out.
#[derive(Debug, Clone)]
pub enum Beam {
    /// Given by its spans and point masses.
    Lumped(LumpedBeam),
    /// Given by its modes at some points. It has no lengths, so no payload, force or torque can be put on its tip.
    Modal(ModalBeam),
    /// No beam: the joint drives a rigid load, whose inertia is part of the motor's.
    Rigid,
}

impl From<LumpedBeam> for Beam {
    fn from(beam: LumpedBeam) -> Self {
        Self::Lumped(beam)
    }
}

impl From<ModalBeam> for Beam {
    fn from(beam: ModalBeam) -> Self {
        Self::Modal(beam)
    }
}

impl Beam {
    /// The lumped beam, if this is one.
    pub fn lumped(&self) -> Option<&LumpedBeam> {
        match self {
            Self::Lumped(beam) => Some(beam),
            Self::Modal(_) | Self::Rigid => None,
        }
    }

    /// Number of masses or points; zero for a rigid joint.
    pub fn len(&self) -> usize {
        match self {
            Self::Lumped(beam) => beam.len(),
            Self::Modal(beam) => beam.len(),
            Self::Rigid => 0,
        }
    }
    /// Whether there is no beam (a rigid joint).
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// Spans, from base to tip; empty unless the beam is lumped.
    pub fn spans(&self) -> &[Span] {
        self.lumped().map_or(&[], LumpedBeam::spans)
    }
    /// Distance of each mass from the motor's axis \[m\]; empty unless the beam is lumped.
    pub fn position_m(&self) -> &[f64] {
        self.lumped().map_or(&[], LumpedBeam::position_m)
    }
    /// Payload at the tip, in addition to the last mass; zero unless the beam is lumped.
    pub fn payload(&self) -> &Payload {
        self.lumped().map_or(NO_PAYLOAD, LumpedBeam::payload)
    }

    /// Returns this beam with a payload at its tip, in addition to the last mass.
    ///
    /// # Errors
    /// [`BeamError::Payload`] if its mass or inertia is negative, or one of its quantities is not finite;
    /// [`BeamError::NoTip`] if the beam is modal or absent.
    pub fn with_payload(self, payload: Payload) -> Result<Self, BeamError> {
        match self {
            Self::Lumped(beam) => beam.with_payload(payload).map(Self::Lumped),
            Self::Modal(_) | Self::Rigid => Err(BeamError::NoTip),
        }
    }

    /// Inertia about the motor's axis when the beam turns as one rigid body \[kg·m²\].
    pub fn inertia_kg_m2(&self) -> f64 {
        match self {
            Self::Lumped(beam) => beam.inertia_kg_m2(),
            Self::Modal(beam) => beam.inertia_kg_m2(),
            Self::Rigid => 0.0,
        }
    }

    /// The lowest `count` natural frequencies, ascending \[rad/s\], without damping.
    pub fn frequencies_rad_s(&self, base: Base, count: usize) -> Vec<f64> {
        match self {
            Self::Lumped(beam) => beam.frequencies_rad_s(base, count),
            Self::Modal(beam) => beam.frequencies_rad_s(base, count),
            Self::Rigid => Vec::new(),
        }
    }

    /// All natural frequencies with the motor clamped, ascending \[rad/s\], without damping.
    pub fn natural_frequencies_rad_s(&self) -> Vec<f64> {
        self.frequencies_rad_s(Base::Clamped, usize::MAX)
    }

    /// The lowest `count` modes with the motor clamped.
    pub fn modes(&self, count: usize) -> Vec<Mode> {
        match self {
            Self::Lumped(beam) => beam.modes(count),
            Self::Modal(beam) => beam.modes(count),
            Self::Rigid => Vec::new(),
        }
    }

    /// Poles of θ_i/θ_m \[1/s\], with damping.
    pub fn poles(&self) -> Roots {
        match self {
            Self::Lumped(beam) => beam.poles(),
            Self::Modal(beam) => beam.poles(),
            Self::Rigid => Roots { s: Vec::new(), missing: 0 },
        }
    }

    /// Poles of θ_m/i \[1/s\] on a motor, without Coulomb friction.
    pub fn motor_poles(&self, motor: &Motor) -> Roots {
        match self {
            Self::Lumped(beam) => motor_poles(beam, motor),
            Self::Modal(beam) => beam.motor_poles(motor),
            Self::Rigid => {
                let slowing = motor.viscous_nm_s_per_rad() / motor.inertia_kg_m2();
                Roots { s: vec![Complex64::ZERO, Complex64::from(-slowing)], missing: 0 }
            }
        }
    }

    /// Transfer function θ_m/i \[rad/A\] on a motor, without Coulomb friction.
    pub fn motor_function(&self, motor: &Motor) -> ZeroPoleGain {
        match self {
            Self::Lumped(beam) => motor_function(beam, motor),
            Self::Modal(beam) => beam.motor_function(motor),
            Self::Rigid => driven(self.poles(), self.motor_poles(motor), motor),
        }
    }

    /// Transfer function θ_i/θ_m \[1\] of mass or point `index`, counted from 0; `None` if there is none.
    pub fn angle_function(&self, index: usize) -> Option<ZeroPoleGain> {
        match self {
            Self::Lumped(beam) => beam.angle_function(index),
            Self::Modal(beam) => beam.angle_function(index),
            Self::Rigid => None,
        }
    }

    /// Transfer function C_t/θ_m \[N·m/rad\].
    pub fn coupling_function(&self) -> ZeroPoleGain {
        match self {
            Self::Lumped(beam) => beam.coupling_function(),
            Self::Modal(beam) => beam.coupling_function(),
            Self::Rigid => {
                ZeroPoleGain { zeros: Vec::new(), poles: Vec::new(), gain: 0.0, missing: 0 }
            }
        }
    }

    /// Computes θ_i/θ_m of every mass or point, and C_t/θ_m \[N·m/rad\], at the complex frequency `s` \[1/s\].
    pub fn response(&self, s: Complex64) -> BeamResponse {
        match self {
            Self::Lumped(beam) => beam.response(s),
            Self::Modal(beam) => beam.response(s),
            Self::Rigid => {
                BeamResponse { angles: Vec::new(), coupling_nm_per_rad: Complex64::ZERO }
            }
        }
    }

    /// Its equation of motion.
    pub(crate) fn dynamics(&self) -> Result<BeamDynamics, BeamError> {
        match self {
            Self::Lumped(beam) => beam.dynamics(),
            Self::Modal(beam) => Ok(beam.dynamics()),
            Self::Rigid => Ok(BeamDynamics::none()),
        }
    }

    /// The masses of its equation's coordinates, angles \[kg·m²\].
    pub(crate) fn mass_matrix(&self) -> DMatrix<f64> {
        match self {
            Self::Lumped(beam) => beam.mass_matrix(),
            Self::Modal(beam) => beam.mass_matrix(),
            Self::Rigid => DMatrix::zeros(0, 0),
        }
    }
}
