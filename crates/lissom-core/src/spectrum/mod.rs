//! Phasors and frequency responses of records, each with its standard error (Section 5.2 of the 1989 report).

mod broadband;
mod frequency;
mod harmonic_fit;
mod harmonics;
mod steady;
pub(crate) mod thresholds;

pub use broadband::{Band, Bin, Lines, average, broadband, groups, noise_power};
pub use frequency::find_frequency;
pub(crate) use frequency::minimum;
pub use harmonics::{Harmonics, Phasor, hold_factor, least_squares};
pub use steady::{Steady, SteadyError, steady_state};
