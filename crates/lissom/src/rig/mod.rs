//! The virtual laboratory, Sections 5.1 and 6.1: a sampled loop around an arm that sticks and
//! slips.

mod batch;
mod blocks;
mod crossing;
mod flow;
mod held;
mod held_arm;
mod held_motion;
mod held_search;
mod hybrid;
mod instrument;
mod lane;
mod modal;
mod motion;
mod polynomial;
mod sine;
mod stepped_sine;

pub use batch::{Batch, NoisyRun};
pub use held::HeldStep;
pub use held_arm::HeldArm;
pub use held_motion::{HeldMotion, Work};
pub use hybrid::{Hybrid, Mode};
pub use instrument::{Pd, Quantiser, RigError};
pub use motion::Motion;
pub use sine::Sines;
pub use stepped_sine::{Rig, SteppedSine};
