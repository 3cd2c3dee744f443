//! The virtual laboratory, Sections 5.1 and 6.1: a sampled loop around an arm that sticks and
//! slips.

mod batch;
mod blocks;
mod controller;
mod crossing;
mod error;
mod events;
mod experiment;
mod finding;
mod flow;
mod held;
mod held_arm;
mod held_motion;
mod held_search;
mod hybrid;
mod instrument;
mod lane;
mod logging;
#[cfg(feature = "lugre")]
mod lugre;
mod modal;
mod motion;
mod polynomial;
mod sampled_loop;
mod scene;
mod series;
mod settling;
mod signal;
mod sine;
mod slip;
mod tip_world;

pub use batch::{Batch, NoisyRun};
pub use controller::{ControlLaw, Controller, IntegerPd, Pd, Pid, Proportional, Sensed, Word};
pub use error::RigError;
pub use experiment::{
    Chirp, Drive, Experiment, Multisine, Reference, Settle, Sine, Square, Start, Sweep, Table,
    TableHold,
};
pub use finding::{RigFinding, SensorPlace};
pub use held::HeldStep;
pub use held_arm::HeldArm;
pub use held_motion::{HeldMotion, Work};
pub use hybrid::{Hybrid, Mode};
pub use instrument::{Amplifier, Delay, Instruments, Noise, Quantiser, Sensor};
#[cfg(feature = "lugre")]
pub use lugre::LuGreMotion;
pub use motion::Motion;
pub use sampled_loop::{Logged, Rig, Settled};
pub use scene::{JointFriction, Scene};
pub use signal::{Harmonic, Signal};
pub use sine::Sines;
pub use tip_world::{TipWorld, Wall};
