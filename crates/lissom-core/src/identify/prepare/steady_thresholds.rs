//! Constant velocities: which stretches count, and when a line through the points is accepted.

thresholds! {
    "constant velocity" {
        /// A run that turns in one direction is meant for this method if constant velocities take
        /// this share of its time in motion.
        STEADY_ONE_WAY: f64 = 0.5, "1", Convention;
        /// A run that turns in both directions is meant for this method if constant velocities take
        /// this share of its time in motion: ordinary moves have up to 0.8.
        STEADY_BOTH_WAYS: f64 = 0.9, "1", Measured;
        /// Two speeds count as one if their ratio is below this.
        SAME_SPEED: f64 = 1.05, "1", Convention;
        /// A stretch is extended until its velocity differs by one of these shares, tried in turn.
        GROWN_BY: [f64; 3] = [0.12, 0.06, 0.03], "1", Convention;
        /// An extended stretch is steady if, after trimming, its velocity changes by less than this
        /// part of the share by which it was extended. A ramp keeps 3/4 of it, the crest of a sine
        /// 9/16, the inflection of a cubic 27/64, so none of them passes.
        STEADY_PART: f64 = 1.0 / 6.0, "1", Derived;
        /// A stretch is not used if the command changes by more than this share over it: something
        /// other than friction then takes torque.
        COMMAND_CHANGE: f64 = 0.1, "1", Convention;
        /// A stretch is not used if its velocity has a larger relative standard error: the bias of
        /// the slope is the square of this error and stays below 1e-4.
        VELOCITY_KNOWN: f64 = 0.01, "1", Derived;
        /// The motor has stopped or turned back if its velocity falls below this share of the mean.
        STOPPED_SPEED: f64 = 0.1, "1", Convention;
        /// A stretch is not used if the motor has stopped in more than this share of it; a smaller
        /// share may be wrong readings.
        STOPPED_SHARE: f64 = 0.01, "1", Convention;
        /// A stretch whose mean velocity is steady is not used if its velocity varies by more than
        /// this share for more than `VARIES_SHARE` of the time: inertia then takes torque.
        VARIES_BY: f64 = 0.15, "1", Convention;
        /// Share of the time for which the velocity of a steady stretch may differ by more than
        /// `VARIES_BY`.
        VARIES_SHARE: f64 = 0.2, "1", Convention;
        /// An extended stretch that shares this part with a rejected one is not tried again.
        SAME_STRETCH: f64 = 0.9, "1", Convention;
    }
}
