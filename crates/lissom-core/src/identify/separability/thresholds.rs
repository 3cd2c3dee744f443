//! The verdict: which parameters the logs separate, and which run to add.

thresholds! {
    "separability" {
        /// If no relative standard error is above this, all parameters are identified well, and no
        /// run is proposed.
        ALL_SHARP: f64 = 0.01, "1", Convention;
        /// A parameter is listed with a direction that contains more than this share of its
        /// variance.
        DIRECTION_OF_ESTIMATE: f64 = 0.5, "1", Convention;
        /// A parameter is listed with a direction if it has more than this share of the squared
        /// weights.
        ESTIMATE_OF_DIRECTION: f64 = 0.1, "1", Convention;
        /// A parameter is not identified if it changes by more than this share along a direction
        /// that the logs do not show.
        LOST_SHARE: f64 = 0.01, "1", Convention;
        /// With the output-error method a run stands out only if its residual is this many times
        /// that of the others.
        RUN_RESIDUAL: f64 = 1.5, "1", Convention;
        /// A run stands out only if a parameter changes by this share without it, and by `PRESENT`
        /// standard errors.
        RUN_MOVES: f64 = 1e-3, "1", Convention;
        /// One run is the main source of a parameter if the parameter's standard error without this
        /// run is this many times as large.
        RUN_CARRIES: f64 = 2.0, "1", Convention;
        /// The proposed run is the shortest of those whose standard error is within this factor of
        /// the best.
        RUN_AS_GOOD: f64 = 1.1, "1", Convention;
        /// A run is proposed only if it reduces the standard error to this share.
        RUN_WORTH: f64 = 0.9, "1", Convention;
        /// A direction that the logs do not show at all is printed with this change of its first
        /// parameter.
        CHANGE_SHOWN: f64 = 0.1, "1", Convention;
        /// A larger change of a parameter without a run is printed as `more than` this: one step of
        /// the search is not accurate beyond it.
        LARGE_CHANGE: f64 = 0.2, "1", Convention;
        /// A parameter is reported as correlated if its standard error is this many times the one
        /// that it would have with the other parameters known.
        CORRELATED: f64 = 3.0, "1", Convention;
    }
}
