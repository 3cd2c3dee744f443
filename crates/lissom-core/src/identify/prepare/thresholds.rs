//! Preparation of the runs: how a run is used, and what is reported about its channels.

thresholds! {
    "prepare" {
        /// A run is reported if its sample time differs from that of the runs in general by more
        /// than this factor: milliseconds or minutes taken for seconds differ by 1000 or 60.
        SAMPLE_TIMES_UNLIKE: f64 = 50.0, "1", Convention;
        /// Samples of a drive are not farther apart than this: at 0.3 s a motion of a second has three samples, and
        /// milliseconds taken for seconds are 1 s or more.
        SAMPLE_TIME_MOST_S: f64 = 0.3, "s", Convention;
        /// Samples of a drive are not closer together than this: seconds taken for milliseconds are 1 to 2 µs.
        SAMPLE_TIME_LEAST_S: f64 = 4e-6, "s", Convention;
        /// A channel moves if it changes by more than this many steps of its sensor. A smooth
        /// signal that turns back at its extreme value changes by about four steps within the
        /// length of its plateau, and is not clipped.
        MOVED_STEPS: f64 = 16.0, "steps", Convention;
        /// A channel must move by this many steps of its sensor for its slope to show whether it
        /// slows down.
        SLOWING_SHOWN: f64 = 4.0, "steps", Convention;
        /// A channel is clipped only if it reached its extreme value with more than this share of
        /// its largest slope.
        CLIPPED_SLOPE: f64 = 0.3, "1", Convention;
        /// A channel is clipped only if it had not slowed down to less than this share before. A
        /// motion that comes to rest has 1/3, one that is cut off has one minus half a sample.
        CLIPPED_SLOWED: f64 = 0.65, "1", Convention;
        /// Share of a run's readings at the end of a sensor's range above which this is reported,
        /// and the output-error method leaves these readings out.
        CLIPPED_REPORTED: f64 = 0.002, "1", Convention;
        /// Readings are on the steps of an encoder if their distance from the steps is less than
        /// this (rms). Readings that have nothing to do with the steps have 0.29.
        ENCODER_STEPS: f64 = 0.02, "steps", Convention;
        /// A jump is a number of whole turns if it differs from that by less than this.
        WHOLE_TURN: f64 = 0.02, "turns", Convention;
        /// A tip's sensor that repeats one value for fewer samples than this is not reported as
        /// frozen.
        FROZEN_SAMPLES: usize = 50, "samples", Convention;
        /// A motor's sensor is frozen if its angle stops from one sample to the next after it moved
        /// at this share of the speed just before; a motor that friction stops slows down first.
        FROZEN_AT_ONCE: f64 = 0.7, "1", Convention;
        /// A motor's sensor is frozen only if it moved at this share of its largest speed before.
        FROZEN_AT_SPEED: f64 = 0.04, "1", Convention;
        /// A tip's sensor is frozen only if it repeats one value this many times longer than
        /// anywhere else in the run.
        FROZEN_LONGER: f64 = 10.0, "1", Convention;
        /// A tip's sensor is frozen only if the motor moves by this share of its range in the
        /// meantime, a motor's only if the command changes by this share of its standard deviation.
        FROZEN_TRAVEL: f64 = 0.2, "1", Convention;
        /// A channel has steps if this share of the differences between its readings are whole
        /// multiples of one number; the rest may be wrong readings.
        STEP_MULTIPLES: f64 = 0.99, "1", Convention;
        /// A difference between readings is a whole multiple of the step if it differs from it by
        /// less than this: readings are often rounded in files.
        STEP_WHOLE: f64 = 0.01, "steps", Convention;
        /// A run is a sine if its harmonics leave at most this share of the motor's power
        /// unexplained.
        SINE_UNEXPLAINED: f64 = 0.02, "1", Convention;
        /// A run whose frequency is given is a sine if its higher harmonics have at most this share
        /// of the fundamental's amplitude.
        SINE_DISTORTION_GIVEN: f64 = 0.1, "1", Convention;
        /// A run whose frequency is not given is a sine if its higher harmonics have at most this
        /// share of the fundamental's amplitude: trapezoidal moves have 5 to 10 % and are not
        /// sines.
        SINE_DISTORTION_FOUND: f64 = 0.04, "1", Derived;
        /// A sine with fewer periods is reported: its standard errors are computed from the
        /// differences between periods.
        FEW_PERIODS: usize = 6, "periods", Convention;
        /// Share of a cycle in which the joint sticks above which this is reported: the estimate of
        /// the third-harmonic method is then about 3 % too low (`STICKING_BIAS`).
        STICKING_REPORTED: f64 = 0.05, "1", Convention;
        /// A motor is at rest if it stays within this many steps of its sensor, or `REST_RANGE`.
        REST_STEPS: f64 = 2.0, "steps", Convention;
        /// A motor is at rest if it stays within this share of its range, or `REST_STEPS`.
        REST_RANGE: f64 = 1e-3, "1", Convention;
        /// Share of a run at rest above which this is reported.
        AT_REST_REPORTED: f64 = 0.3, "1", Convention;
        /// A command looks like a position goal if its correlation with the motor's angle is more
        /// than this in the runs that are not sines.
        FOLLOWS_MOTOR: f64 = 0.99, "1", Convention;
        /// Time stamps that differ from an even grid by more than this share of the sample time
        /// (rms) are reported.
        JITTER_REPORTED: f64 = 0.05, "1", Convention;
        /// A motor turns in one direction if it does so for this share of the time in which it
        /// moves.
        ONE_WAY: f64 = 0.95, "1", Convention;
        /// A run turns in one direction only if the motor moves in more than this share of it.
        ONE_WAY_MOVES: f64 = 0.5, "1", Convention;
        /// Drift of a sine over its run, as a share of its amplitude, above which it is reported.
        DRIFT_REPORTED: f64 = 0.1, "1", Convention;
        /// A drift of fewer steps of the sensor is not reported.
        DRIFT_STEPS: f64 = 3.0, "steps", Convention;
        /// The zero error of a tip is subtracted from its readings if it is this many standard
        /// errors from zero: only 19 windows of a run show it, and their errors are not normally
        /// distributed.
        TIP_ZERO_SHOWN: f64 = 6.0, "standard errors", Convention;
        /// The zero error of a tip is reported if it is more than this share of the beam's
        /// deflection (rms).
        TIP_ZERO_REPORTED: f64 = 1.0, "1", Convention;
        /// A command is at its limit if it has at least this share of it: logs are rounded.
        AT_LIMIT: f64 = 0.999, "1", Convention;
        /// Share of a run with the command at its limit above which this is reported.
        SATURATION_REPORTED: f64 = 0.001, "1", Convention;
        /// The motor is at rest if it is slower than this share of its largest velocity: an angle
        /// that drifts slowly while friction holds the joint is not slip.
        REST_SPEED: f64 = 1e-5, "1", Convention;
        /// A velocity that is opposite to its slip phase by this many standard deviations is a
        /// reversal and is cut out: noise alone gives none in many thousands of samples.
        SURELY_REVERSED: f64 = 5.0, "standard deviations", Derived;
    }
}
