//! Loads on the motor in addition to friction, which depend on its angle only: gravity of an unbalanced mass, and torque
//! ripple (cogging).

mod gravity_load;
mod position_torque;
mod torque_ripple;

pub use gravity_load::GravityLoad;
pub use position_torque::PositionTorque;
pub use torque_ripple::TorqueRipple;
