//! Errors of the equivalent beam and arm.

use thiserror::Error;

/// Error of [`equivalent_beam`](fn@super::equivalent_beam) or [`equivalent_arm`](fn@super::equivalent_arm).
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum EquivalentError {
    /// The numbers of points and modes differ.
    #[error("{modes} modes and {points} points: an equivalent arm needs as many points as modes")]
    PointsAndModes {
        /// Points measured.
        points: usize,
        /// Modes of the fit.
        modes: usize,
    },
    /// The points' motions are nearly equal, so that μ of (22) cannot be inverted.
    #[error(
        "points {first} and {second} move almost alike in these modes (the smallest singular value of the gains is \
         {ratio:.1e} of the largest): mode {mode} cannot be separated from the others"
    )]
    TooClose {
        /// Index of one point of the pair that is most alike, from 0.
        first: usize,
        /// Index of the other point.
        second: usize,
        /// Smallest singular value of the gains relative to the largest.
        ratio: f64,
        /// Index, from 0, of the mode with the largest part in the motion that no point shows. One of the two points
        /// should be where this mode moves it with another amplitude or sign. For a beam of known dimensions,
        /// [`DistributedBeam::best_point`](crate::beam::DistributedBeam::best_point) finds such a place.
        mode: usize,
    },
    /// The motor's response has too few frequencies.
    #[error(
        "the motor's response has {frequencies} frequencies for {unknowns} unknowns: inertia, viscous friction and \
         coupling cannot be identified"
    )]
    MotorTooFew {
        /// Frequencies of its response.
        frequencies: usize,
        /// Number of unknowns: J, V and c_k of each mode.
        unknowns: usize,
    },
    /// A value of the motor's response is zero or not finite, or has no frequency or no standard error.
    #[error(
        "point {index} of the motor's response needs a finite value, a frequency, and a standard error above zero"
    )]
    MotorResponse {
        /// Index of the value, from 0.
        index: usize,
    },
}
