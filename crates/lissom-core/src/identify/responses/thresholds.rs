//! Frequency responses, bands and rational models.

thresholds! {
    "responses" {
        /// Relative error of a response that is counted at least, in the fits of models: held
        /// commands, quantised angles and windows leave errors that no standard error shows.
        RESPONSE_FLOOR: f64 = 2e-3, "1", Convention;
        /// Coherence below which a band of a broadband run is not shown.
        BAND_COHERENCE: f64 = 0.3, "1", Convention;
        /// Power of the input, relative to the strongest band, below which a band is not shown.
        BAND_POWER: f64 = 1e-3, "1", Convention;
        /// Runs shorter than this share of the longest are left out of the bands.
        SHORT_RUN: f64 = 0.25, "1", Convention;
        /// Short runs are left out only if the others have this share of the time of all.
        LONG_RUNS: f64 = 0.5, "1", Convention;
        /// A band stands for a frequency if it is this near to it: bands are 4 % apart (60 a
        /// decade).
        NEAREST_BAND: f64 = 0.03, "1", Convention;
        /// A band is flagged if it differs by more than this share from what the regression's
        /// estimates give.
        BAND_CONTRADICTED: f64 = 0.1, "1", Convention;
        /// A band is flagged if its relative standard error is above this.
        BAND_UNCERTAIN: f64 = 0.02, "1", Convention;
        /// A corrected point of a sine is flagged, and left out of the motor's model, if its
        /// relative standard error is above this.
        POINT_UNCERTAIN: f64 = 0.5, "1", Convention;
        /// A corrected point is vouched for (`vouched_for` in the result) if half its 95 % interval
        /// is within this share of it, and no finding speaks against it.
        POINT_VOUCHED_FOR: f64 = 0.05, "1", Convention;
        /// Sticking share of the cycle that counts at least in the error of a corrected point:
        /// smaller ones are not measured, and equation (30) of the 1989 report leaves as much where
        /// nothing sticks.
        STUCK_LEAST: f64 = 0.015, "1", Convention;
        /// Periods that the correction by the friction waveform needs at least.
        WAVEFORM_PERIODS: usize = 3, "periods", Convention;
        /// A regression's estimates make a model of the response if they leave less than this share
        /// of the torque (of a tip: the acceleration).
        MODEL_EXPLAINED: f64 = 0.05, "1", Convention;
    }
    "rational models" {
        /// Most modes of the beam's model.
        MODES_MOST: usize = 4, "modes", Convention;
        /// The search for more poles of the beam ends if one is damped less than this: no pole of a
        /// beam is unstable, but noise may make it look so.
        POLE_DAMPING_LEAST: f64 = -0.01, "1", Convention;
        /// The search for more poles of the beam ends if one is damped as much as this.
        POLE_DAMPING_MOST: f64 = 0.5, "1", Convention;
        /// The search for more poles of the beam ends if one lies below this times the lowest
        /// frequency: it describes the ends of the responses, not a mode.
        POLE_BELOW: f64 = 0.3, "1", Convention;
        /// The search for more poles of the beam ends if one lies above this times the highest
        /// frequency: it describes the ends of the responses, not a mode.
        POLE_ABOVE: f64 = 3.0, "1", Convention;
        /// A pole with a larger damping ratio describes the ends of the frequencies and is not
        /// called a mode.
        MODE_DAMPING_MOST: f64 = 0.25, "1", Convention;
        /// A delay, or a term in s of the damping, must lower the information criterion by this:
        /// about what an unknown at `CLEARLY_PRESENT` gains beyond its cost.
        CRITERION_CALLED_FOR: f64 = 8.0, "1", Derived;
        /// A delay of the motor's response must lower the information criterion by this.
        MOTOR_DELAY_CALLED_FOR: f64 = 4.0, "1", Convention;
        /// More pole pairs are looked for until this many in a row do not pay for themselves: one
        /// alone may need the next.
        POLES_IN_VAIN: usize = 2, "poles", Convention;
        /// Weighted residual (rms) above which vector fitting may have found the wrong poles, so
        /// that poles are also looked for one after another.
        POOR_FIT: f64 = 1.5, "standard errors", Convention;
    }
}
