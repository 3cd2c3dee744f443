//! What findings affect: keys of `result.json`, without the suffix of their unit.

/// Coulomb friction.
pub const COULOMB: &str = "friction.coulomb";
/// Half the difference of friction forward and backward.
pub const OFFSET: &str = "friction.offset";
/// Viscous friction.
pub const VISCOUS: &str = "friction.viscous";
/// Inertia of the drive.
pub const INERTIA: &str = "drive.inertia";
/// Gravity of an unbalanced load.
pub const GRAVITY: &str = "gravity";
/// Coupling of motor and beam.
pub const COUPLING: &str = "beam.coupling";
/// Modes of the beam.
pub const MODES: &str = "beam.modes";
/// Friction from constant velocities.
pub const CONSTANT_VELOCITY: &str = "methods.constant_velocity";
