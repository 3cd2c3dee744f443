//! Thresholds of the methods that consist of one file each.

thresholds! {
    "least squares" {
        /// Samples slower than this share of the largest speed are left out, because friction near
        /// standstill follows another law. Published fits of Coulomb and viscous friction use the
        /// same share.
        SLOWEST_SAMPLE: f64 = 0.05, "1", Convention;
        /// The motor stands still if it is slower than this share of its largest speed for longer
        /// than the smoothing time of its velocity. Friction then has any value up to static
        /// friction.
        STANDING_SHARE: f64 = 1e-3, "1", Convention;
    }
    "third harmonic" {
        /// Share by which Coulomb friction is too low, per share of the cycle in which the joint
        /// sticks. On the simulated arm of the 1989 report it was 2.3 % and 4.9 % too low with 4 %
        /// and 8 % (docs/src/decisions/09-third-harmonic.md).
        STICKING_BIAS: f64 = 0.6, "1", Measured;
        /// Smallest share of the cycle with sticking that a 12-bit sensor can show. The standard
        /// error includes at least this share.
        STICKING_MEASURED: f64 = 0.01, "1", Convention;
    }
}
