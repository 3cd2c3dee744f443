//! Frequency responses, bands and rational models.

thresholds! {
    "responses" {
        /// Smallest relative error of a response in the fits of models: held commands, quantised
        /// angles and windows cause errors that no standard error shows.
        RESPONSE_FLOOR: f64 = 2e-3, "1", Convention;
        /// A band of a broadband run is left out if its coherence is below this.
        BAND_COHERENCE: f64 = 0.3, "1", Convention;
        /// A band is left out if the power of the input, relative to the strongest band, is below
        /// this.
        BAND_POWER: f64 = 1e-3, "1", Convention;
        /// Runs shorter than this share of the longest run are left out of the bands.
        SHORT_RUN: f64 = 0.25, "1", Convention;
        /// Short runs are left out only if the other runs have this share of the time of all runs.
        LONG_RUNS: f64 = 0.5, "1", Convention;
        /// A band represents a frequency if it differs from it by less than this share: bands are 4
        /// % apart (60 per decade).
        NEAREST_BAND: f64 = 0.03, "1", Convention;
        /// A band is flagged if it differs by more than this share from the model with the
        /// regression's estimates.
        BAND_CONTRADICTED: f64 = 0.1, "1", Convention;
        /// A band is flagged if its relative standard error is above this.
        BAND_UNCERTAIN: f64 = 0.02, "1", Convention;
        /// A corrected point of a sine is flagged, and left out of the motor's model, if its
        /// relative standard error is above this.
        POINT_UNCERTAIN: f64 = 0.5, "1", Convention;
        /// A corrected point is marked `vouched_for` in the result if half its 95 % interval is
        /// within this share of it, no finding speaks against it, and the output-error method gave
        /// the waveform of friction.
        POINT_VOUCHED_FOR: f64 = 0.05, "1", Convention;
        /// Smallest share of the cycle with sticking that is included in the error of a corrected
        /// point: a smaller share cannot be measured, and equation (30) of the 1989 report has an
        /// error of this size even if nothing sticks.
        STUCK_LEAST: f64 = 0.015, "1", Convention;
        /// Fewest periods for the correction by the friction waveform.
        WAVEFORM_PERIODS: usize = 3, "periods", Convention;
        /// The estimates of a regression are used as a model of the response if the residual is
        /// less than this share of the torque (for a tip: of the acceleration).
        MODEL_EXPLAINED: f64 = 0.05, "1", Convention;
    }
    "rational models" {
        /// Largest number of modes of the beam's model.
        MODES_MOST: usize = 4, "modes", Convention;
        /// The search for more poles of the beam ends if a pole has a damping ratio below this: no
        /// pole of a beam is unstable, but noise may make it look so.
        POLE_DAMPING_LEAST: f64 = -0.01, "1", Convention;
        /// The search for more poles of the beam ends if a pole has a damping ratio of this or
        /// more.
        POLE_DAMPING_MOST: f64 = 0.5, "1", Convention;
        /// The search for more poles of the beam ends if a pole is below this multiple of the
        /// lowest frequency: it describes the ends of the responses, not a mode.
        POLE_BELOW: f64 = 0.3, "1", Convention;
        /// The search for more poles of the beam ends if a pole is above this multiple of the
        /// highest frequency: it describes the ends of the responses, not a mode.
        POLE_ABOVE: f64 = 3.0, "1", Convention;
        /// A pole with a larger damping ratio than this describes the ends of the responses and is
        /// not a mode.
        MODE_DAMPING_MOST: f64 = 0.25, "1", Convention;
        /// A delay, or a term in s of the damping, is added if it reduces the information criterion
        /// by this: about the gain of an unknown at `CLEARLY_PRESENT`, less its cost.
        CRITERION_CALLED_FOR: f64 = 8.0, "1", Derived;
        /// A delay of the motor's response is added if it reduces the information criterion by
        /// this.
        MOTOR_DELAY_CALLED_FOR: f64 = 4.0, "1", Convention;
        /// More pole pairs are tried until this many in a row bring no improvement: one pair may
        /// improve the fit only together with the next.
        POLES_IN_VAIN: usize = 2, "poles", Convention;
        /// Weighted residual (rms) above which vector fitting may have found wrong poles, so that
        /// poles are also searched one after another.
        POOR_FIT: f64 = 1.5, "standard errors", Convention;
    }
}
