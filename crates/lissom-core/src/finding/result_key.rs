//! Result keys that findings affect, without the suffix of their unit.

pub(crate) const COULOMB: &str = "friction.coulomb";
pub(crate) const OFFSET: &str = "friction.offset";
pub(crate) const VISCOUS: &str = "friction.viscous";
pub(crate) const INERTIA: &str = "drive.inertia";
pub(crate) const GRAVITY: &str = "gravity";
pub(crate) const COUPLING: &str = "beam.coupling";
pub(crate) const MODES: &str = "beam.modes";
pub(crate) const THIRD_HARMONIC: &str = "methods.third_harmonic";
pub(crate) const CONSTANT_VELOCITY: &str = "methods.constant_velocity";
pub(crate) const RAW_RESPONSE: &str = "frequency_response.motor_raw";
pub(crate) const CORRECTED_RESPONSE: &str = "frequency_response.motor_corrected";
pub(crate) const TIP_RESPONSES: &str = "frequency_response.tips";
pub(crate) const MOTOR_MODEL: &str = "models.motor";
pub(crate) const TIP_MODELS: &str = "models.tips";
pub(crate) const STATE_SPACE: &str = "models.state_space";
pub(crate) const ARM: &str = "arm";
pub(crate) const EQUIVALENT: &str = "equivalent";
/// Keys of a validation.
pub(crate) const TORQUE: &str = "torque";
pub(crate) const MOTION: &str = "motion";
pub(crate) const RESIDUALS: &str = "residuals";

/// Keys of what a wrong channel or a wrong command makes wrong.
pub(crate) const LINE: &[&str] = &[COULOMB, VISCOUS, INERTIA];
/// The same, with friction by direction and what a load and a beam add to the motor's equation.
pub(crate) const JOINT: &[&str] = &[COULOMB, OFFSET, VISCOUS, INERTIA, GRAVITY, COUPLING];
/// Keys of the parameters of an arm.
pub(crate) const WHOLE_ARM: &[&str] = &[COULOMB, VISCOUS, INERTIA, GRAVITY, COUPLING, MODES];
/// Keys of a channel's readings.
pub(crate) const READINGS: &[&str] = &[COULOMB, VISCOUS, INERTIA, COUPLING, MODES, TIP_RESPONSES];
