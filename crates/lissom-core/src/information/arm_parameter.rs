//! The parameters of an arm for which a user can ask.

use crate::information::thresholds::DAMPING_LEAST;
use crate::replay::{ModalArm, Parameter};

/// A parameter of an arm for which a user can ask. Modes are counted from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ArmParameter {
    /// Coulomb friction, mean of both directions.
    Coulomb,
    /// Viscous friction.
    Viscous,
    /// Inertia of the motor's side.
    Inertia,
    /// Coupling between motor and beam.
    Coupling,
    /// Frequency of a mode with the motor clamped.
    Frequency(usize),
    /// Damping 2ζω of a mode: all kinds that it has, against the fixed frame, within the beam,
    /// and at the points of the tips.
    Damping(usize),
    /// Offset of friction: half the difference of forward and backward friction.
    Offset,
}

impl ArmParameter {
    /// All that an arm has, the offset left out.
    pub(crate) fn of(arm: &ModalArm) -> Vec<Self> {
        let mut all = vec![Self::Coulomb, Self::Viscous, Self::Inertia];
        if !arm.modes.is_empty() {
            all.push(Self::Coupling);
        }
        all.extend((0..arm.modes.len()).map(Self::Frequency));
        all.extend((0..arm.modes.len()).map(Self::Damping));
        all.retain(|parameter| parameter.value(arm) > 0.0);
        all
    }

    /// Name in results and messages.
    pub fn name(self) -> String {
        match self {
            Self::Coulomb => "Coulomb friction".to_owned(),
            Self::Viscous => "viscous friction".to_owned(),
            Self::Inertia => "inertia".to_owned(),
            Self::Coupling => "coupling".to_owned(),
            Self::Frequency(j) => format!("frequency of mode {}", j + 1),
            Self::Damping(j) => format!("damping of mode {}", j + 1),
            Self::Offset => "offset of friction".to_owned(),
        }
    }

    /// Value for an arm, in SI units.
    pub fn value(self, arm: &ModalArm) -> f64 {
        match self {
            Self::Coulomb => arm.coulomb_nm,
            Self::Viscous => Parameter::Viscous.of(arm),
            Self::Inertia => arm.inertia_kg_m2,
            Self::Coupling => arm.coupling_nm_per_rad(),
            Self::Frequency(j) => arm.modes[j].omega_rad_s,
            Self::Damping(j) => 2.0 * arm.damping_ratios()[j] * arm.modes[j].omega_rad_s,
            Self::Offset => arm.offset_nm,
        }
    }

    /// Reference for relative standard errors, in SI units: the value itself; for the offset, Coulomb friction; for the
    /// damping of a mode with ζ below 1/1000, 2ω/1000.
    pub fn size(self, arm: &ModalArm) -> f64 {
        match self {
            Self::Offset => arm.coulomb_nm,
            Self::Damping(j) => self.value(arm).max(2.0 * DAMPING_LEAST * arm.modes[j].omega_rad_s),
            _ => self.value(arm).abs(),
        }
    }

    /// Its derivative by a parameter; damping against the fixed frame stands for all of a mode that has
    /// some.
    pub(crate) fn slope(self, arm: &ModalArm, parameter: Parameter) -> f64 {
        let of = match (self, parameter) {
            (Self::Coulomb, Parameter::Coulomb)
            | (Self::Viscous, Parameter::Viscous)
            | (Self::Inertia, Parameter::Inertia)
            | (Self::Coupling, Parameter::Stiffness(_)) => true,
            (Self::Frequency(j), Parameter::Frequency(k))
            | (Self::Damping(j), Parameter::DampingGrounded(k)) => j == k,
            (Self::Damping(j), Parameter::DampingWithin(k)) => {
                j == k && arm.modes[j].grounded_per_s <= 0.0
            }
            _ => false,
        };
        f64::from(of)
    }
}
