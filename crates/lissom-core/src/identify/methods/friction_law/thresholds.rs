//! Choice of the model of the torque.

thresholds! {
    "friction law" {
        /// Windows are lengthened until the torque that inertia makes of the sensor's noise is less
        /// than this share of the torque.
        TORQUE_OF_NOISE: f64 = 0.02, "1", Convention;
        /// Quantile of the speeds that is taken as the fastest speed, so that a few outliers do not
        /// matter.
        FASTEST_QUANTILE: f64 = 0.98, "1", Convention;
        /// The speed over which friction near standstill changes is at most this share of the
        /// fastest speed: the logs do not show the end of a slower change, and Coulomb friction
        /// would be undetermined.
        NEAR_REST_MOST: f64 = 0.5, "1", Convention;
        /// Probability that chance alone gives an improvement of the prediction that adopts a
        /// term: two standard errors of a normal distribution, by Student's t for few blocks.
        BETTER_CHANCE: f64 = 0.022_75, "1", Derived;
        /// A term is worth adopting if each of its amplitudes saves more than this share of the squared
        /// residual of what was left out; a smaller one counts in the intervals. On 115 generated and
        /// 12 measured logs terms of the truth save 6 % and more; terms that stand for another effect
        /// save up to 3 %.
        SAVED_LEAST: f64 = 0.05, "1", Measured;
        /// Where one motion is repeated, the errors of its sensor are, too: a ripple must then save more
        /// than this share of the squared residual (`tests/repeated_sine.rs`).
        RIPPLE_OF_ONE_MOTION: f64 = 0.5, "1", Convention;
        /// No term is adopted if there are fewer blocks of neighbouring slip phases than this.
        BLOCKS_LEAST: usize = 6, "blocks", Convention;
        /// Terms that are possible widen an interval up to this standard error, as a share of the
        /// value: by itself that refuses no estimate.
        WIDENED_MOST: f64 = 0.99, "1", Convention;
        /// Longest lag of a drive, its bus and its sensors.
        LAG_MOST_S: f64 = 0.1, "s", Convention;
        /// The command is made later until less than this remains of its lag; a lag below it is
        /// none.
        LAG_SETTLED: f64 = 0.05, "samples", Convention;
        /// A lag of the angle is a filter and not a delay, or a delay and not a filter, if the
        /// residual with the one is less than this share of the residual with the other.
        LAG_SHAPE_TOLD: f64 = 0.8, "1", Convention;
        /// Gravity is tried as a missing term only if the motor turns by more than this: over a
        /// smaller angle its sine is a straight line, like the torque of a spring.
        TRAVEL_OF_GRAVITY_RAD: f64 = 1.0, "rad", Convention;
        /// Largest number of terms of a model beyond the line.
        TERMS_MOST: usize = 5, "terms", Convention;
        /// A friction law that leaves more than this share of the torque unexplained, and not by
        /// noise, may stand for another effect: it is reported as a warning.
        LAW_LEAVES_MUCH: f64 = 0.05, "1", Convention;
        /// A knot of the friction curve is left out if fewer windows than this are near its speed.
        KNOT_ROWS: f64 = 20.0, "windows", Convention;
    }
}
