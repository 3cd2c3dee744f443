//! From records to friction, parameters and a verdict.

mod correct;
mod estimate;
mod regression;
mod third_harmonic;

pub use correct::{Response, corrected, ratio};
pub use estimate::{Estimate, ModeEstimate};
pub use regression::{
    BeamRegression, Candidate, MotorRegression, beam_regression, motor_regression,
};
pub use third_harmonic::{PairFigure, RunPhasors, mean_figure, pair_figure};
