//! Regression on slip phases: inertia, friction and coupling without differentiating a
//! measurement.

mod beam;
mod missing;
mod motor;
mod normal;
mod phases;
mod scan;
mod verdict;
mod window;

pub use beam::{BeamRegression, beam_regression};
pub use missing::{MissingKind, MissingTerm};
pub use motor::{ByDirection, MotorRegression, motor_regression};
pub(crate) use motor::{coupled_tips, row};
pub(crate) use normal::{Cluster, Solution, Term, solve};
pub(crate) use phases::{slip_phases, slip_sign, smoothing};
pub use scan::Candidate;
pub(crate) use verdict::findings;
pub(crate) use window::Window;
