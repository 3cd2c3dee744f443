//! From records to phasors and responses, Section 5.2, each with its covariance.

mod broadband;
mod frequency;
mod harmonic_fit;
mod harmonics;
mod steady;
pub(crate) mod thresholds;

pub use broadband::{Band, Bin, Lines, average, broadband, groups, noise_power};
pub use frequency::find_frequency;
pub use harmonics::{Harmonics, Phasor, hold_factor, least_squares};
pub use steady::{Steady, SteadyError, steady_state};
