//! Models, exact simulation and identification of flexible arms and motor drives whose joint has friction.
//!
//! This crate is the numerical core of `lissom`: no files, no printing, no command line. Programs depend on the crate
//! `lissom`, which joins this crate with the file formats of `lissom-io`.
//!
//! Data flow in one direction:
//!
//! 1. [`beam`] and [`drive`] describe the parts of an [`arm`].
//! 2. The [`rig`] simulates experiments with that arm: a controller, sensors, and a joint that sticks and slips.
//! 3. A [`record`] holds logs, simulated or measured.
//! 4. [`spectrum`] computes phasors and frequency responses from them.
//! 5. [`identify`] estimates friction, inertia, coupling and modes, each with a standard error, and reports findings:
//!    what the logs do not determine and what is wrong with them.
//! 6. [`replay`] simulates an arm under a logged command, [`information`] computes how precisely logs determine each
//!    parameter, and [`plan`] chooses the experiments that are worth making.
//!
//! Units are SI and rad/s. Equation numbers such as (14) are those of the 1989 report, `[Feliu1989]`; the sources are
//! listed in `docs/src/reference/references.md`, the symbols in `docs/src/reference/notation.md`.

#[macro_use]
mod threshold;

pub mod arm;
pub mod beam;
pub mod drive;
mod eigenvalues;
mod error;
pub mod finding;
mod friction;
pub mod identify;
pub mod information;
pub mod load;
pub mod lti;
mod number;
pub mod plan;
pub mod record;
mod registers;
pub mod replay;
pub mod rig;
pub mod spectrum;
mod thresholds;

pub use error::Error;
pub use threshold::{Basis, Threshold, ThresholdValue};
pub use thresholds::thresholds;

/// Dense real matrix, as public functions take and return it.
pub type Matrix = nalgebra::DMatrix<f64>;
