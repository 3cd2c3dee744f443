//! Which friction law is taken.

thresholds! {
    "friction law" {
        /// Windows are lengthened until the sensor's noise makes less than this share of the
        /// torque, through the inertia.
        TORQUE_OF_NOISE: f64 = 0.02, "1", Convention;
        /// A law that leaves less than this share of the torque beyond noise is complete: no law
        /// for the travel after reversals is tried.
        NOTHING_LEFT: f64 = 0.005, "1", Convention;
        /// Travel after a reversal that is left out, tried in turn, as shares of the usual travel
        /// of a slip phase: bristles build up their friction there.
        TRAVEL_AFTER_REVERSAL: [f64; 3] = [0.03, 0.06, 0.12], "1", Convention;
        /// Leaving out the travel after reversals must lower the residual beyond noise to this
        /// share.
        AFTER_TRAVEL_LEAVES: f64 = 0.75, "1", Convention;
        /// Quantile of the speeds that counts as the fastest: a few outliers do not.
        FASTEST_QUANTILE: f64 = 0.98, "1", Convention;
        /// Friction near rest falls off over at most this share of the fastest speed: of one that
        /// falls off more slowly the logs show no end, and Coulomb friction is any.
        NEAR_REST_MOST: f64 = 0.5, "1", Convention;
        /// As `RESIDUAL_FALLS_TO`, of friction near rest where the travel after reversals is left
        /// out: the two come together, and most of the residual there is noise.
        AFTER_TRAVEL_FALLS_TO: f64 = 0.95, "1", Convention;
        /// As `RESIDUAL_FALLS_TO`, of a lag of the command: a lag shows only at the ends of a
        /// motion.
        LAG_FALLS_TO: f64 = 0.97, "1", Convention;
        /// A lag of the command is taken only if its standard error is below this. If it were taken
        /// before friction's law is known, it would replace part of it, with either sign.
        LAG_KNOWN: f64 = 0.1, "samples", Convention;
        /// Most terms of a law.
        TERMS_MOST: usize = 4, "terms", Convention;
        /// A knot of the friction curve is left out if fewer windows lie near its speed.
        KNOT_ROWS: f64 = 20.0, "windows", Convention;
        /// A term smaller than this share of Coulomb and viscous friction is not warned of.
        NEGLIGIBLE_TERM: f64 = 1e-3, "1", Convention;
    }
}
