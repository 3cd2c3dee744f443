//! Parameters that the logs do not show at all.

thresholds! {
    "information" {
        /// Errors of a mode's damping are relative to at least this damping ratio: the relative
        /// error of a smaller one has no meaning.
        DAMPING_LEAST: f64 = 1e-3, "1", Convention;
        /// A direction of the parameters is unknown if its eigenvalue in the scaled information
        /// matrix is below this share of the largest, which is close to rounding.
        UNKNOWN_DIRECTION: f64 = 1e-14, "1", Convention;
        /// A parameter is not identified if it has more than this share in an unknown direction.
        LOST_PARAMETER: f64 = 1e-6, "1", Convention;
    }
}
