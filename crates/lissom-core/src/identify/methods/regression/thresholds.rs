//! Regression in slip phases: acceptance, choice of the window, and findings.

thresholds! {
    "regression" {
        /// A window is too short if its velocities are smoothed over less than this share of the
        /// time that a certain sign needs (`TRAVEL_OVER_NOISE`).
        SURE_SIGN: f64 = 0.4, "1", Convention;
        /// Two parameters cannot be separated if an eigenvalue of the scaled normal matrix is below
        /// this share of the largest: their regressors are then equal to 1e-5.
        SAME_COLUMN: f64 = 1e-10, "1", Convention;
        /// A parameter is refused as not separable if it has more than this weight in a direction
        /// that the data do not show.
        INSEPARABLE_WEIGHT: f64 = 0.2, "1", Convention;
        /// A sum of parameters is given even if one of them is not, if changes that the data do not
        /// show change the sum by less than this share of its parts.
        TELLS_SUM: f64 = 1e-6, "1", Convention;
        /// The noise of the sensors is subtracted from a direction of the regressors if it is less
        /// than this share of the direction's square. Above it too little motion remains: the noise
        /// is not subtracted, and the standard error includes its effect.
        NOISE_FILLS: f64 = 0.6, "1", Convention;
        /// Smallest share of a direction's square that is taken as motion, so that its standard
        /// error stays finite.
        MOTION_LEAST: f64 = 0.05, "1", Convention;
        /// If nobody states whether a command is held, it is taken as held only if it then acts
        /// later by no more than this share of a sample: a longer delay has another cause.
        HELD_DELAY_MOST: f64 = 0.4, "samples", Convention;
        /// If nothing shows whether a command is held, the estimates are reported that this changes
        /// by more than `PRESENT` standard errors and this share.
        HOLD_MATTERS: f64 = 0.01, "1", Convention;
        /// The residual of the equation is noise of the sensors if this noise explains more than
        /// this share of its square.
        LEFT_BY_NOISE: f64 = 0.5, "1", Convention;
        /// Friction, or a load, changes from one slip phase to the next if a constant for each slip
        /// phase explains more than this share of the squared residual beyond noise.
        LEFT_BETWEEN_PHASES: f64 = 0.15, "1", Convention;
        /// As `LEFT_BETWEEN_PHASES`: in addition the squares of these constants must be this many
        /// times those that noise would give.
        BETWEEN_OVER_NOISE: f64 = 5.0, "1", Convention;
        /// As `LEFT_BETWEEN_PHASES`: in addition the root mean square of these constants must be
        /// this share of Coulomb friction.
        VARIATION_REPORTED: f64 = 0.005, "1", Convention;
        /// Gravity is separated from inertia and from a constant load if it is known to this share
        /// of m·g·l.
        GRAVITY_KNOWN: f64 = 0.02, "1", Convention;
        /// If gravity is not known that well (`GRAVITY_KNOWN`), it is reported with each term with
        /// which its correlation is larger than this.
        GRAVITY_CORRELATION: f64 = 0.9, "1", Convention;
        /// Largest share of the runs that is left out as unlike the others.
        UNLIKE_RUNS_MOST: f64 = 0.2, "1", Convention;
        /// A run is unlike the others if the torque from the parameters of the others differs from
        /// that from its own by more than this share: friction varies by a few percent from run to
        /// run.
        UNLIKE_MISFIT: f64 = 0.05, "1", Convention;
        /// A run is unlike the others only if this difference is this many times the median of the
        /// other runs.
        UNLIKE_USUAL: f64 = 3.0, "1", Convention;
        /// A run is unlike the others only if this difference is this many times the second
        /// largest.
        UNLIKE_NEXT: f64 = 1.5, "1", Convention;
        /// A run is also unlike the others if its residual with their parameters, relative to their
        /// own residual, is this many times the second largest of these ratios.
        UNLIKE_SPOILS: f64 = 30.0, "1", Convention;
        /// As `UNLIKE_NEXT`, for the fastest and the slowest run: if friction is not a straight
        /// line over speed, these runs differ from the others because of the friction law.
        UNLIKE_NEXT_OF_FASTEST: f64 = 5.0, "1", Convention;
        /// One change explains a run that is unlike the others if its residual with this change is
        /// less than this share of that without it, or less than twice the others' own residual.
        DIFFERENCE_EXPLAINS: f64 = 0.35, "1", Convention;
        /// A scale or an inertia that differs by more than this factor is not an effect of the
        /// friction law.
        GROSS_FACTOR: f64 = 1.5, "1", Convention;
        /// A command has the wrong sign if the scale that describes a run differs from −1 by less
        /// than this.
        REVERSED_SCALE: f64 = 0.3, "1", Convention;
        /// A mode that no tip shows is a candidate if its frequency is this many standard errors
        /// from zero.
        HIDDEN_MODE_SURE: f64 = 20.0, "standard errors", Convention;
        /// At least this share of the inertia must be on each side of the spring; otherwise the
        /// share counts as not identified.
        HIDDEN_MODE_SHARE: f64 = 0.02, "1", Convention;
        /// A damping ratio above this, or with a standard error above this, counts as not
        /// identified.
        HIDDEN_MODE_DAMPED: f64 = 0.3, "1", Convention;
        /// A warning reports an inertia that would be larger by more than this share if the
        /// residual torque accelerated the motor.
        INERTIA_SHORT: f64 = 0.05, "1", Convention;
        /// A warning reports a torque constant that differs by more than this share from the one
        /// that the load's known m·g·l gives: data sheets are not more accurate.
        CONSTANT_DOUBTED: f64 = 0.05, "1", Convention;
        /// If there are fewer slip phases than this, each is cut into blocks. The scatter of blocks
        /// is smaller than that between slip phases, and a finding reports this.
        FEW_PHASES: usize = 8, "slip phases", Convention;
        /// Variation of friction from one slip phase to the next, as a share of Coulomb friction,
        /// that standard errors include if there are too few slip phases to show it: friction of
        /// joints varies by a few percent.
        USUAL_VARIATION: f64 = 0.03, "1", Convention;
        /// Number of blocks into which few slip phases are cut.
        BLOCKS_WANTED: usize = 16, "blocks", Convention;
        /// Up to this many slip phases, or blocks of them, the covariance includes a correction for
        /// the influence of each one on the estimates; with more the correction is small.
        FEW_CLUSTERS: usize = 40, "slip phases or blocks", Convention;
        /// A window length is used only if it gives this many slip phases (or blocks of a beam's
        /// equation): the covariance is computed from their scatter.
        CLUSTERS_LEAST: usize = 4, "slip phases or blocks", Convention;
        /// No shorter window is tried if the scatter of the estimates is this many times the
        /// smallest sensitivity so far: shorter windows scatter more and take the most time.
        WINDOW_HOPELESS: f64 = 1.5, "1", Convention;
        /// No shorter window is tried if the sensitivity to the window length is this many times
        /// the smallest so far.
        WINDOW_FAR_WORSE: f64 = 4.0, "1", Convention;
        /// Share of an estimate's change from the next shorter to the next longer window that
        /// counts as a systematic error: half of it is the change to one neighbour.
        WINDOW_SYSTEMATIC: f64 = 0.5, "1", Derived;
    }
}
