//! Thresholds for logs of two clocks.

thresholds! {
    "other_clock" {
        /// Two logs share a motion if the gain in log-likelihood by it is at least this many times the number of its
        /// regressors. It is at least 11 in 18 simulated logs of an arm with a camera, a strain gauge or an accelerometer,
        /// and at most 5.7 in 11 logs of other motions or of none.
        SHARED_GAIN: f64 = 8.0, "1", Measured;
        /// Two logs share a motion if at least this share of the signal follows it: at least 0.36 in the same logs, at
        /// most 0.11 in those without a shared motion.
        SHARED_LEAST: f64 = 0.2, "1", Measured;
        /// Error of the models, which is part of the standard error of each offset: damping of the arm, or friction that
        /// is not that of Coulomb, looks like a shift in time. It is 0.3 ms (rms) for angles and currents in 27 simulated
        /// logs.
        MODEL_SHIFT_S: f64 = 3e-4, "s", Measured;
        /// The same for a deflection or an acceleration, in which vibrations are larger: 0.6 ms (rms) in 10 simulated logs.
        VIBRATION_SHIFT_S: f64 = 6e-4, "s", Measured;
        /// The drift of a clock is used if it is this many standard errors from zero.
        DRIFT_SHOWS: f64 = 3.0, "standard errors", Convention;
        /// Another offset fits as well if the variance that it leaves unexplained is less than this factor times that of
        /// the best one: the motion repeats. The factor is at most 1.13 for motions that repeat, at least 2.2 for others.
        REPEATS: f64 = 1.3, "1", Measured;
    }
}
