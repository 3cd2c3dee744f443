//! What the logs separate.

thresholds! {
    "separability" {
        /// If no relative standard error is above this, all parameters are identified well and no
        /// run is proposed.
        ALL_SHARP: f64 = 0.01, "1", Convention;
        /// An estimate is named with a direction that carries this share of its variance.
        DIRECTION_OF_ESTIMATE: f64 = 0.5, "1", Convention;
        /// An estimate is named with a direction of which it is this share (of the squared
        /// weights).
        ESTIMATE_OF_DIRECTION: f64 = 0.1, "1", Convention;
        /// An estimate is lost if it changes by more than this share along a direction that the
        /// logs do not show.
        LOST_SHARE: f64 = 0.01, "1", Convention;
        /// In the output error a run stands out only if its residual is this many times that of the
        /// others.
        RUN_RESIDUAL: f64 = 1.5, "1", Convention;
        /// A run stands out only if an estimate without it changes by this share, besides by
        /// `PRESENT` standard errors.
        RUN_MOVES: f64 = 1e-3, "1", Convention;
        /// An estimate rests on one run if its standard error without the run is this many times as
        /// large.
        RUN_CARRIES: f64 = 2.0, "1", Convention;
        /// The run proposed is the shortest whose standard error is within this factor of the best.
        RUN_AS_GOOD: f64 = 1.1, "1", Convention;
        /// A run is proposed only if it lowers the standard error to this share.
        RUN_WORTH: f64 = 0.9, "1", Convention;
        /// A direction that the logs do not show at all is written with this change of its leading
        /// estimate.
        CHANGE_SHOWN: f64 = 0.1, "1", Convention;
        /// A larger change of an estimate without a run is written as `more than` this: one step of
        /// the search says no more.
        LARGE_CHANGE: f64 = 0.2, "1", Convention;
        /// An estimate is reported as correlated if its standard error is this many times what it
        /// were with the others known.
        CORRELATED: f64 = 3.0, "1", Convention;
    }
}
