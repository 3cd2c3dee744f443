//! What a reader did to a log.

use std::fmt;

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

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::GapCut { at_s, length_s } => {
                write!(f, "cut at a gap of {length_s:.4} s after {at_s:.4} s")
            }
            Self::PieceDropped { at_s, samples } => {
                write!(f, "a piece of {samples} samples from {at_s:.4} s on, between gaps, left out")
            }
            Self::Thinned { factor } => {
                write!(f, "thinned: one sample from {factor} rows of the log")
            }
            Self::HeadSkipped { seconds } => write!(f, "the first {seconds} s left out as asked"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Note;

    #[test]
    fn notes_read_as_sentences() {
        let notes = [
            Note::GapCut { at_s: 1.5, length_s: 0.25 },
            Note::PieceDropped { at_s: 2.0, samples: 12 },
            Note::Thinned { factor: 4 },
            Note::HeadSkipped { seconds: 2.0 },
        ];
        let texts: Vec<String> = notes.iter().map(ToString::to_string).collect();
        assert_eq!(
            texts,
            [
                "cut at a gap of 0.2500 s after 1.5000 s",
                "a piece of 12 samples from 2.0000 s on, between gaps, left out",
                "thinned: one sample from 4 rows of the log",
                "the first 2 s left out as asked",
            ]
        );
    }
}
