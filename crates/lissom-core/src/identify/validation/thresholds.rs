//! Findings about a prediction.

use crate::identify::thresholds::RESIDUAL_FALLS_TO;

thresholds! {
    "validation" {
        /// The residual is examined over the longest time over which every channel has at least
        /// this fit. A finding reports if whole runs have a smaller fit.
        FITS_PERCENT: f64 = 90.0, "%", Convention;
        /// The window of the predicted torque is lengthened until the noise of the motor's sensor,
        /// through the acceleration, makes less than this share of the torque.
        NOISE_OF_TORQUE: f64 = 0.01, "1", Convention;
        /// The motor moves if its speed is above this many standard deviations of the noise.
        MOVING: f64 = 3.0, "standard deviations", Convention;
        /// A window is used only if the motor rests in less than this share of it: friction at rest
        /// cannot be predicted.
        RESTING_SHARE: f64 = 0.1, "1", Convention;
        /// A stretch of the prediction shorter than this is not listed.
        STRETCH_LEAST: usize = 3, "windows", Convention;
        /// Residual torque, as a share of the torque, below which nothing is reported about the
        /// torque.
        GOOD_PREDICTION: f64 = 0.03, "1", Convention;
        /// A prediction is not reported as poor if its residual is at most this many times the one
        /// that sensors and reversals alone make.
        AS_EXPECTED: f64 = 1.2, "1", Convention;
        /// A log is reported if its residual torque is this many times that of the logs of the
        /// identification.
        WORSE_THAN_USED: f64 = 1.5, "1", Convention;
        /// A cause is reported if it alone explains this share of the squared residual: the
        /// residual then falls to `RESIDUAL_FALLS_TO`.
        CAUSE_NAMED: f64 = 1.0 - RESIDUAL_FALLS_TO * RESIDUAL_FALLS_TO, "1", Derived;
        /// Residuals of two logs are compared only if the lengths of their windows differ by less
        /// than this share.
        SAME_WINDOW: f64 = 0.2, "1", Convention;
        /// The residual follows the command if more than this share of its correlations is outside
        /// the 95 % band: four times what chance gives.
        FOLLOWS_COMMAND: f64 = 0.2, "1", Derived;
        /// A residual of up to this many times the sensor's noise is as small as possible: whether
        /// it is white is not examined.
        AT_SENSOR_NOISE: f64 = 1.5, "1", Convention;
        /// A mode is reported at another frequency if this frequency reduces the squared residual
        /// to this share.
        MODE_MOVED_LEAVES: f64 = 0.5, "1", Convention;
        /// A mode is reported at another frequency only if the frequency differs by more than this
        /// share: errors of other parameters look like smaller changes.
        MODE_MOVED_BY: f64 = 3e-3, "1", Convention;
    }
}
