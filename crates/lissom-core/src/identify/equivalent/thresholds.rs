//! Equivalent arm: refusals and findings.

thresholds! {
    "equivalent arm" {
        /// The matrix of the points' gains is singular if its smallest singular value is below this
        /// share of the largest, or below `CLEARLY_PRESENT` standard errors.
        POINTS_DEPENDENT: f64 = 1e-10, "1", Convention;
        /// Weighted residual (rms) above which the model is reported as incomplete.
        MISFIT: f64 = 2.0, "standard errors", Convention;
        /// Weighted residual (rms) below which the given standard errors are reported as too large.
        ERRORS_TOO_LARGE: f64 = 0.5, "standard errors", Convention;
        /// Gain that the last mode gets, so that a point turns with the motor, above which this is
        /// reported.
        GIVEN_TO_LAST_MODE: f64 = 0.02, "1", Convention;
        /// Without standard errors, the motor's response is reported as not described by the model
        /// if its relative residual is this many times that of the points, and above `MOTOR_LEFT`.
        MOTOR_WORSE: f64 = 3.0, "1", Convention;
        /// Relative residual of the motor's response below which the model describes it.
        MOTOR_LEFT: f64 = 0.02, "1", Convention;
        /// The responses are refused if an imaginary part that no arm has is larger than this share
        /// (median) of a response.
        NOT_OF_AN_ARM: f64 = 0.1, "1", Convention;
        /// An imaginary part that no arm has is reported if it is this large (rms), or if a delay
        /// is this many standard errors from zero.
        IMAGINARY_PRESENT: f64 = 3.0, "standard errors", Convention;
        /// The sign of a damping ratio, or of a constant phase, is known if it is this many
        /// standard errors from zero. It decides whether responses are conjugated, so this is more
        /// than `CLEARLY_PRESENT`.
        PHASE_SIGN_CERTAIN: f64 = 5.0, "standard errors", Convention;
        /// Without standard errors, imaginary residuals are not noise if they are this many times
        /// as large as the real ones.
        IMAGINARY_UNLIKE: f64 = 2.0, "1", Convention;
        /// The conjugated response fits clearly better if its residual is this share of the other
        /// one, or less.
        CONJUGATE_LEAVES: f64 = 0.7, "1", Convention;
        /// Without standard errors, the error of a response is assumed to be at least this share of
        /// that of the worst one: a model may describe few values exactly.
        OUTPUT_ERROR_LEAST: f64 = 0.03, "1", Convention;
        /// A pole above the measured frequencies acts on the motor's torque up to this many times
        /// the highest frequency. A pole farther away cannot be separated from inertia and would
        /// distort it.
        POLE_IN_TORQUE: f64 = 4.0, "1", Convention;
        /// The damping ratio of a pole above the measured frequencies is not known if it is larger
        /// than this, and zero is used.
        OUTSIDE_DAMPING_MOST: f64 = 0.05, "1", Convention;
        /// A point is not an angle of the arm if the sum of its gains, including those of modes
        /// that are left out, differs from one by more than this.
        NO_ANGLE: f64 = 0.5, "1", Convention;
        /// A zero outside the measured frequencies is reported only if its relative standard error
        /// is below this.
        ZERO_KNOWN: f64 = 0.1, "1", Convention;
        /// Standard error of the contribution of poles above the measured frequencies to a zero, as
        /// a share of the contribution, if the poles themselves are not measured.
        MODES_ABOVE_ERROR: f64 = 0.1, "1", Convention;
    }
}
