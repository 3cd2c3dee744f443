//! The virtual rig (Sections 5.1 and 6.1 of the 1989 report): simulated experiments with an arm that sticks and slips,
//! in a sampled control loop with real instruments.
//!
//! [`Rig`] runs [`Experiment`]s and returns logs. The engines behind the trait [`Motion`] can also be used alone:
//! [`HeldMotion`] for Coulomb friction and torques that are constant over each sample, [`Hybrid`] for all other dry
//! friction and for a world at the tip, [`LuGreMotion`] for bristles.

mod controller;
mod error;
mod experiment;
mod finding;
mod held;
mod hybrid;
mod instrument;
mod logged;
mod logging;
mod lugre;
mod motion;
mod rig_builder;
mod sampled_loop;
mod scene;
mod settled;
mod settling;
mod signal;
mod tip_world;
mod virtual_campaign;
mod virtual_rig;
mod wander;

pub use crate::friction::Mode;
pub use controller::{ControlLaw, Controller, IntegerPd, Pd, Pid, Proportional, Sensed, Word};
pub use error::RigError;
pub use experiment::{
    Chirp, Drive, Experiment, Multisine, Reference, Settle, Sine, Square, Start, Sweep, Table,
    TableHold,
};
pub use finding::{RigFinding, SensorPlace};
pub use held::{HeldArm, HeldMotion, Work};
pub use hybrid::Hybrid;
pub use instrument::{
    Amplifier, CurrentReading, CurrentSensor, Delay, Instruments, LateStamps, Noise, Quantiser,
    Sensor,
};
pub use logged::{Logged, RowTruth};
pub use lugre::LuGreMotion;
pub use motion::Motion;
pub use rig_builder::RigBuilder;
pub use scene::{JointFriction, Scene};
pub use settled::Settled;
pub use signal::{Harmonic, Signal};
pub use tip_world::{TipWorld, Wall};
pub use virtual_campaign::{PlannedExperiment, VirtualCampaign};
pub use virtual_rig::Rig;
pub use wander::FrictionWander;
