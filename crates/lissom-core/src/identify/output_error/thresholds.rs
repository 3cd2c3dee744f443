//! Output-error method: acceptance, search, further parameters and findings.
//!
//! The schedule of the damping in Levenberg-Marquardt, bounds against rounding and the steps of finite differences are not
//! thresholds; they are next to the code that uses them.

thresholds! {
    "output error: acceptance" {
        /// Noise of a measured command is counted if the likelihood with it is larger by this, as a
        /// fall of −2·ln: four standard errors.
        COMMAND_NOISE_TOLD: f64 = 16.0, "1", Convention;
        /// Where noise of the command is counted, an axis without tips is replayed if its standard errors are so
        /// many times smaller than those of slip phases, in the geometric mean: an equation of torques
        /// has this noise on its right side, where it biases nothing.
        KNOWS_MORE: f64 = 1.5, "1", Convention;
        /// Largest ratio of a channel's residual to its sensor's noise up to which an arm that is
        /// simulated over whole runs is accepted. On short windows, a search with a larger ratio is
        /// given up; this changed no accepted estimate of 30 study campaigns and of the measured
        /// logs (docs/src/evidence/pruned.md). Above this ratio a search ends by `STEP_SHARE_LEAST`.
        RESIDUAL_FAR_ABOVE_NOISE: f64 = 3.0, "1", Convention;
        /// A residual below this many times the sensor's noise counts as noise. An arm that is
        /// simulated over windows shorter than the runs is accepted only below it.
        RESIDUAL_AT_NOISE: f64 = 1.25, "1", Convention;
        /// Ratio of the residual to the sensor's noise above which lags of tips are tried. Below it
        /// there is nothing for them to explain.
        RESIDUAL_ABOVE_NOISE: f64 = 1.2, "1", Convention;
        /// Share of a channel's squared residual that varies more slowly than its sensor's noise,
        /// above which the arm lacks an effect: the search is repeated from other frequencies, and
        /// the share is reported.
        SLOW_RESIDUAL: f64 = 0.003, "1", Convention;
        /// As `SLOW_RESIDUAL`, where noise of the command is estimated from the residual: the arm is refused above it, because
        /// what it lacks may have been taken for noise.
        SLOW_INNOVATIONS: f64 = 0.2, "1", Convention;
        /// Windows are not lengthened further if a residual is larger than on the first windows by
        /// this factor. Errors of the arm add up over a window, but noise does not.
        RESIDUAL_GROWN: f64 = 1.5, "1", Convention;
        /// Windows are too long if the difference of two neighbouring motions grows by more than
        /// this factor over them. Sums of squares lose the square of it in digits, and errors of
        /// the simulation's steps grow with it.
        NEIGHBOURS_GROW_APART: f64 = 100.0, "1", Convention;
        /// A parameter must reduce the cost by at least this share, because errors that are not
        /// white noise may explain less. The share is small, because leaving out damping against
        /// the frame changes viscous friction by many standard errors.
        PARAMETER_SHARE_LEAST: f64 = 1e-4, "1", Convention;
        /// A group of parameters that reduces the cost by this share is added even if its standard
        /// errors are large: they contain the error of the arm without it. A friction term must
        /// reduce the cost by more than this.
        GROUP_SHARE_LARGE: f64 = 0.02, "1", Convention;
        /// If the residual is above the noise, further parameters must reduce the squared residual
        /// beyond the noise to this share or less. Without this rule, friction terms were added for
        /// two small logs of joints that have none (docs/src/evidence/pruned.md).
        EXCESS_LEFT: f64 = 0.7, "1", Measured;
        /// Largest number of groups of parameters that are added at one length of the windows.
        GROUPS_ADDED_MOST: usize = 3, "groups", Convention;
    }
    "output error: starting arms" {
        /// Smallest stiffness of a mode of a starting arm, as a share of the coupling: the search
        /// changes its logarithm, so it must be positive.
        START_STIFFNESS_LEAST: f64 = 0.02, "1", Convention;
        /// A pole is not used as a mode of a starting arm if it is outside the frequencies of the
        /// responses by more than this factor: it describes their ends.
        START_POLE_OUTSIDE: f64 = 3.0, "1", Convention;
        /// A mode is left out of a starting arm if its share in the motion of every tip is smaller
        /// than this: such modes are due to noise.
        START_SHAPE_LEAST: f64 = 0.05, "1", Convention;
        /// Starting arms whose cost after a short search exceeds the best cost by more than this
        /// factor are tried last.
        START_COST_FAR: f64 = 3.0, "1", Convention;
        /// Two starting arms are the same if the frequencies and stiffnesses of their modes agree
        /// to within this share. Only one of them is tried.
        STARTS_ALIKE: f64 = 0.05, "1", Convention;
    }
    "output error: windows" {
        /// A window begins at a time when the motor's speed is at least this share of its rms
        /// value, so that the sign of the velocity is certain.
        WINDOW_START_SPEED: f64 = 0.1, "1", Convention;
        /// Shortest window.
        WINDOW_SAMPLES_LEAST: usize = 20, "samples", Convention;
        /// Smallest length of the first windows.
        FIRST_WINDOW_SAMPLES: f64 = 80.0, "samples", Convention;
        /// Smallest length of the first windows, in periods of the slowest mode.
        FIRST_WINDOW_PERIODS: f64 = 0.3, "periods", Convention;
        /// The windows of each stage are longer than those of the stage before by this factor.
        WINDOW_WIDENING: f64 = 4.0, "1", Convention;
        /// As `WINDOW_WIDENING`, after a search that ended in a wrong minimum.
        WINDOW_WIDENING_SLOW: f64 = 1.6, "1", Convention;
    }
    "output error: search" {
        /// Largest number of steps of a search at one length of the windows, if other searches
        /// follow.
        STAGE_STEPS_MOST: usize = 12, "steps", Convention;
        /// Approximate number of samples that are simulated, if longer windows follow.
        STAGE_SAMPLES: usize = 40_000, "samples", Convention;
        /// Largest number of steps of the last search.
        LAST_STEPS_MOST: usize = 40, "steps", Convention;
        /// Number of steps of a short search that compares starting points.
        PROBE_STEPS: usize = 8, "steps", Convention;
        /// Approximate number of samples that a short search simulates; a third where innovations
        /// are computed, which take three times as long.
        PROBE_SAMPLES: usize = 15_000, "samples", Convention;
        /// The last search ends if a step is expected to reduce the cost, a sum of squares in
        /// standard deviations of the noise, by less than this. A parameter would then change by a
        /// seventh of its standard error.
        LAST_STEP_FALL: f64 = 0.02, "1", Convention;
        /// As `LAST_STEP_FALL`, for searches that others follow: a parameter would change by one
        /// standard error. On the campaign of `lissom demo` this took 8 to 15 % less time and gave
        /// the same estimates (CHANGELOG.md).
        STAGE_STEP_FALL: f64 = 1.0, "1", Measured;
        /// A search that others follow, or with a residual far above the noise, also ends if a step
        /// is expected to reduce the cost by less than this share. This changed estimates by less
        /// than 0.15 standard errors (CHANGELOG.md).
        STEP_SHARE_LEAST: f64 = 1e-4, "1", Measured;
        /// A search ends if its damping (of Levenberg and Marquardt, relative to the diagonal)
        /// exceeds this: no step reduces the cost.
        STEP_DAMPING_MOST: f64 = 1e8, "1", Convention;
        /// Largest change in one step of the logarithm of a parameter that must be positive: a
        /// factor of two.
        STEP_LOGARITHM_MOST: f64 = 0.7, "1", Convention;
        /// Largest change in one step of a window's initial velocity, as a share of the fastest
        /// velocity in that window; a change to zero is always possible. If the joint soon sticks,
        /// nothing else limits that change.
        STEP_VELOCITY_MOST: f64 = 0.3, "1", Convention;
        /// Largest phase of a mode in one sample, about one and a half times that at the Nyquist
        /// frequency. No log shows a faster mode.
        MODE_TURN_MOST: f64 = 4.5, "rad", Convention;
        /// Largest rate at which an arm's state may change, times the sample time: a light motor
        /// with a heavy damped load has a rate far above its frequencies, and a simulation then
        /// needs as many more steps.
        RATE_MOST: f64 = 30.0, "1", Convention;
        /// Largest phase of a ripple in one sample at the fastest speed. At slower speeds the log
        /// can still show it.
        RIPPLE_PHASE_MOST: f64 = 16.0, "rad", Convention;
        /// Smallest phase of a ripple over the whole travel. A slower ripple is almost constant and
        /// replaces Coulomb friction: one campaign ended in this way (CHANGELOG.md).
        RIPPLE_PHASE_LEAST: f64 = 0.5, "rad", Convention;
        /// Smallest speed over which friction near standstill may change, as a share of the fastest
        /// speed: no log resolves a smaller one.
        NEAR_REST_SPEED_LEAST: f64 = 1e-3, "1", Convention;
        /// Largest lag of a tip: half of the shortest of the first windows.
        TIP_LAG_MOST: f64 = 40.0, "samples", Derived;
        /// If windows are shorter than the runs, a window whose cost per sample is this many times
        /// the usual one counts half: its simulation may stick while the log slips.
        WINDOW_COST_HALF: f64 = 10.0, "1", Convention;
        /// Largest number of searches of one stage, each with the noise that the residual of the
        /// search before shows.
        NOISE_ROUNDS_MOST: usize = 4, "searches", Convention;
        /// A stage ends if no channel's noise falls to less than this share of its value before.
        NOISE_SETTLED: f64 = 0.9, "1", Convention;
    }
    "output error: further parameters" {
        /// Damping ratio from which on a mode does not oscillate. An arm without the mode is then
        /// tried. If no tip is measured, an arm with such a mode is rejected.
        CRITICAL_DAMPING: f64 = 1.0, "1", Derived;
        /// Initial frequencies of a mode above all others, as multiples of the highest frequency;
        /// they are tried in turn.
        NEW_MODE_FREQUENCIES: [f64; 4] = [2.0, 4.0, 7.0, 14.0], "1", Convention;
        /// A mode above all others has at least this many times their frequency: two modes side by
        /// side are one, twice.
        NEW_MODE_ABOVE: f64 = 1.2, "1", Convention;
        /// Number of starts of a new mode, the likeliest first, that are searched to the end.
        NEW_MODE_STARTS: usize = 2, "starts", Convention;
        /// Initial share of the highest mode's stiffness and shape that a mode above it takes.
        NEW_MODE_SHARE: f64 = 0.25, "1", Convention;
        /// Initial damping ratio of a mode above all others. Its frequency is uncertain at first,
        /// so it must decay quickly.
        NEW_MODE_DAMPING: f64 = 0.1, "1", Convention;
        /// A mode that no tip shows must make this many oscillations in a run: a slower one stands
        /// for a load or for friction that changes.
        FIRST_MODE_OSCILLATIONS: f64 = 3.0, "1", Convention;
        /// Initial angle by which point masses at the tips rotate the new mode and the highest mode
        /// into each other; both signs are tried.
        NEW_MODE_TURN: f64 = 0.4, "rad", Convention;
        /// Frequencies at which the highest mode is tried again, as multiples of its own frequency.
        MODE_RETUNED: [f64; 8] = [0.5, 0.6, 0.72, 0.85, 1.18, 1.4, 1.7, 2.0], "1", Convention;
        /// As `MODE_RETUNED`, tried in addition if the whole search is repeated.
        MODE_RETUNED_CLOSELY: [f64; 5] = [1.0, 0.97, 1.03, 0.93, 1.07], "1", Convention;
        /// Largest number of repetitions of the whole search, if it may have ended in a wrong
        /// minimum.
        REPETITIONS_MOST: usize = 4, "searches", Convention;
    }
    "output error: noise and standard errors" {
        /// Approximate number of residuals of a channel from which its noise is estimated.
        NOISE_RESIDUALS: usize = 4000, "samples", Convention;
        /// Smallest noise of a sensor, as a share of its step. No simulation is accurate enough for
        /// less.
        NOISE_OVER_STEP_LEAST: f64 = 0.1, "1", Convention;
        /// A sensor shows its steps and no noise if its noise is at most this many times
        /// `NOISE_OVER_STEP_LEAST`. A reading that only repeats the step before is then not counted
        /// again.
        NOISE_LEAST_FACTOR: f64 = 1.1, "1", Convention;
        /// A sensor's steps are modelled as steps if they are at least this large; smaller ones act
        /// like noise.
        SENSOR_STEP_COUNTED: f64 = 0.5, "standard deviations", Convention;
        /// Number of samples of a block. Residuals within a block may be correlated; steps and
        /// noise of sensors are not correlated over longer times.
        RESIDUAL_BLOCK: f64 = 40.0, "samples", Convention;
        /// Smallest number of blocks of a run.
        RESIDUAL_BLOCKS_LEAST: f64 = 6.0, "blocks", Convention;
        /// Largest number of blocks of all runs together: each block takes the inverse of a matrix.
        RESIDUAL_BLOCKS_MOST: f64 = 400.0, "blocks", Convention;
        /// Damping of another kind is left out of the standard errors if its likelihood is less
        /// than this.
        OTHER_DAMPING_LIKELY: f64 = 1e-3, "1", Convention;
        /// Damping of another kind is included in the standard errors if it adds more than this
        /// share to some variance.
        OTHER_DAMPING_FELT: f64 = 0.1, "1", Convention;
    }
    "output error: findings" {
        /// A parameter is reported if its standard error is this many times as large because the
        /// logs do not show the kind of damping.
        OTHER_DAMPING_REPORTED: f64 = 2.0, "1", Convention;
        /// The highest mode is reported as faint if the relative standard error of its stiffness is
        /// above this. At a wrong frequency its residual would be hardly larger (3 of 1000
        /// campaigns, CHANGELOG.md), so other frequencies are tried.
        MODE_FAINT: f64 = 0.01, "1", Convention;
        /// A damping coefficient that is this far below zero is reported: such a damper adds
        /// energy, so the kind of damping is wrong.
        DAMPER_DRIVES: f64 = 5.0, "standard errors", Convention;
        /// A lag of the command is compared with half a sample only if its relative standard error
        /// is below this.
        LAG_COMPARED: f64 = 0.1, "1", Convention;
    }
}
