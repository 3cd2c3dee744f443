//! Choice of the method whose estimates are used, and refusals.

thresholds! {
    "judge" {
        /// Weighted residual (rms) above which the estimates of the motor's rational model are not
        /// used: three times what its standard errors explain.
        MODEL_MISFIT: f64 = 3.0, "standard errors", Convention;
        /// A regression is not used if its residual torque is more than this many times that of
        /// least squares, plus `BEATEN_SHARE`. Least squares have the smallest residual by
        /// construction; that of a correct regression is a few percent larger.
        BEATEN_FACTOR: f64 = 1.5, "1", Convention;
        /// Share of the torque by which the residual of a regression must exceed `BEATEN_FACTOR`
        /// times that of least squares, so that the regression is not used.
        BEATEN_SHARE: f64 = 0.02, "1", Convention;
        /// The modes are those of the tips' own equations if the residual of these is less than
        /// this share of the tips' accelerations.
        TIPS_COMPLETE: f64 = 0.02, "1", Convention;
        /// A difference between the estimates of two methods is reported if it is larger than this
        /// share.
        METHODS_DISAGREE: f64 = 0.15, "1", Convention;
        /// Odd harmonics of the command show dry friction if they are this many times as large as
        /// the even ones.
        ODD_HARMONICS: f64 = 2.0, "1", Convention;
        /// An offset of friction smaller than this share of Coulomb friction is not reported.
        OFFSET_REPORTED: f64 = 0.01, "1", Convention;
        /// A warning reports an estimate whose relative standard error is above this.
        UNCERTAIN_ERROR: f64 = 0.2, "1", Convention;
    }
}
