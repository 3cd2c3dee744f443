//! Choice of the runs of a plan.

thresholds! {
    "plan" {
        /// Requested relative standard error of damping, if no other is given. If one kind of
        /// damping is taken for the other, viscous friction is wrong; identification separated them
        /// at 4 % and not at 14 % (docs/src/how-to/planning.md).
        DAMPING_WISHED: f64 = 0.05, "1", Measured;
        /// Largest share of a run in which the joint may stick: the third-harmonic method and the
        /// frequency response need slip.
        STUCK_MOST: f64 = 0.15, "1", Convention;
        /// The motor must move by at least this many standard deviations (or steps) of its sensor:
        /// a smaller motion contains no information about friction.
        TRAVEL_LEAST: f64 = 20.0, "standard deviations or steps", Convention;
        /// Share of a sensor's range that a run may use, with a margin for errors of the given
        /// parameters.
        RANGE_USED: f64 = 0.9, "1", Convention;
        /// Modes whose phase turns by more than this in a sample are left out: at most six samples
        /// would show a period.
        MODE_FOLLOWED: f64 = 1.0, "rad", Convention;
        /// Sines are kept away from modes with a damping ratio below this.
        LIGHTLY_DAMPED: f64 = 0.1, "1", Convention;
        /// Share of a mode's frequency by which sines and their third harmonics are kept away from
        /// it: the true frequency may differ from the given one.
        KEEP_OFF: f64 = 0.12, "1", Convention;
        /// Number of half-widths of a resonance by which sines and their third harmonics are kept
        /// away from it.
        KEEP_OFF_WIDTHS: f64 = 4.0, "half-widths", Convention;
        /// Shortest run of a sine: its standard errors are computed from the differences between
        /// periods.
        SINE_PERIODS: f64 = 6.0, "periods", Convention;
        /// Shortest run of a multisine.
        MULTISINE_PERIODS: f64 = 3.0, "periods", Convention;
        /// Shortest run of a periodic motion. A shorter run shows friction but not which kind of
        /// damping a mode has, and this error affects all estimates.
        RUN_LEAST_S: f64 = 10.0, "s", Convention;
        /// Highest line of a multisine, as a multiple of its lowest frequency.
        HIGHEST_LINE: f64 = 39.0, "1", Convention;
        /// No run has frequencies above this share of the Nyquist frequency.
        NYQUIST_SHARE: f64 = 0.5, "1", Convention;
        /// Longest wait for a transient before a run is logged.
        TRANSIENT_MOST_S: f64 = 300.0, "s", Convention;
        /// Longest wait for a transient, as a share of the time of all runs.
        TRANSIENT_MOST_SHARE: f64 = 0.25, "1", Convention;
        /// Window of the torque equation with gravity, as a share of the shortest slip phase: with
        /// it the expected standard errors are about those of the regression.
        WINDOW_OF_SLIP: f64 = 0.8, "1", Measured;
        /// A run is added or exchanged only if this improves the plan by this share: a smaller gain
        /// is not worth a run.
        GAIN_LEAST: f64 = 1e-4, "1", Convention;
    }
}
