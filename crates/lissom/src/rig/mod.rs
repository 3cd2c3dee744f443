//! The virtual laboratory, Sections 5.1 and 6.1: a sampled loop around an arm that sticks and
//! slips.

mod held;
mod hybrid;
mod instrument;
#[cfg(feature = "lugre")]
mod lugre;
mod motion;
mod polynomial;
mod stepped_sine;

pub use held::HeldStep;
pub use hybrid::{Hybrid, Mode};
pub use instrument::{Pd, Quantiser, RigError};
#[cfg(feature = "lugre")]
pub use lugre::LuGreMotion;
pub use motion::Motion;
pub use stepped_sine::{Rig, SteppedSine};
