//! The virtual laboratory, Sections 5.1 and 6.1: a sampled loop around an arm that sticks and
//! slips.

mod events;
mod held;
mod hybrid;
mod instrument;
mod motion;
mod polynomial;
mod series;
mod signal;
mod slip;
mod stepped_sine;
mod tip_world;

pub use held::HeldStep;
pub use hybrid::{Hybrid, Mode};
pub use instrument::{Pd, Quantiser, RigError};
pub use motion::Motion;
pub use signal::{Harmonic, Signal};
pub use stepped_sine::{Rig, SteppedSine};
pub use tip_world::{TipWorld, Wall};
