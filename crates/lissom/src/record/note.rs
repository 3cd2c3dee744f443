//! What a reader did to a log.

/// Something done to a log on its way into a [`Run`](super::Run) that its user should know.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Note {
    /// The log was cut at a gap in its time stamps; the run begins after it.
    GapCut {
        /// Stamp before the gap \[s\].
        at_s: f64,
        /// Time without samples \[s\].
        length_s: f64,
    },
    /// A piece between two gaps was too short and was left out.
    PieceDropped {
        /// Stamp of its first sample \[s\].
        at_s: f64,
        /// Samples it had.
        samples: usize,
    },
    /// The log had too many rows: each sample stands for several of them.
    Thinned {
        /// Rows of the log per sample.
        factor: usize,
    },
    /// Samples at the beginning were left out on request.
    HeadSkipped {
        /// Time left out \[s\].
        seconds: f64,
    },
}
