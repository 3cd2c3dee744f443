//! What decides how a run is read, and what is reported of its channels.

thresholds! {
    "prepare" {
        /// A channel moves if it changes by more than this many of its sensor's steps. A smooth
        /// signal that turns round at its extreme changes by about four within the length of its
        /// plateau, and is not clipped.
        MOVED_STEPS: f64 = 16.0, "steps", Convention;
        /// Steps of its sensor by which a channel must move for its slope to show whether it slows
        /// down.
        SLOWING_SHOWN: f64 = 4.0, "steps", Convention;
        /// A channel is clipped only if it came to its extreme value with more than this share of
        /// its largest slope.
        CLIPPED_SLOPE: f64 = 0.3, "1", Convention;
        /// A channel is clipped only if it was not slowed down before by more than this. A motion
        /// that comes to rest gives 1/3, one that is cut off gives 1 less half a sample.
        CLIPPED_SLOWED: f64 = 0.65, "1", Convention;
        /// Share of a run's readings at the end of a sensor's range above which it is reported, and
        /// the output-error method leaves these readings out.
        CLIPPED_REPORTED: f64 = 0.002, "1", Convention;
        /// A reading is a spike, or a jump to another level, if its second difference is this many
        /// times what 95 % of the others stay below, and this many steps of the sensor.
        SPIKE_SIZE: f64 = 20.0, "1", Convention;
        /// The second differences of a spike are 1, -2, 1 and those of a jump 1, -1 to this share;
        /// those of a knock are not.
        SPIKE_SHAPE: f64 = 0.1, "1", Convention;
        /// The first and the last reading are checked for spikes only if the channel has this many
        /// second differences to compare with.
        SPIKE_AT_END_LEAST: usize = 20, "samples", Convention;
        /// Readings lie on the steps of an encoder if they are off them by less than this (rms).
        /// Readings that have nothing to do with the steps are off by 0.29.
        ENCODER_STEPS: f64 = 0.02, "steps", Convention;
        /// A jump is one of whole turns if it differs from them by less than this.
        WHOLE_TURN: f64 = 0.02, "turns", Convention;
        /// A tip's sensor that shows one value for fewer samples is not reported as frozen.
        FROZEN_SAMPLES: usize = 50, "samples", Convention;
        /// A motor's sensor is frozen if its angle stands still at once after it had moved at this
        /// share of the speed just before; one that friction stops becomes slow first.
        FROZEN_AT_ONCE: f64 = 0.7, "1", Convention;
        /// A motor's sensor is frozen only if it had moved at this share of its largest speed.
        FROZEN_AT_SPEED: f64 = 0.04, "1", Convention;
        /// A tip's sensor is frozen only if it shows one value this many times longer than anywhere
        /// else in the run.
        FROZEN_LONGER: f64 = 10.0, "1", Convention;
        /// A tip's sensor is frozen only if the motor moves by this share of its range in the
        /// meantime, a motor's only if the command changes by this share of its standard deviation.
        FROZEN_TRAVEL: f64 = 0.2, "1", Convention;
        /// A channel has steps if this share of the differences between its readings are whole
        /// multiples of one number; the rest may be damaged.
        STEP_MULTIPLES: f64 = 0.99, "1", Convention;
        /// A difference between readings is a whole multiple of the step if it is off by less than
        /// this: readings are often rounded in files.
        STEP_WHOLE: f64 = 0.01, "steps", Convention;
        /// A run is a sine if its harmonics leave at most this share of the motor's power.
        SINE_UNEXPLAINED: f64 = 0.02, "1", Convention;
        /// A run whose frequency is given is a sine if its harmonics above the first have at most
        /// this share of the first's amplitude.
        SINE_DISTORTION_GIVEN: f64 = 0.1, "1", Convention;
        /// A run whose frequency is not given is a sine if its harmonics above the first have at
        /// most this share of the first's amplitude: trapezoidal moves have 5 to 10 %, and are not
        /// sines.
        SINE_DISTORTION_FOUND: f64 = 0.04, "1", Derived;
        /// A sine of fewer periods is reported: its standard errors rest on the differences between
        /// periods.
        FEW_PERIODS: usize = 6, "periods", Convention;
        /// Share of a cycle in which the joint sticks above which it is reported: the
        /// third-harmonic method is then about 3 % low (`STICKING_BIAS`).
        STICKING_REPORTED: f64 = 0.05, "1", Convention;
        /// A motor is at rest if it stays within this many steps of its sensor, or `REST_RANGE`.
        REST_STEPS: f64 = 2.0, "steps", Convention;
        /// A motor is at rest if it stays within this share of its range, or `REST_STEPS`.
        REST_RANGE: f64 = 1e-3, "1", Convention;
        /// Share of a run at rest above which it is reported.
        AT_REST_REPORTED: f64 = 0.3, "1", Convention;
        /// A command looks like a position goal if its correlation with the motor's angle is more
        /// than this in the runs that are no sines.
        FOLLOWS_MOTOR: f64 = 0.99, "1", Convention;
        /// Time stamps that are off an even grid by more than this share of the sample time (rms)
        /// are reported.
        JITTER_REPORTED: f64 = 0.05, "1", Convention;
        /// A motor turns one way if it does so in this share of the time in which it moves.
        ONE_WAY: f64 = 0.95, "1", Convention;
        /// A run turns one way only if the motor moves in more than this share of it.
        ONE_WAY_MOVES: f64 = 0.5, "1", Convention;
        /// Drift of a sine over its run, as a share of its amplitude, above which it is reported.
        DRIFT_REPORTED: f64 = 0.1, "1", Convention;
        /// A drift of fewer steps of the sensor is not reported.
        DRIFT_STEPS: f64 = 3.0, "steps", Convention;
        /// The zero of a tip is taken off its readings if it is this many standard errors from nothing:
        /// 19 windows of a run show it, and their errors are no normal ones.
        TIP_ZERO_SHOWN: f64 = 6.0, "standard errors", Convention;
        /// The zero of a tip is reported if it is more than this share of the beam's deflection (rms).
        TIP_ZERO_REPORTED: f64 = 1.0, "1", Convention;
        /// A command is at its limit from this share of it on: logs are rounded.
        AT_LIMIT: f64 = 0.999, "1", Convention;
        /// Share of a run with the command at its limit above which it is reported.
        SATURATION_REPORTED: f64 = 0.001, "1", Convention;
    }
}
