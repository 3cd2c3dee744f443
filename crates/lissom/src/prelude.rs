//! The types that most programs need: `use lissom::prelude::*;`.

pub use crate::arm::Arm;
pub use crate::beam::{Damping, DistributedBeam, LumpedBeam, Payload, Piece, Span};
pub use crate::drive::{Coulomb, DryFriction, Motor};
pub use crate::identify::{Effort, Estimate, Interrupt};
pub use crate::io::read_campaign;
pub use crate::record::{
    Axis, Campaign, Channels, Command, CommandQuantity, Hold, Run, TimeBase, Tip, TipQuantity,
};
pub use crate::rig::{Controller, Drive, Experiment, Instruments, Pd, Pid, Reference, Rig, Sensed};
pub use crate::{Found, Identify};
