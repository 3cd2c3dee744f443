//! The methods that are one file each.

thresholds! {
    "least squares" {
        /// Samples slower than this share of the largest speed are left out, because friction near
        /// standstill has another law. Published fits of Coulomb and viscous friction use the same.
        SLOWEST_SAMPLE: f64 = 0.05, "1", Convention;
        /// The motor stands where it is slower than this share of its largest speed for longer than
        /// its velocity is smoothed over: friction there is whatever holds.
        STANDING_SHARE: f64 = 1e-3, "1", Convention;
    }
    "third harmonic" {
        /// Share by which Coulomb friction comes out low, for each unit of the sticking share of
        /// the cycle. With 4 % and 8 % it was 2.3 % and 4.9 % low on the simulated arm of the 1989
        /// report (docs/src/decisions/09-third-harmonic.md).
        STICKING_BIAS: f64 = 0.6, "1", Measured;
        /// Sticking shares of the cycle below this cannot be measured with a sensor of 12 bits; the
        /// standard error counts this share at least.
        STICKING_MEASURED: f64 = 0.01, "1", Convention;
    }
}
