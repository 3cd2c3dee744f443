//! Which runs are proposed.

thresholds! {
    "plan" {
        /// Relative error wished for the damping where nothing else is given. If damping of one
        /// kind is taken for the other, viscous friction is wrong; identification told them apart
        /// at 4 % and not at 14 % (docs/src/how-to/planning.md).
        DAMPING_WISHED: f64 = 0.05, "1", Measured;
        /// Share of a run in which the joint may stick: the third-harmonic method and the frequency
        /// response need it to slip.
        STUCK_MOST: f64 = 0.15, "1", Convention;
        /// The motor must move by this many standard deviations (or steps) of its sensor: less says
        /// nothing of friction.
        TRAVEL_LEAST: f64 = 20.0, "standard deviations or steps", Convention;
        /// Share of a sensor's range that a run may use: a margin for what the numbers given are
        /// off by.
        RANGE_USED: f64 = 0.9, "1", Convention;
        /// Modes that turn by more than this in a sample are not followed: at most six samples a
        /// period would show them.
        MODE_FOLLOWED: f64 = 1.0, "rad", Convention;
        /// Sines keep away from modes with a damping ratio below this.
        LIGHTLY_DAMPED: f64 = 0.1, "1", Convention;
        /// Share of a mode's frequency by which sines and their third harmonics keep away from it:
        /// the true frequency may differ from the given one.
        KEEP_OFF: f64 = 0.12, "1", Convention;
        /// Half-widths of a resonance by which sines and their third harmonics keep away from it.
        KEEP_OFF_WIDTHS: f64 = 4.0, "half-widths", Convention;
        /// Shortest run of a sine: its standard errors rest on the differences between periods.
        SINE_PERIODS: f64 = 6.0, "periods", Convention;
        /// Shortest run of a multisine.
        MULTISINE_PERIODS: f64 = 3.0, "periods", Convention;
        /// Shortest run of a periodic motion. A shorter run shows friction but not which kind of
        /// damping a mode has, and an error there is in all estimates.
        RUN_LEAST_S: f64 = 10.0, "s", Convention;
        /// Highest line of a multisine, as a multiple of its lowest frequency.
        HIGHEST_LINE: f64 = 39.0, "1", Convention;
        /// No run has frequencies above this share of the Nyquist frequency.
        NYQUIST_SHARE: f64 = 0.5, "1", Convention;
        /// Longest wait for a transient before a run is logged.
        TRANSIENT_MOST_S: f64 = 300.0, "s", Convention;
        /// Longest wait for a transient, as a share of the time of all runs.
        TRANSIENT_MOST_SHARE: f64 = 0.25, "1", Convention;
        /// Window of the torque's equation with gravity, as a share of the shortest slip phase: expected
        /// standard errors are then about those that the regression states.
        WINDOW_OF_SLIP: f64 = 0.8, "1", Measured;
        /// A run is added or exchanged only if the plan gets better by this share: less is not
        /// worth a run.
        GAIN_LEAST: f64 = 1e-4, "1", Convention;
    }
}
