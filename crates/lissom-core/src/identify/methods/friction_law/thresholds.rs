//! Choice of the friction law.

thresholds! {
    "friction law" {
        /// Windows are lengthened until the torque that inertia makes of the sensor's noise is less
        /// than this share of the torque.
        TORQUE_OF_NOISE: f64 = 0.02, "1", Convention;
        /// A law whose residual beyond noise is less than this share of the torque is complete: no
        /// law with presliding is tried.
        NOTHING_LEFT: f64 = 0.005, "1", Convention;
        /// Travel after a reversal that is left out, tried in turn, as shares of the usual travel
        /// of a slip phase: presliding friction builds up there.
        TRAVEL_AFTER_REVERSAL: [f64; 3] = [0.03, 0.06, 0.12], "1", Convention;
        /// The travel after reversals is left out only if this reduces the residual beyond noise to
        /// this share.
        AFTER_TRAVEL_LEAVES: f64 = 0.75, "1", Convention;
        /// Quantile of the speeds that is taken as the fastest speed, so that a few outliers do not
        /// matter.
        FASTEST_QUANTILE: f64 = 0.98, "1", Convention;
        /// The speed over which friction near standstill changes is at most this share of the
        /// fastest speed: the logs do not show the end of a slower change, and Coulomb friction
        /// would be undetermined.
        NEAR_REST_MOST: f64 = 0.5, "1", Convention;
        /// A friction law that leaves more than this share of the torque unexplained, and not by
        /// noise, may stand for another effect: it is reported as a warning.
        LAW_LEAVES_MUCH: f64 = 0.05, "1", Convention;
        /// As `RESIDUAL_FALLS_TO`, for friction near standstill if the travel after reversals is
        /// left out: the two appear together, and most of the residual is then noise.
        AFTER_TRAVEL_FALLS_TO: f64 = 0.95, "1", Convention;
        /// As `RESIDUAL_FALLS_TO`, for a lag of the command: a lag acts only at the ends of a
        /// motion.
        LAG_FALLS_TO: f64 = 0.97, "1", Convention;
        /// A lag of the command is accepted only if its standard error is below this. If it were
        /// accepted before the friction law is known, it would replace a part of the law, with
        /// either sign.
        LAG_KNOWN: f64 = 0.1, "samples", Convention;
        /// Largest number of terms of a law.
        TERMS_MOST: usize = 4, "terms", Convention;
        /// A knot of the friction curve is left out if fewer windows than this are near its speed.
        KNOT_ROWS: f64 = 20.0, "windows", Convention;
        /// A term smaller than this share of Coulomb and viscous friction is reported as
        /// negligible.
        NEGLIGIBLE_TERM: f64 = 1e-3, "1", Convention;
    }
}
