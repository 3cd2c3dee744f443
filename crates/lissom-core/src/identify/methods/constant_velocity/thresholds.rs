//! What counts as a constant velocity, and when a line through the points is accepted.

thresholds! {
    "constant velocity" {
        /// A run that turns one way is made for this method if constant velocities are this share
        /// of its time in motion.
        STEADY_ONE_WAY: f64 = 0.5, "1", Convention;
        /// A run that turns both ways is made for this method if constant velocities are this share
        /// of its time in motion: ordinary moves have up to 0.8.
        STEADY_BOTH_WAYS: f64 = 0.9, "1", Measured;
        /// Two speeds count as one if their ratio is below this.
        SAME_SPEED: f64 = 1.05, "1", Convention;
        /// A stretch is grown until its velocity differs by one of these shares, tried in turn.
        GROWN_BY: [f64; 3] = [0.12, 0.06, 0.03], "1", Convention;
        /// A grown stretch is steady if its trimmed velocity changes by less than this part of what
        /// it was grown by. A ramp leaves 3/4 of it, the crest of a sine 9/16, the inflection of a
        /// cubic 27/64, so none of them passes.
        STEADY_PART: f64 = 1.0 / 6.0, "1", Derived;
        /// A stretch is not used if the command changes by more than this share over it: something
        /// other than friction takes torque there.
        COMMAND_CHANGE: f64 = 0.1, "1", Convention;
        /// A stretch is not used if its velocity has a larger relative standard error: the bias of
        /// the slope is its square, and stays below 1e-4.
        VELOCITY_KNOWN: f64 = 0.01, "1", Derived;
        /// The motor stops or turns back if its velocity falls below this share of the mean.
        STOPPED_SPEED: f64 = 0.1, "1", Convention;
        /// A stretch is not used if the motor stops in more than this share of it; less may be
        /// damaged readings.
        STOPPED_SHARE: f64 = 0.01, "1", Convention;
        /// A stretch whose mean velocity is steady is not used if its velocity swings by more than
        /// this share for more than `VARIES_SHARE` of the time: inertia takes torque then.
        VARIES_BY: f64 = 0.15, "1", Convention;
        /// Share of the time for which a steady stretch may be off by `VARIES_BY`.
        VARIES_SHARE: f64 = 0.2, "1", Convention;
        /// A grown stretch that shares this part with a rejected one is not tried again.
        SAME_STRETCH: f64 = 0.9, "1", Convention;
    }
}
