//! The parameters of a replayed arm.

use super::modal_arm::ModalArm;
use crate::friction::FrictionNumber;
use crate::record::Channels;

/// A parameter of a [`ModalArm`]. Modes and tips are counted from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Parameter {
    /// Inertia J \[kg·m²\].
    Inertia,
    /// Viscous friction, mean of both directions \[N·m·s/rad\].
    Viscous,
    /// Half the difference of viscous friction by direction, (V_+ − V_−)/2 \[N·m·s/rad\].
    ViscousDifference,
    /// Frequency ω of a mode \[rad/s\].
    Frequency(usize),
    /// Stiffness k of a mode \[N·m/rad\].
    Stiffness(usize),
    /// Damping d within the beam, of a mode \[1/s\].
    DampingWithin(usize),
    /// Damping a against the fixed frame, of a mode \[1/s\].
    DampingGrounded(usize),
    /// Damping c at the point of a tip, against the fixed frame \[1/s\].
    DampingAtPoint(usize),
    /// Coulomb friction, mean of both directions \[N·m\].
    Coulomb,
    /// Offset of friction \[N·m\].
    Offset,
    /// A parameter of the friction terms besides Coulomb friction and offset.
    Friction(FrictionNumber),
    /// Gravity per sin θ, g_s \[N·m\].
    GravitySine,
    /// Gravity per cos θ, g_c \[N·m\].
    GravityCosine,
    /// Lag of the command \[s\].
    CommandLag,
    /// Lag of a tip's readings relative to the motor's \[s\].
    TipLag(usize),
    /// Share r of a tip (first index) and a mode (second index) \[1\].
    Shape(usize, usize),
}

/// What a parameter enters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Enters {
    /// The arm's matrices.
    Matrices,
    /// Friction's torque on the motor.
    Friction,
    /// A torque on the motor that does not depend on its state.
    Load,
    /// When the torque acts.
    Lag,
    /// What a tip sees of the state.
    Output,
}

impl Parameter {
    pub(crate) fn enters(self, arm: &ModalArm) -> Enters {
        match self {
            // Dampers at points are in the modes by the shapes.
            Self::Shape(..) if !arm.at_points_per_s.is_empty() => Enters::Matrices,
            Self::Inertia
            | Self::Viscous
            | Self::ViscousDifference
            | Self::Frequency(_)
            | Self::Stiffness(_)
            | Self::DampingWithin(_)
            | Self::DampingGrounded(_)
            | Self::DampingAtPoint(_) => Enters::Matrices,
            Self::Coulomb | Self::Offset | Self::Friction(_) => Enters::Friction,
            Self::GravitySine | Self::GravityCosine => Enters::Load,
            Self::CommandLag => Enters::Lag,
            Self::Shape(..) | Self::TipLag(_) => Enters::Output,
        }
    }

    /// Whether the parameter is positive and may span decades, so that a search changes its logarithm.
    pub fn is_scale(self) -> bool {
        match self {
            Self::Inertia | Self::Frequency(_) | Self::Stiffness(_) => true,
            Self::Friction(number) => number.is_scale(),
            _ => false,
        }
    }

    /// Whether the parameter is a damping of the beam, of any kind.
    pub fn is_damper(self) -> bool {
        matches!(self, Self::DampingWithin(_) | Self::DampingGrounded(_) | Self::DampingAtPoint(_))
    }

    /// Typical size for an arm, in the parameter's own unit: its value if it is positive, otherwise
    /// a size that follows from other parameters.
    pub fn size(self, arm: &ModalArm) -> f64 {
        let positive = |value: f64, or: f64| if value > 0.0 { value } else { or };
        let first = arm.modes.first().map_or(1.0, |m| m.omega_rad_s);
        match self {
            Self::Viscous => positive(self.of(arm), 0.01 * arm.inertia_kg_m2 * first),
            Self::Coulomb | Self::Offset | Self::GravitySine | Self::GravityCosine => {
                positive(arm.coulomb_nm, arm.inertia_kg_m2 * first * first)
            }
            Self::Friction(number) if number.is_torque() => Self::Coulomb.size(arm),
            // A damping ratio of a hundredth.
            Self::DampingWithin(j) | Self::DampingGrounded(j) => 0.02 * arm.modes[j].omega_rad_s,
            Self::Inertia | Self::Stiffness(_) | Self::Frequency(_) | Self::Friction(_) => {
                positive(self.of(arm).abs(), 1.0)
            }
            Self::CommandLag => positive(self.of(arm), 1e-3),
            Self::TipLag(_) => positive(self.of(arm).abs(), 1e-3),
            _ => 1.0,
        }
    }

    /// Name in results; modes and tips are counted from 1.
    pub fn name(self) -> String {
        match self {
            Self::Inertia => "inertia".to_owned(),
            Self::Viscous => "viscous".to_owned(),
            Self::ViscousDifference => "viscous-by-direction".to_owned(),
            Self::Frequency(j) => format!("frequency-{}", j + 1),
            Self::Stiffness(j) => format!("stiffness-{}", j + 1),
            Self::DampingWithin(j) => format!("damping-within-{}", j + 1),
            Self::DampingGrounded(j) => format!("damping-grounded-{}", j + 1),
            Self::DampingAtPoint(i) => format!("damping-at-point-{}", i + 1),
            Self::Coulomb => "coulomb".to_owned(),
            Self::Offset => "offset".to_owned(),
            Self::Friction(number) => number.name(),
            Self::GravitySine => "gravity-sine".to_owned(),
            Self::GravityCosine => "gravity-cosine".to_owned(),
            Self::CommandLag => "command-lag".to_owned(),
            Self::TipLag(i) => format!("tip-lag-{}", i + 1),
            Self::Shape(i, j) => format!("shape-{}-{}", i + 1, j + 1),
        }
    }

    /// Value for an arm.
    pub fn of(self, arm: &ModalArm) -> f64 {
        let [forward, backward] = arm.viscous_nm_s_per_rad;
        match self {
            Self::Inertia => arm.inertia_kg_m2,
            Self::Viscous => 0.5 * (forward + backward),
            Self::ViscousDifference => 0.5 * (forward - backward),
            Self::Frequency(j) => arm.modes[j].omega_rad_s,
            Self::Stiffness(j) => arm.modes[j].stiffness_nm_per_rad,
            Self::DampingWithin(j) => arm.modes[j].within_per_s,
            Self::DampingGrounded(j) => arm.modes[j].grounded_per_s,
            Self::DampingAtPoint(i) => arm.at_points_per_s[i],
            Self::Coulomb => arm.coulomb_nm,
            Self::Offset => arm.offset_nm,
            Self::Friction(number) => number.of(&arm.dry_terms),
            Self::GravitySine => arm.gravity.map_or(0.0, |g| g.sine_nm),
            Self::GravityCosine => arm.gravity.map_or(0.0, |g| g.cosine_nm),
            Self::CommandLag => arm.command_lag_s,
            Self::TipLag(i) => arm.tip_lags_s.get(i).copied().unwrap_or(0.0),
            Self::Shape(i, j) => arm.shapes[i][j],
        }
    }

    /// Sets the value in an arm.
    pub fn set(self, arm: &mut ModalArm, value: f64) {
        let change = value - self.of(arm);
        match self {
            Self::Inertia => arm.inertia_kg_m2 = value,
            Self::Viscous => arm.viscous_nm_s_per_rad.iter_mut().for_each(|v| *v += change),
            Self::ViscousDifference => {
                arm.viscous_nm_s_per_rad[0] += change;
                arm.viscous_nm_s_per_rad[1] -= change;
            }
            Self::Frequency(j) => arm.modes[j].omega_rad_s = value,
            Self::Stiffness(j) => arm.modes[j].stiffness_nm_per_rad = value,
            Self::DampingWithin(j) => arm.modes[j].within_per_s = value,
            Self::DampingGrounded(j) => arm.modes[j].grounded_per_s = value,
            Self::DampingAtPoint(i) => arm.at_points_per_s[i] = value,
            Self::Coulomb => arm.coulomb_nm = value,
            Self::Offset => arm.offset_nm = value,
            Self::Friction(number) => number.set(&mut arm.dry_terms, value),
            Self::GravitySine => arm.gravity.get_or_insert_default().sine_nm = value,
            Self::GravityCosine => arm.gravity.get_or_insert_default().cosine_nm = value,
            Self::CommandLag => arm.command_lag_s = value,
            Self::TipLag(i) => {
                arm.tip_lags_s.resize(arm.shapes.len(), 0.0);
                arm.tip_lags_s[i] = value;
            }
            Self::Shape(i, j) => arm.shapes[i][j] = value,
        }
    }
}

/// The parameters of an arm that the given channels can determine: Coulomb friction, one viscous constant, and damping
/// within the beam.
pub fn free_parameters(channels: &Channels, arm: &ModalArm) -> Vec<Parameter> {
    let mut free =
        vec![Parameter::Inertia, Parameter::Viscous, Parameter::Coulomb, Parameter::Offset];
    let modes = arm.modes.len();
    for (j, mode) in arm.modes.iter().enumerate() {
        free.extend([Parameter::Frequency(j), Parameter::DampingWithin(j)]);
        // A mode without stiffness is one that only the tips show.
        free.extend((mode.stiffness_nm_per_rad != 0.0).then_some(Parameter::Stiffness(j)));
    }
    for i in 0..channels.tips.len() {
        free.extend((0..modes).map(|j| Parameter::Shape(i, j)));
    }
    free.extend(arm.dry_terms.numbers().into_iter().map(Parameter::Friction));
    if arm.gravity.is_some() {
        free.extend([Parameter::GravitySine, Parameter::GravityCosine]);
    }
    free
}
