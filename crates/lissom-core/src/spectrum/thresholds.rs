//! When a log is in steady state, and which bands of a broadband run are used.

thresholds! {
    "spectrum" {
        /// A run in steady state needs this many whole blocks.
        BLOCKS_LEAST: usize = 3, "blocks", Convention;
        /// A block belongs to the steady state if its phasor is within this of the later half's
        /// mean.
        STEADY_SCATTER: f64 = 5.0, "standard deviations", Convention;
        /// A block also belongs to the steady state if its phasor is within this share of the
        /// amplitude: without noise the scatter is nearly zero.
        STEADY_SHARE: f64 = 2e-3, "1", Convention;
        /// A run is reported as not settled if its phasor changes by this share or more over
        /// the blocks that are kept.
        SETTLED_CHANGE: f64 = 0.02, "1", Convention;
        /// A band has this many bins at least: a variance needs more than one.
        BINS_LEAST: usize = 4, "bins", Convention;
        /// Bands at either end are left out as not driven if their power is less than this share of
        /// the power next to them.
        BAND_DRIVEN: f64 = 0.05, "1", Convention;
        /// Ratio of frequency within which bands are next to each other.
        BAND_NEXT: f64 = 1.3, "1", Convention;
    }
}
