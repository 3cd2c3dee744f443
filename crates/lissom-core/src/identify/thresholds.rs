//! What several methods share, and the steps that join them.

thresholds! {
    "all methods" {
        /// Half width of a 95 % interval: the two-sided 95 % point of the normal distribution.
        NORMAL_95: f64 = 1.959_964, "standard errors", Derived;
        /// An effect is present if it is this many standard errors from zero: chance alone gives
        /// that in 0.3 % of all cases.
        PRESENT: f64 = 3.0, "standard errors", Convention;
        /// A term is added to a model, or reported, if it is this many standard errors from zero.
        /// It is more than `PRESENT`, because many terms are tried and one of them may come out by
        /// chance.
        CLEARLY_PRESENT: f64 = 4.0, "standard errors", Convention;
        /// The sign of an estimate is taken as shown if it is this many standard errors from zero;
        /// chance alone gives the wrong one in 2 % of all cases. A mode
        /// whose damping ratio is negative by this is rejected, and so is a friction law with
        /// negative friction.
        SIGN_SHOWN: f64 = 2.0, "standard errors", Convention;
        /// A hypothesis (a straight line, a white residual) is rejected if chance alone gives what
        /// was measured with a probability below this.
        REJECTED_CHANCE: f64 = 0.01, "1", Convention;
        /// A term pays for its parameter if the residual with it falls to this share or less. A
        /// term that is significant by chance leaves nearly all of the residual.
        RESIDUAL_FALLS_TO: f64 = 0.9, "1", Convention;
        /// A lag of the command is half a sample if it differs from that by less than this share,
        /// or by less than its error (`PRESENT`).
        LAG_HALF_SAMPLE: f64 = 0.05, "1", Convention;
        /// Of fewer runs none is left out because a sensor freezes in it or because it is unlike the
        /// others.
        RUNS_LEFT_OUT_OF: usize = 5, "runs", Convention;
        /// Residual torque, as a share of the torque, above which a model does not describe it
        /// well: estimates are reported as uncertain, and a prediction as poor.
        UNEXPLAINED_TORQUE: f64 = 0.15, "1", Convention;
        /// Residual torque, as a share of the torque, above which the model explains too little of
        /// it: the regression's estimates are refused, and a prediction has failed.
        REFUSED_TORQUE: f64 = 0.6, "1", Convention;
        /// A velocity is taken over the time in which the motor moves by this many standard
        /// deviations of its sensor's noise, so that its sign is certain.
        TRAVEL_OVER_NOISE: f64 = 10.0, "standard deviations", Convention;
        /// Two frequencies are the same if they differ by less than this share: two sines of a
        /// campaign, or the frequency given and the one found.
        SAME_FREQUENCY: f64 = 0.02, "1", Convention;
        /// A run has three times the frequency of another, as the third-harmonic method needs, if
        /// the ratio is 3 to this share.
        TRIPLE_FREQUENCY: f64 = 2e-3, "1", Convention;
        /// Rational models are fitted to the responses of single sines only if there are this many:
        /// fewer leave a model with one mode nearly unchecked.
        STEPPED_SINES_LEAST: usize = 4, "runs", Convention;
        /// Relative standard error up to which a regression on runs at constant velocities alone is
        /// accepted: such runs hardly show the inertia.
        CONSTANT_VELOCITY_ALONE: f64 = 0.15, "1", Convention;
        /// The same of inertia where slip phases are few: it is known so well only where the velocity
        /// changes for a good part of the time.
        CONSTANT_VELOCITY_FEW: f64 = 0.01, "1", Convention;
        /// Residual of a tip's acceleration, as a share of it, above which the beam's regression is
        /// not used.
        BEAM_RESIDUAL: f64 = 0.1, "1", Convention;
        /// A mode of the beam's regression may have a damping ratio down to this by noise. If one
        /// is lower, it gains energy, so the frequencies are as wrong and the regression is not
        /// used.
        MODE_DAMPING_LEAST: f64 = -0.05, "1", Convention;
        /// Dimensions of an arm are known to this share at best, so smaller differences between the
        /// described and the identified arm do not count.
        GEOMETRY_KNOWN: f64 = 1e-3, "1", Convention;
        /// The described arm agrees with the identified one if they differ by less than this many
        /// times `GEOMETRY_KNOWN` (rms).
        GEOMETRY_AGREES: f64 = 3.0, "1", Convention;
        /// A dimension that explains the difference is reported with the best one if it leaves up
        /// to this many times as much.
        GEOMETRY_AS_GOOD: f64 = 1.5, "1", Convention;
        /// Each span's length is tried as an explanation only up to this many spans: of more the
        /// frequencies do not tell one from another.
        SINGLE_SPANS_MOST: usize = 4, "spans", Convention;
    }
}
