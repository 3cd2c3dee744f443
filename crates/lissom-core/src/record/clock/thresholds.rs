//! Numbers that decide how the clock of a log is read.

thresholds! {
    "clock" {
        /// A step between time stamps that is longer than this many sample times is a gap.
        GAP_STEPS: f64 = 1.5, "sample times", Convention;
        /// Stamps are even if their steps differ from the sample time by this share of it or less
        /// (rms). Above, the angle decides whether the samples were taken when they were stamped.
        /// It is also the level from which uneven stamps are reported.
        EVEN_STAMPS: f64 = 0.05, "1", Convention;
        /// Stamps are even only if their mean step differs from their median step by this share or
        /// less: inertia is in error by twice that.
        MEAN_STEP_AGREES: f64 = 1e-3, "1", Convention;
        /// Stamps are even only if the mean steps of 50 samples each differ from the mean of all by this
        /// share or less (rms): a sample time that drifts distorts the motion.
        MEAN_STEP_STEADY: f64 = 5e-3, "1", Convention;
        /// Rows that are missing from a log are filled in by interpolation if this many or fewer
        /// follow each other. The log is cut at longer gaps.
        MOST_LOST_ROWS: usize = 10, "rows", Convention;
        /// A gap is a number of lost rows if its length is a multiple of the sample time, to this
        /// share of the sample time.
        ON_THE_GRID: f64 = 0.2, "1", Convention;
        /// Gaps that are no multiple of the sample time are cut up to this number. A log with more
        /// of them has uneven stamps.
        MOST_ODD_GAPS: usize = 10, "gaps", Convention;
        /// Rows are filled in if the error of the interpolation, averaged over all rows, is less
        /// than this share of the standard deviation of the angle, or less than the noise.
        FILLED_ERROR: f64 = 2e-3, "1", Convention;
        /// Either the time stamps or the even grid agrees with the motion if its mean square error
        /// of predicted angles is this share of the other one's, or less. Where neither does, the
        /// difference is hidden by the noise of the angle, and the even grid is used.
        CLOCK_AGREES: f64 = 0.8, "1", Convention;
        /// Two stretches of a log have different sample times if these differ by this factor. Load on
        /// a computer changes the mean step by less.
        RATE_CHANGES: f64 = 1.25, "1", Convention;
        /// Fewest samples of a stretch with a sample time of its own.
        RATE_STRETCH: usize = 200, "samples", Convention;
        /// Most stretches with sample times of their own. A log with more changes has uneven stamps.
        MOST_RATES: usize = 8, "stretches", Convention;
        /// Readings are repeated if, while the motor moves, this share of the distances between
        /// changed rows is one number of rows or the next one. With a coarse encoder the distances
        /// follow the speed.
        REPEATS_REGULARLY: f64 = 0.9, "1", Convention;
        /// Readings are repeated only if this share or less of the rows where the angle changes is
        /// next to another row that changed.
        REPEATS_BROKEN: f64 = 0.02, "1", Convention;
        /// The error of resampling is a warning if it is more than this share of what acceleration
        /// moves the angle within a sample time: inertia may be in error by about that.
        RESAMPLING_ERROR: f64 = 0.01, "1", Convention;
    }
}
