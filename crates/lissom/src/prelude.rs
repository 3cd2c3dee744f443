//! The types that most programs need: `use lissom::prelude::*;`.

pub use crate::arm::Arm;
pub use crate::beam::{Damping, DistributedBeam, LumpedBeam, Payload, Piece, Span};
pub use crate::drive::{Coulomb, DryFriction, Falloff, Motor};
pub use crate::identify::{Effort, Estimate, Finding, Interrupt, Severity, Stage};
pub use crate::io::read_campaign;
pub use crate::load::GravityLoad;
pub use crate::record::{
    Axis, Campaign, Channels, Command, CommandQuantity, Hold, Run, TimeBase, Tip, TipQuantity,
};
pub use crate::rig::{
    Controller, Drive, Experiment, Instruments, Multisine, Pd, Pid, Reference, Rig, Sensed, Settle,
    Sweep, Table, TableHold,
};
pub use crate::{Found, Identify};
