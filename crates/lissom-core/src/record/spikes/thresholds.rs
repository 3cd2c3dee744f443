//! Thresholds for single wrong readings.

thresholds! {
    "spikes" {
        /// A reading is a spike, or a jump to another level, if its second difference is this many
        /// times the value that 95 % of the others stay below, and this many steps of the sensor.
        SPIKE_SIZE: f64 = 20.0, "1", Convention;
        /// The second differences of a spike are 1, -2, 1 and those of a jump 1, -1 to within this
        /// share; those of a mechanical shock are not.
        SPIKE_SHAPE: f64 = 0.1, "1", Convention;
        /// The first and the last reading are checked for spikes only if the channel has this many
        /// second differences for comparison.
        SPIKE_AT_END_LEAST: usize = 20, "samples", Convention;
        /// Spikes are replaced if at most this share of a channel's readings are spikes, or only one is. In a channel with
        /// more of them other readings are probably wrong, too.
        SPIKES_REPLACED: f64 = 1e-3, "1", Convention;
    }
}
