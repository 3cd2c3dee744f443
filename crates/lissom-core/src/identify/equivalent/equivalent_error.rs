//! Why points and responses make no equivalent arm.

use thiserror::Error;

/// Why there is no equivalent beam.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum EquivalentError {
    /// Each mode needs a point of its own.
    #[error("{modes} modes and {points} points: step 5 of Section 4 takes as many points as modes")]
    PointsAndModes {
        /// Points measured.
        points: usize,
        /// Modes of the fit.
        modes: usize,
    },
    /// μ of (22) cannot be inverted.
    #[error(
        "points {first} and {second} move too much alike in these modes (the gains' least singular value is {ratio:.1e} \
         of the largest): mode {mode} is not told apart"
    )]
    TooClose {
        /// One of the pair that is most alike, from 0.
        first: usize,
        /// The other.
        second: usize,
        /// Least singular value of the gains over the largest.
        ratio: f64,
        /// The mode, from 0, that has the largest part in the motion that no point shows: one of the two
        /// should sit where this mode moves it by another size or sign. A beam of known dimensions says
        /// where: [`DistributedBeam::best_point`](crate::beam::DistributedBeam::best_point).
        mode: usize,
    },
    /// The motor's response does not hold step 6.
    #[error(
        "{frequencies} frequencies of the motor, {unknowns} unknowns: inertia, viscous friction and coupling \
         cannot be found"
    )]
    MotorTooFew {
        /// Frequencies of its response.
        frequencies: usize,
        /// J, V and c_k of each mode.
        unknowns: usize,
    },
    /// A response of the motor that is no number, is zero, has no deviation, or no frequency.
    #[error(
        "the motor's response at point {index} needs a finite value, a deviation above zero and a frequency"
    )]
    MotorResponse {
        /// Its place, from 0.
        index: usize,
    },
}
