//! Thresholds that several methods share, and those of the steps that connect the methods.

thresholds! {
    "all methods" {
        /// Half width of a 95 % interval: the two-sided 95 % point of the normal distribution.
        NORMAL_95: f64 = 1.959_964, "standard errors", Derived;
        /// An effect is present if it is this many standard errors from zero. Chance alone gives
        /// such a value in 0.3 % of all cases.
        PRESENT: f64 = 3.0, "standard errors", Convention;
        /// A term is added to a model, or reported, if it is this many standard errors from zero.
        /// This is more than `PRESENT`, because many terms are tried and one of them may reach that
        /// level by chance.
        CLEARLY_PRESENT: f64 = 4.0, "standard errors", Convention;
        /// The sign of an estimate is known if the estimate is this many standard errors from zero.
        /// Chance alone gives the wrong sign in 2 % of all cases. A mode whose damping ratio is
        /// negative by this much is rejected, and so is a friction law with negative friction.
        SIGN_SHOWN: f64 = 2.0, "standard errors", Convention;
        /// A hypothesis (a straight line, a white residual) is rejected if chance alone would give
        /// the measured result with a probability below this.
        REJECTED_CHANCE: f64 = 0.01, "1", Convention;
        /// An estimate whose relative standard error is above this is refused: not even its order
        /// of magnitude is known.
        REFUSED_ERROR: f64 = 1.0, "1", Convention;
        /// A term is worth its parameter if it reduces the residual to this share or less. A term
        /// that is significant only by chance reduces the residual hardly at all.
        RESIDUAL_FALLS_TO: f64 = 0.9, "1", Convention;
        /// A lag of the command is half a sample if it differs from half a sample by less than this
        /// share, or by less than its error (`PRESENT`).
        LAG_HALF_SAMPLE: f64 = 0.05, "1", Convention;
        /// A run with a frozen sensor, or a run that is unlike the others, is left out only if
        /// there are at least this many runs.
        RUNS_LEFT_OUT_OF: usize = 5, "runs", Convention;
        /// Residual torque, as a share of the torque, above which a model does not describe the
        /// torque well: estimates are reported as uncertain, and a prediction as poor.
        UNEXPLAINED_TORQUE: f64 = 0.15, "1", Convention;
        /// Residual torque, as a share of the torque, above which a model explains too little: the
        /// regression's estimates are refused, and a prediction has failed.
        REFUSED_TORQUE: f64 = 0.6, "1", Convention;
        /// A velocity is taken over the time in which the motor moves by this many standard
        /// deviations of its sensor's noise, so that its sign is certain.
        TRAVEL_OVER_NOISE: f64 = 10.0, "standard deviations", Convention;
        /// Two frequencies are the same if they differ by less than this share: those of two sines
        /// of a campaign, or the given frequency and the one found.
        SAME_FREQUENCY: f64 = 0.02, "1", Convention;
        /// A run has three times the frequency of another, as the third-harmonic method needs, if
        /// the ratio differs from 3 by less than this share.
        TRIPLE_FREQUENCY: f64 = 2e-3, "1", Convention;
        /// Rational models are fitted to the responses of single sines only if there are this many
        /// sines: with fewer, a model with one mode is hardly tested by the data.
        STEPPED_SINES_LEAST: usize = 4, "runs", Convention;
        /// Relative standard error up to which a regression that uses only runs at constant
        /// velocities is accepted: such runs contain little information about inertia.
        CONSTANT_VELOCITY_ALONE: f64 = 0.15, "1", Convention;
        /// As `CONSTANT_VELOCITY_ALONE`, for inertia if there are few slip phases: inertia is known
        /// this well only if the velocity changes for a large part of the time.
        CONSTANT_VELOCITY_FEW: f64 = 0.01, "1", Convention;
        /// Residual of a tip's acceleration, as a share of the acceleration, above which the beam's
        /// regression is not used.
        BEAM_RESIDUAL: f64 = 0.1, "1", Convention;
        /// Sum of a tip's shares in the modes below whose inverse, or above which, the beam's regression is not used. The first
        /// mode of a uniform beam has 1.14 by the tip's position and 1.57 by its slope; its higher modes take the rest.
        BEAM_SHARES: f64 = 2.0, "1", Convention;
        /// Noise may make the damping ratio of a mode of the beam's regression negative down to
        /// this value. If a ratio is lower, the mode gains energy: its frequency is then wrong as
        /// well, and the regression is not used.
        MODE_DAMPING_LEAST: f64 = -0.05, "1", Convention;
        /// Dimensions of an arm are known to this share at best, so smaller differences between the
        /// described arm and the identified one do not count.
        GEOMETRY_KNOWN: f64 = 1e-3, "1", Convention;
        /// The described arm agrees with the identified one if they differ by less than this many
        /// times `GEOMETRY_KNOWN` (rms).
        GEOMETRY_AGREES: f64 = 3.0, "1", Convention;
        /// A dimension that explains the difference between the described and the identified arm is
        /// reported together with the best one if its residual is at most this many times as large.
        GEOMETRY_AS_GOOD: f64 = 1.5, "1", Convention;
        /// The length of each span is tried as an explanation only up to this many spans: with
        /// more, the frequencies do not distinguish the spans.
        SINGLE_SPANS_MOST: usize = 4, "spans", Convention;
    }
}
