//! The beam of an arm: by its spans, by its modes, or none.

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
#[derive(Debug, Clone)]
pub enum Beam {
    /// By its spans and point masses.
    Lumped(LumpedBeam),
    /// By its modes at some points; it has no lengths, and nothing acts on its tip.
    Modal(ModalBeam),
    /// None: the joint carries a rigid load, whose inertia is counted with the motor's.
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
    /// With its spans, if it is known by them.
    pub fn lumped(&self) -> Option<&LumpedBeam> {
        match self {
            Self::Lumped(beam) => Some(beam),
            Self::Modal(_) | Self::Rigid => None,
        }
    }

    /// Number of masses or points; zero of a rigid joint.
    pub fn len(&self) -> usize {
        match self {
            Self::Lumped(beam) => beam.len(),
            Self::Modal(beam) => beam.len(),
            Self::Rigid => 0,
        }
    }
    /// Whether the joint is rigid.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// Spans, base to tip; none of a beam known by its modes.
    pub fn spans(&self) -> &[Span] {
        self.lumped().map_or(&[], LumpedBeam::spans)
    }
    /// Distance of each mass from the motor's axis \[m\]; none of a beam known by its modes.
    pub fn position_m(&self) -> &[f64] {
        self.lumped().map_or(&[], LumpedBeam::position_m)
    }
    /// What the tip carries beside the last mass; nothing that is known of a beam known by its modes.
    pub fn payload(&self) -> &Payload {
        self.lumped().map_or(NO_PAYLOAD, LumpedBeam::payload)
    }

    /// The same beam with a payload at its tip, beside the last mass.
    ///
    /// # Errors
    /// [`BeamError::Payload`] where a quantity is negative or not finite, [`BeamError::NoTip`] where the beam is
    /// known by its modes or there is none.
    pub fn with_payload(self, payload: Payload) -> Result<Self, BeamError> {
        match self {
            Self::Lumped(beam) => beam.with_payload(payload).map(Self::Lumped),
            Self::Modal(_) | Self::Rigid => Err(BeamError::NoTip),
        }
    }

    /// Its inertia about the motor's axis as one body \[kg·m²\].
    pub fn inertia_kg_m2(&self) -> f64 {
        match self {
            Self::Lumped(beam) => beam.inertia_kg_m2(),
            Self::Modal(beam) => beam.inertia_kg_m2(),
            Self::Rigid => 0.0,
        }
    }

    /// The lowest `count` natural frequencies, ascending \[rad/s\], damping left out.
    pub fn frequencies_rad_s(&self, base: Base, count: usize) -> Vec<f64> {
        match self {
            Self::Lumped(beam) => beam.frequencies_rad_s(base, count),
            Self::Modal(beam) => beam.frequencies_rad_s(base, count),
            Self::Rigid => Vec::new(),
        }
    }

    /// All natural frequencies with the motor clamped, ascending \[rad/s\], damping left out.
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

    /// Poles of θ_i/θ_m \[1/s\], damping included.
    pub fn poles(&self) -> Roots {
        match self {
            Self::Lumped(beam) => beam.poles(),
            Self::Modal(beam) => beam.poles(),
            Self::Rigid => Roots { s: Vec::new(), missing: 0 },
        }
    }

    /// Poles of θ_m/i \[1/s\] on a motor, Coulomb friction left out.
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

    /// θ_m/i \[rad/A\] on a motor, Coulomb friction left out.
    pub fn motor_function(&self, motor: &Motor) -> ZeroPoleGain {
        match self {
            Self::Lumped(beam) => motor_function(beam, motor),
            Self::Modal(beam) => beam.motor_function(motor),
            Self::Rigid => driven(self.poles(), self.motor_poles(motor), motor),
        }
    }

    /// θ_i/θ_m of mass or point `index`, from 0; `None` where there is none.
    pub fn angle_function(&self, index: usize) -> Option<ZeroPoleGain> {
        match self {
            Self::Lumped(beam) => beam.angle_function(index),
            Self::Modal(beam) => beam.angle_function(index),
            Self::Rigid => None,
        }
    }

    /// C_t/θ_m \[N·m/rad\].
    pub fn coupling_function(&self) -> ZeroPoleGain {
        match self {
            Self::Lumped(beam) => beam.coupling_function(),
            Self::Modal(beam) => beam.coupling_function(),
            Self::Rigid => {
                ZeroPoleGain { zeros: Vec::new(), poles: Vec::new(), gain: 0.0, missing: 0 }
            }
        }
    }

    /// θ_i/θ_m of every mass or point and C_t/θ_m at `s` \[1/s\].
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
