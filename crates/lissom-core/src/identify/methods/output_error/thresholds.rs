//! What the output-error method accepts, tries and reports, and how far it searches.
//!
//! The schedule of the damping in Levenberg-Marquardt, floors against rounding and the steps of differences are no
//! thresholds, and stay beside their use.

thresholds! {
    "output error: acceptance" {
        /// Runs are not replayed where the noise of a measured command moves the angle by this many
        /// times the noise of its sensor: it would be taken for motion.
        COMMAND_NOISE_MOST: f64 = 1.0, "1", Convention;
        /// Largest ratio of a channel's residual to its sensor's noise up to which an arm that is
        /// replayed over whole runs is accepted. An arm above it on short windows is given up
        /// there: that changed no accepted estimate of 30 study campaigns and of the measured logs
        /// (docs/src/evidence/pruned.md). Above it, ripples of all periods are tried, and a search ends by
        /// `STEP_SHARE_LEAST`.
        RESIDUAL_FAR_ABOVE_NOISE: f64 = 3.0, "1", Convention;
        /// A residual below this many times the sensor's noise is at the noise. An arm that is
        /// replayed over windows shorter than the runs is accepted only below it.
        RESIDUAL_AT_NOISE: f64 = 1.25, "1", Convention;
        /// Ratio of the residual to the sensor's noise from which terms of friction and lags of
        /// tips are tried. Below it nothing is left for them to explain.
        RESIDUAL_ABOVE_NOISE: f64 = 1.2, "1", Convention;
        /// Share of a channel's squared residual that is slower than its sensor's noise, above
        /// which the arm lacks something that moves: the search is repeated from other
        /// frequencies, and the share is reported.
        SLOW_RESIDUAL: f64 = 0.003, "1", Convention;
        /// Windows are not lengthened further once a residual is larger than on the first windows
        /// by this factor. Errors of the arm add up over a window, and noise does not.
        RESIDUAL_GROWN: f64 = 1.5, "1", Convention;
        /// Windows are too long if neighbouring motions grow apart by more than this factor. Sums
        /// of squares lose the square of it in digits, and errors of the replay's steps grow with
        /// it.
        NEIGHBOURS_GROW_APART: f64 = 100.0, "1", Convention;
        /// A parameter must lower the cost by this share at least. Errors that are not white noise
        /// may take less. It is small, because damping against the frame that is left out moves
        /// viscous friction by many standard errors.
        PARAMETER_SHARE_LEAST: f64 = 1e-4, "1", Convention;
        /// A group of parameters that lowers the cost by this share is added even if its standard
        /// errors are large: they contain the error of the arm without it. A term of friction must
        /// lower the cost by more than this.
        GROUP_SHARE_LARGE: f64 = 0.02, "1", Convention;
        /// Largest share of the squared residual beyond the noise that further parameters may leave
        /// where the residual is above the noise. Without it, terms of friction were added on two small
        /// logs of joints that have none (docs/src/evidence/pruned.md).
        EXCESS_LEFT: f64 = 0.7, "1", Measured;
        /// Most groups of parameters that are added at one length of the windows.
        GROUPS_ADDED_MOST: usize = 3, "groups", Convention;
    }
    "output error: starting arms" {
        /// Smallest stiffness of a starting mode, as a share of the coupling: the search changes
        /// its logarithm, so it must be positive.
        START_STIFFNESS_LEAST: f64 = 0.02, "1", Convention;
        /// A pole is no starting mode if it is outside the frequencies of the responses by more
        /// than this factor: it describes their ends.
        START_POLE_OUTSIDE: f64 = 3.0, "1", Convention;
        /// A mode is left out of a starting arm if its share in every tip's motion is smaller:
        /// noise makes such modes.
        START_SHAPE_LEAST: f64 = 0.05, "1", Convention;
        /// Starting arms whose cost after a short search exceeds the best one's by more than this
        /// factor are tried last.
        START_COST_FAR: f64 = 3.0, "1", Convention;
        /// Two starting arms are the same if their modes' frequencies and stiffnesses agree to this
        /// share. Only one of them is tried.
        STARTS_ALIKE: f64 = 0.05, "1", Convention;
    }
    "output error: windows" {
        /// A window begins where the motor's speed is at least this share of its rms value, so that
        /// the sign of the velocity is certain.
        WINDOW_START_SPEED: f64 = 0.1, "1", Convention;
        /// Shortest window.
        WINDOW_SAMPLES_LEAST: usize = 20, "samples", Convention;
        /// Shortest of the first windows.
        FIRST_WINDOW_SAMPLES: f64 = 80.0, "samples", Convention;
        /// Shortest of the first windows, in periods of the slowest mode.
        FIRST_WINDOW_PERIODS: f64 = 0.3, "periods", Convention;
        /// Each stage's windows are longer than the ones before by this factor.
        WINDOW_WIDENING: f64 = 4.0, "1", Convention;
        /// As `WINDOW_WIDENING`, after a search that ended in a wrong minimum.
        WINDOW_WIDENING_SLOW: f64 = 1.6, "1", Convention;
    }
    "output error: search" {
        /// Most steps of a search at one length of the windows, where others follow.
        STAGE_STEPS_MOST: usize = 12, "steps", Convention;
        /// Samples that are replayed, about, where longer windows follow.
        STAGE_SAMPLES: usize = 40_000, "samples", Convention;
        /// Most steps of a search that no other follows.
        LAST_STEPS_MOST: usize = 40, "steps", Convention;
        /// Steps of a short search that compares starting points.
        PROBE_STEPS: usize = 8, "steps", Convention;
        /// Samples that a short search replays, about.
        PROBE_SAMPLES: usize = 15_000, "samples", Convention;
        /// The last search ends if a step is expected to lower the cost, a sum of squares in
        /// standard deviations of the noise, by less than this. A parameter would then move by a
        /// seventh of its standard error.
        LAST_STEP_FALL: f64 = 0.02, "1", Convention;
        /// As `LAST_STEP_FALL`, of searches that others follow: a parameter would move by one
        /// standard error. On the demo's campaign this took 8 to 15 % less time and gave the same
        /// estimates (CHANGELOG.md).
        STAGE_STEP_FALL: f64 = 1.0, "1", Measured;
        /// Where others follow, and where the residual is far above the noise, a search also ends
        /// if a step is expected to lower the cost by less than this share. It moved estimates by
        /// less than 0.15 standard errors (CHANGELOG.md).
        STEP_SHARE_LEAST: f64 = 1e-4, "1", Measured;
        /// A search ends if its damping (of Levenberg and Marquardt, relative to the diagonal)
        /// exceeds this: no step lowers the cost.
        STEP_DAMPING_MOST: f64 = 1e8, "1", Convention;
        /// Largest change in one step of the logarithm of a parameter that is positive by nature: a
        /// factor of two.
        STEP_LOGARITHM_MOST: f64 = 0.7, "1", Convention;
        /// Largest change in one step of a window's first velocity, as a share of the fastest in
        /// that window; it may always change to zero. Where the joint soon sticks, nothing else
        /// limits that change.
        STEP_VELOCITY_MOST: f64 = 0.3, "1", Convention;
        /// Largest angle by which a mode may turn in a sample, about half as much again as the
        /// Nyquist frequency allows. A faster mode is in no log.
        MODE_TURN_MOST: f64 = 4.5, "rad", Convention;
        /// Largest rate at which an arm's state may change, times the sample time: a light motor before a
        /// heavy damped load has one far above its frequencies, and a replay takes as many more steps.
        RATE_MOST: f64 = 30.0, "1", Convention;
        /// Largest phase by which a ripple may pass in a sample at the fastest speed. At slower
        /// speeds it can still be seen.
        RIPPLE_PHASE_MOST: f64 = 16.0, "rad", Convention;
        /// Smallest phase of a ripple over the whole travel. A slower one is nearly constant, and
        /// replaces Coulomb friction: one campaign ended so (CHANGELOG.md).
        RIPPLE_PHASE_LEAST: f64 = 0.5, "rad", Convention;
        /// Smallest speed over which friction near standstill may change, as a share of the
        /// fastest: no log resolves a smaller one.
        NEAR_REST_SPEED_LEAST: f64 = 1e-3, "1", Convention;
        /// Largest lag of a tip: half of the shortest of the first windows.
        TIP_LAG_MOST: f64 = 40.0, "samples", Derived;
        /// A window whose cost per sample is this many times the usual one counts half, where
        /// windows are shorter than the runs: its replay may stick where the log slips.
        WINDOW_COST_HALF: f64 = 10.0, "1", Convention;
        /// Most searches of one stage, each with the noise that the residual before it shows.
        NOISE_ROUNDS_MOST: usize = 4, "searches", Convention;
        /// A stage ends if no channel's noise falls to less than this share of what it was.
        NOISE_SETTLED: f64 = 0.9, "1", Convention;
    }
    "output error: further parameters" {
        /// Damping ratio from which a mode does not oscillate. An arm without it is then tried.
        CRITICAL_DAMPING: f64 = 1.0, "1", Derived;
        /// Frequencies at which a mode above all others begins, as multiples of the highest; they
        /// are tried in turn.
        NEW_MODE_FREQUENCIES: [f64; 2] = [2.0, 4.0], "1", Convention;
        /// Share of the highest mode's stiffness and shape that a mode above it takes at first.
        NEW_MODE_SHARE: f64 = 0.25, "1", Convention;
        /// Damping ratio with which a mode above all others begins. Its frequency is hardly known
        /// then, so it must not ring for long.
        NEW_MODE_DAMPING: f64 = 0.1, "1", Convention;
        /// Shares of a rigid axis' inertia that its first mode takes at first; they are tried in turn.
        FIRST_MODE_SHARES: [f64; 2] = [0.3, 0.7], "1", Convention;
        /// Smallest inertia behind the spring of the first mode of a rigid axis, as a share of that before
        /// it: less takes a part of any error of the arm.
        FIRST_MODE_INERTIA_LEAST: f64 = 0.02, "1", Convention;
        /// Most searches for the first mode of a rigid axis, each of `STAGE_STEPS_MOST`.
        FIRST_MODE_SEARCHES: usize = 4, "searches", Convention;
        /// Ratio of the frequencies at which the first mode of a rigid axis begins.
        FIRST_MODE_STEP: f64 = 1.6, "1", Convention;
        /// How often a first mode of a rigid axis is tried, over windows of other lengths.
        FIRST_MODE_TRIES: usize = 2, "1", Convention;
        /// Largest angle by which the first mode of a rigid axis turns in a sample at first.
        FIRST_MODE_TURN_MOST: f64 = 1.5, "rad", Convention;
        /// Largest share of the squared residual beyond the noise that the first mode of a rigid axis
        /// may leave: friction that wanders leaves more.
        FIRST_MODE_EXCESS_LEFT: f64 = 0.3, "1", Convention;
        /// Angle by which point masses at the tips turn the new mode and the highest into each
        /// other, at first; both signs are tried.
        NEW_MODE_TURN: f64 = 0.4, "rad", Convention;
        /// Frequencies at which the highest mode is tried again, as multiples of its own.
        MODE_RETUNED: [f64; 8] = [0.5, 0.6, 0.72, 0.85, 1.18, 1.4, 1.7, 2.0], "1", Convention;
        /// As `MODE_RETUNED`, tried in addition where the whole search is repeated.
        MODE_RETUNED_CLOSELY: [f64; 5] = [1.0, 0.97, 1.03, 0.93, 1.07], "1", Convention;
        /// Most repetitions of the whole search, where it may have ended in a wrong minimum.
        REPETITIONS_MOST: usize = 4, "searches", Convention;
        /// Speeds over which friction near standstill is tried to change, as shares of the fastest.
        NEAR_REST_SPEEDS: [f64; 4] = [0.02, 0.06, 0.2, 0.6], "1", Convention;
        /// Most ripples of the friction.
        RIPPLES_MOST: usize = 2, "ripples", Convention;
        /// Periods at which ripples are tried: two half waves over the travel, three, and so on.
        RIPPLE_PERIODS: usize = 46, "periods", Convention;
    }
    "output error: noise and standard errors" {
        /// Residuals of a channel, about, from which its noise is estimated.
        NOISE_RESIDUALS: usize = 4000, "samples", Convention;
        /// Smallest noise of a sensor, as a share of its step. No replay is exact enough for less.
        NOISE_OVER_STEP_LEAST: f64 = 0.1, "1", Convention;
        /// A sensor shows its steps and no noise if its noise is at most this many times
        /// `NOISE_OVER_STEP_LEAST`. A reading that only repeats the step before then counts once.
        NOISE_LEAST_FACTOR: f64 = 1.1, "1", Convention;
        /// A sensor's steps are counted as steps if they are at least this large; smaller ones act
        /// like noise.
        SENSOR_STEP_COUNTED: f64 = 0.5, "standard deviations", Convention;
        /// Samples of a block. Residuals within a block may be correlated; steps and noise of
        /// sensors are not over longer times.
        RESIDUAL_BLOCK: f64 = 40.0, "samples", Convention;
        /// Fewest blocks of a run.
        RESIDUAL_BLOCKS_LEAST: f64 = 6.0, "blocks", Convention;
        /// Most blocks of all runs together: each costs the inverse of a matrix.
        RESIDUAL_BLOCKS_MOST: f64 = 400.0, "blocks", Convention;
        /// Damping of another kind does not count in the standard errors if it is less likely than
        /// this.
        OTHER_DAMPING_LIKELY: f64 = 1e-3, "1", Convention;
        /// Damping of another kind counts in the standard errors if it adds more than this share to
        /// some variance.
        OTHER_DAMPING_FELT: f64 = 0.1, "1", Convention;
    }
    "output error: findings" {
        /// A parameter is reported if its standard error is this many times as large because the
        /// logs do not show the kind of damping.
        OTHER_DAMPING_REPORTED: f64 = 2.0, "1", Convention;
        /// The highest mode is faint, which is reported, if the relative standard error of its
        /// stiffness is above this. At a wrong frequency it would leave hardly more (3 of 1000
        /// campaigns, CHANGELOG.md), so other frequencies are tried.
        MODE_FAINT: f64 = 0.01, "1", Convention;
        /// A damping coefficient that is this far below zero is reported: it gains energy, so the
        /// kind of damping is wrong.
        DAMPER_DRIVES: f64 = 5.0, "standard errors", Convention;
        /// A lag of the command is compared with half a sample only if its relative standard error
        /// is below this.
        LAG_COMPARED: f64 = 0.1, "1", Convention;
    }
}
