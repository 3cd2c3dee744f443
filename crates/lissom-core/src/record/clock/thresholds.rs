//! Thresholds for the clock of a log.

thresholds! {
    "clock" {
        /// A step between time stamps that is longer than this many sample times is a gap.
        GAP_STEPS: f64 = 1.5, "sample times", Convention;
        /// Time stamps are even if their steps differ from the sample time by this share of it or
        /// less (rms). Above, the angle decides whether the samples were taken at the time of their
        /// stamps. From the same level on uneven stamps are reported.
        EVEN_STAMPS: f64 = 0.05, "1", Convention;
        /// Time stamps are even only if their mean step differs from their median step by this
        /// share or less: the error of inertia is twice this share.
        MEAN_STEP_AGREES: f64 = 1e-3, "1", Convention;
        /// Time stamps are even only if the mean steps of 50 samples each differ from the mean of
        /// all by this share or less (rms): a sample time that drifts distorts the motion.
        MEAN_STEP_STEADY: f64 = 5e-3, "1", Convention;
        /// Missing rows are filled in by interpolation if at most this many follow each other. At
        /// longer gaps the log is cut.
        MOST_LOST_ROWS: usize = 10, "rows", Convention;
        /// A gap consists of lost rows if its length differs from a multiple of the sample time by
        /// less than this share of the sample time.
        ON_THE_GRID: f64 = 0.2, "1", Convention;
        /// The log is cut at gaps that are not a multiple of the sample time if there are at most
        /// this many of them. A log with more of them has uneven stamps.
        MOST_ODD_GAPS: usize = 10, "gaps", Convention;
        /// Missing rows are filled in if the error of the interpolation, averaged over all rows, is
        /// less than this share of the standard deviation of the angle, or less than the noise.
        FILLED_ERROR: f64 = 2e-3, "1", Convention;
        /// The time stamps agree with the motion, or the even grid does, if the mean square
        /// prediction error of the angle is this share of the other one's, or less. If neither
        /// does, the noise of the angle hides the difference, and the even grid is used.
        CLOCK_AGREES: f64 = 0.8, "1", Convention;
        /// Two parts of a log have different sample times if these differ by this factor. The load
        /// of a computer changes the mean step by less.
        RATE_CHANGES: f64 = 1.25, "1", Convention;
        /// Fewest samples of a part with its own sample time.
        RATE_STRETCH: usize = 200, "samples", Convention;
        /// Largest number of parts with their own sample time. A log with more changes has uneven
        /// stamps.
        MOST_RATES: usize = 8, "stretches", Convention;
        /// Readings are repeated if, while the motor moves, this share of the distances between
        /// changed rows is the same number of rows or the next one. With a coarse encoder the
        /// distances would follow the speed.
        REPEATS_REGULARLY: f64 = 0.9, "1", Convention;
        /// Readings are repeated only if at most this share of the rows in which the angle changes
        /// is next to another row that changed.
        REPEATS_BROKEN: f64 = 0.02, "1", Convention;
        /// The interpolation error is a warning if it is more than this share of the displacement
        /// by acceleration within a sample time: inertia may have about the same relative error.
        RESAMPLING_ERROR: f64 = 0.01, "1", Convention;
    }
}
