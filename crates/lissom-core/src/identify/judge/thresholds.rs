//! Which method's estimates are taken, and what is refused.

thresholds! {
    "judge" {
        /// Weighted residual (rms) above which the estimates of the motor's rational model are not
        /// taken: three times what its own standard errors explain.
        MODEL_MISFIT: f64 = 3.0, "standard errors", Convention;
        /// A regression that leaves this many times as much of the torque as least squares, and
        /// `BEATEN_SHARE` more, is not taken. Least squares leave the least by construction; a
        /// sound regression leaves a few percent more.
        BEATEN_FACTOR: f64 = 1.5, "1", Convention;
        /// Share of the torque that a regression must leave beyond `BEATEN_FACTOR` times what least
        /// squares leave, to be not taken.
        BEATEN_SHARE: f64 = 0.02, "1", Convention;
        /// The modes are those of the tips' own equations if these leave less than this share of
        /// the tips' accelerations.
        TIPS_COMPLETE: f64 = 0.02, "1", Convention;
        /// Methods whose estimates differ by more than this share are reported.
        METHODS_DISAGREE: f64 = 0.15, "1", Convention;
        /// Odd harmonics of the command show dry friction if they are this many times as large as
        /// the even ones.
        ODD_HARMONICS: f64 = 2.0, "1", Convention;
        /// An offset of friction smaller than this share of Coulomb friction is not reported.
        OFFSET_REPORTED: f64 = 0.01, "1", Convention;
        /// An estimate whose relative standard error is above this is reported as uncertain.
        UNCERTAIN_ERROR: f64 = 0.2, "1", Convention;
        /// An estimate whose relative standard error is above this is refused: not even its size is
        /// known.
        REFUSED_ERROR: f64 = 1.0, "1", Convention;
    }
}
