//! Flexible arms and drives whose joint has friction: models, exact simulation, identification.
//!
//! The way of the data, one direction only:
//! [`beam`] and [`drive`] make an [`arm`]; the [`rig`] runs virtual experiments on it; a
//! [`record`] holds logs, simulated or measured; [`spectrum`] turns them into phasors and
//! responses; [`identify`] turns those into friction, parameters and a verdict. [`plan`] says which
//! experiments are worth making.
//!
//! SI units and rad/s throughout; no files, no printing.

#[macro_use]
mod threshold;

pub mod arm;
pub mod beam;
pub mod drive;
mod eigenvalues;
mod error;
mod friction;
pub mod identify;
pub mod information;
pub mod load;
pub mod lti;
mod number;
pub mod plan;
pub mod record;
pub mod replay;
pub mod rig;
pub mod spectrum;
mod thresholds;

pub use error::Error;
pub use threshold::{Basis, Threshold, ThresholdValue};
pub use thresholds::thresholds;

/// Dense matrix of the public interface.
pub type Matrix = nalgebra::DMatrix<f64>;
