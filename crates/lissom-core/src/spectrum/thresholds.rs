//! Steady state of a run, and the bands of a broadband run that are used.

thresholds! {
    "spectrum" {
        /// A run in steady state needs at least this many whole blocks of periods.
        BLOCKS_LEAST: usize = 3, "blocks", Convention;
        /// A block belongs to the steady state if its phasor differs from the mean of the later
        /// half by less than this.
        STEADY_SCATTER: f64 = 5.0, "standard deviations", Convention;
        /// A block also belongs to the steady state if its phasor differs by less than this share
        /// of the amplitude: without noise the scatter is almost zero.
        STEADY_SHARE: f64 = 2e-3, "1", Convention;
        /// A run is reported as not periodic if its phasor changes by this share or more over the
        /// blocks that are kept.
        SETTLED_CHANGE: f64 = 0.02, "1", Convention;
        /// A band has at least this many frequency bins: a variance needs more than one.
        BINS_LEAST: usize = 4, "bins", Convention;
        /// Bands at either end are left out as not excited if their power is less than this share
        /// of the power of the bands next to them.
        BAND_DRIVEN: f64 = 0.05, "1", Convention;
        /// Two bands are next to each other if the ratio of their frequencies is below this.
        BAND_NEXT: f64 = 1.3, "1", Convention;
    }
}
