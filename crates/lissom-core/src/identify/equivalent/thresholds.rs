//! When the equivalent arm is given, and what is reported of it.

thresholds! {
    "equivalent arm" {
        /// The matrix of the points' gains is singular if its least singular value is below this
        /// share of the largest, or below `CLEARLY_PRESENT` standard errors.
        POINTS_DEPENDENT: f64 = 1e-10, "1", Convention;
        /// Weighted residual (rms) above which the model is reported to be incomplete.
        MISFIT: f64 = 2.0, "standard errors", Convention;
        /// Weighted residual (rms) below which the given standard errors are reported as too large.
        ERRORS_TOO_LARGE: f64 = 0.5, "standard errors", Convention;
        /// Gain given to the last mode, so that a point turns with the motor, above which it is
        /// reported.
        GIVEN_TO_LAST_MODE: f64 = 0.02, "1", Convention;
        /// Without standard errors, the motor's response is misfitted if its relative residual is
        /// this many times that of the points, and above `MOTOR_LEFT`.
        MOTOR_WORSE: f64 = 3.0, "1", Convention;
        /// Relative residual of the motor's response below which it is not called misfitted.
        MOTOR_LEFT: f64 = 0.02, "1", Convention;
        /// The responses are refused if imaginary parts that no arm has are larger than this share
        /// (median) of a response.
        NOT_OF_AN_ARM: f64 = 0.1, "1", Convention;
        /// Imaginary parts that no arm has are reported if they are this large (rms), or if a delay
        /// is this many standard errors from zero.
        IMAGINARY_PRESENT: f64 = 3.0, "standard errors", Convention;
        /// The sign of a damping ratio, or of a constant phase, is known if it is this many
        /// standard errors from zero. It decides whether responses are conjugated, so it is more
        /// than `CLEARLY_PRESENT`.
        PHASE_SIGN_CERTAIN: f64 = 5.0, "standard errors", Convention;
        /// Without standard errors, imaginary residuals are not noise if they are this many times
        /// as large as the real ones.
        IMAGINARY_UNLIKE: f64 = 2.0, "1", Convention;
        /// The conjugated response fits clearly better if it leaves this share of the residual or
        /// less.
        CONJUGATE_LEAVES: f64 = 0.7, "1", Convention;
        /// Without standard errors, the error of one response is taken to be at least this share of
        /// the worst one's: a model may describe few points exactly.
        OUTPUT_ERROR_LEAST: f64 = 0.03, "1", Convention;
        /// A pole above the frequencies acts on the motor's torque up to this many times the
        /// highest frequency. A farther one cannot be told from inertia, and would distort it.
        POLE_IN_TORQUE: f64 = 4.0, "1", Convention;
        /// The damping ratio of a pole above the frequencies is not known if it is larger, and zero
        /// is taken.
        OUTSIDE_DAMPING_MOST: f64 = 0.05, "1", Convention;
        /// A point is not an angle of the arm if the sum of its gains, with those of modes that are
        /// left out, differs from one by more than this.
        NO_ANGLE: f64 = 0.5, "1", Convention;
        /// A zero outside the frequencies is reported only if its relative standard error is below
        /// this.
        ZERO_KNOWN: f64 = 0.1, "1", Convention;
        /// Standard error of what poles above the frequencies add to a zero, as a share of it, if
        /// they are not measured themselves.
        MODES_ABOVE_ERROR: f64 = 0.1, "1", Convention;
    }
}
