//! Regression in slip phases: what is accepted, which window is chosen, what is reported.

thresholds! {
    "regression" {
        /// A velocity against its slip phase by this many standard deviations is a reversal, and is
        /// cut out: noise alone gives none in many thousands of samples.
        SURELY_REVERSED: f64 = 5.0, "standard deviations", Derived;
        /// The motor rests where it is slower than this share of its largest velocity: an angle that
        /// drifts while friction holds does not slip.
        REST_SPEED: f64 = 1e-5, "1", Convention;
        /// A window is too short if its velocities are smoothed over less than this share of what a
        /// certain sign needs (`TRAVEL_OVER_NOISE`).
        SURE_SIGN: f64 = 0.4, "1", Convention;
        /// Two parameters are inseparable if an eigenvalue of the scaled normal matrix is below
        /// this share of the largest: their regressors are then the same to 1e-5.
        SAME_COLUMN: f64 = 1e-10, "1", Convention;
        /// A parameter is refused as inseparable if it has more than this weight in a direction
        /// that the data do not show.
        INSEPARABLE_WEIGHT: f64 = 0.2, "1", Convention;
        /// A sum of parameters is told although one of them is not, if a change that the data do not
        /// show moves it by less than this share of its parts.
        TELLS_SUM: f64 = 1e-6, "1", Convention;
        /// Noise is taken out of a direction of the regressors up to this share of its square.
        /// Above it too little motion is left, and the standard error counts the direction instead.
        NOISE_FILLS: f64 = 0.6, "1", Convention;
        /// Share of a direction's square that is taken as motion at least, so that its standard
        /// error stays finite.
        MOTION_LEAST: f64 = 0.05, "1", Convention;
        /// An equation that leaves less than this share of the torque lacks no term, unless one that explains
        /// most of it moves an estimate by `MISSING_MOVES`.
        NOTHING_MISSING: f64 = 5e-5, "1", Convention;
        /// Share of an estimate by which a term moves it that matters however little of the torque is left.
        MISSING_MOVES: f64 = 1e-3, "1", Convention;
        /// A missing term that hardly lowers the residual is reported if its regressor is exact, or it is a delay, it
        /// is this many standard errors from zero, and it moves an estimate by `PRESENT`.
        MISSING_SURE: f64 = 10.0, "standard errors", Convention;
        /// Gravity is tried as a missing term where the motor turns by more than this: over less its
        /// sine is a line, as that of a spring.
        GRAVITY_TRAVEL_RAD: f64 = 1.0, "rad", Convention;
        /// Where the chosen windows show no missing term, windows so many times longer are looked at:
        /// the sensors' noise fills less of their residual.
        LONGER_WINDOW: f64 = 4.0, "1", Convention;
        /// An angle lags behind the command if with the lag less than this share of the residual is
        /// left: the estimates are then those with it.
        LAG_EXPLAINS: f64 = 1.0 / 3.0, "1", Convention;
        /// A lag of the angle is a filter or a delay where the one leaves less than this share of what
        /// the other does.
        LAG_SHAPE_TOLD: f64 = 0.8, "1", Convention;
        /// What the equation leaves is noise of the sensors if these explain more than this share of its
        /// square.
        LEFT_BY_NOISE: f64 = 0.5, "1", Convention;
        /// Above this share of noise the equation lacks no term whose column may take a part of it.
        NOISE_ALONE: f64 = 0.8, "1", Convention;
        /// Friction, or a load, changes from one slip phase to the next if more than this share of what
        /// the equation leaves, beyond noise, is a constant for each.
        LEFT_BETWEEN_PHASES: f64 = 0.15, "1", Convention;
        /// The same only if the squares of these constants are so many times those that noise makes.
        BETWEEN_OVER_NOISE: f64 = 5.0, "1", Convention;
        /// The same only if their root mean square is this share of Coulomb friction.
        VARIATION_REPORTED: f64 = 0.005, "1", Convention;
        /// The lag is looked for in the first runs, of about so many samples.
        LAG_SAMPLES_MOST: usize = 50_000, "samples", Convention;
        /// Gravity is told from inertia and a constant load if its part is known to this share of
        /// m·g·l.
        GRAVITY_KNOWN: f64 = 0.02, "1", Convention;
        /// Gravity that is not known so well is reported with the term that it correlates with by
        /// more than this.
        GRAVITY_CORRELATION: f64 = 0.9, "1", Convention;
        /// Most runs that are left out as unlike the others, as a share of all.
        UNLIKE_RUNS_MOST: f64 = 0.2, "1", Convention;
        /// A run is unlike the others if by their parameters and by its own its torque differs by more
        /// than this share: friction wanders by a few per cent from run to run.
        UNLIKE_MISFIT: f64 = 0.05, "1", Convention;
        /// A run is unlike the others only if that share is so many times the usual one of a run.
        UNLIKE_USUAL: f64 = 3.0, "1", Convention;
        /// A run is unlike the others only if that share is so many times the next.
        UNLIKE_NEXT: f64 = 1.5, "1", Convention;
        /// A run is unlike the others, too, if they leave so many times as much of its torque, beside
        /// what they leave of theirs, as of the next.
        UNLIKE_SPOILS: f64 = 30.0, "1", Convention;
        /// As `UNLIKE_NEXT`, of the fastest and of the slowest run: where friction is no straight line they
        /// differ from the others by its law.
        UNLIKE_NEXT_OF_FASTEST: f64 = 5.0, "1", Convention;
        /// Before that the parameters may move towards the run by about so many of their standard
        /// errors: a run that shows a parameter alone is not unlike the others.
        UNLIKE_WITHIN: f64 = 3.0, "standard errors", Convention;
        /// One change describes a run that is unlike the others if it leaves less than this share of
        /// what they leave of it, or twice what they leave of themselves.
        DIFFERENCE_EXPLAINS: f64 = 0.35, "1", Convention;
        /// A scale or an inertia that differs by more than this factor is no effect of friction's law.
        GROSS_FACTOR: f64 = 1.5, "1", Convention;
        /// A command is reversed if the scale that describes a run is within this of −1.
        REVERSED_SCALE: f64 = 0.3, "1", Convention;
        /// The magnitude of the command is not tried as a missing term if it correlates with the
        /// torque by this much: with torque of one sign it is the torque itself.
        MISSING_ONE_SIGN: f64 = 0.5, "1", Convention;
        /// A mode that no tip shows is counted if with it less than this share of the residual is left.
        HIDDEN_MODE_LEAVES: f64 = 0.7, "1", Convention;
        /// The same only if that is less than this share of what any single further term leaves.
        HIDDEN_MODE_BEATS: f64 = 0.8, "1", Convention;
        /// The same only if its frequency is so many standard errors from zero.
        HIDDEN_MODE_SURE: f64 = 20.0, "standard errors", Convention;
        /// The same only if windows of a neighbour length show it, too, at a frequency that differs by less
        /// than this share.
        HIDDEN_MODE_MOVES: f64 = 0.1, "1", Convention;
        /// Less of the inertia than this share is not before its spring, nor behind it.
        HIDDEN_MODE_SHARE: f64 = 0.02, "1", Convention;
        /// A damping ratio below minus this is no mode's: it would gain energy.
        HIDDEN_MODE_GAINS: f64 = 0.1, "1", Convention;
        /// A damping ratio above this, or one that is not known to this, is not taken as the mode's.
        HIDDEN_MODE_DAMPED: f64 = 0.3, "1", Convention;
        /// Coupling to the tips is hardly known if its relative standard error is above this.
        COUPLING_HARDLY_KNOWN: f64 = 0.5, "1", Convention;
        /// The equation without the coupling is taken then if it leaves less than this many times as much of
        /// the torque.
        RIGID_LEAVES: f64 = 1.15, "1", Convention;
        /// Inertia is doubted that would be larger by more than this share if the torque left
        /// accelerated the motor.
        INERTIA_SHORT: f64 = 0.05, "1", Convention;
        /// A torque constant is doubted that differs by more than this share from the one that the load's known m·g·l
        /// gives: data sheets are no better.
        CONSTANT_DOUBTED: f64 = 0.05, "1", Convention;
        /// With fewer slip phases than this each is cut into blocks, whose scatter is smaller than
        /// that from phase to phase: a finding says so.
        FEW_PHASES: usize = 8, "slip phases", Convention;
        /// Variation of friction from one slip phase to the next, as a share of Coulomb friction, that
        /// standard errors count where slip phases are too few to show it: friction of joints wanders by
        /// a few percent.
        USUAL_VARIATION: f64 = 0.03, "1", Convention;
        /// Blocks that few slip phases are cut into.
        BLOCKS_WANTED: usize = 16, "blocks", Convention;
        /// With up to so many slip phases, or blocks of them, the covariance counts that the estimates
        /// follow each of them; with more that is little.
        FEW_CLUSTERS: usize = 40, "slip phases or blocks", Convention;
        /// A window length is used only if this many slip phases (or blocks of a beam's equation)
        /// are left: the covariance rests on their scatter.
        CLUSTERS_LEAST: usize = 4, "slip phases or blocks", Convention;
        /// No shorter window is tried if the scatter of the estimates is this many times the least
        /// sensitivity so far: shorter ones scatter more, and cost most.
        WINDOW_HOPELESS: f64 = 1.5, "1", Convention;
        /// No shorter window is tried if the sensitivity to the length is this many times the least
        /// so far.
        WINDOW_FAR_WORSE: f64 = 4.0, "1", Convention;
        /// Share of an estimate's change from the next shorter to the next longer window that
        /// counts as systematic error: half of it is the change to one neighbour.
        WINDOW_SYSTEMATIC: f64 = 0.5, "1", Derived;
    }
}
