//! Time stamps and samples of a log.

use std::fmt;

use strum::{IntoStaticStr, VariantNames};

use crate::identify::findings::describe::Describe;
use crate::identify::findings::result_key as key;
use crate::identify::findings::severity::Severity;
use crate::record::Note;

/// Time stamps and samples of a log.
#[derive(Debug, Clone, PartialEq, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "kebab-case")]
#[non_exhaustive]
pub enum LogFinding {
    /// A run has the samples of an earlier one.
    RepeatedRun {
        /// Name of the earlier run.
        first: String,
    },
    /// Time stamps that are not evenly spaced.
    Jitter {
        /// Root mean square of their distance from the grid, as a share of the sample time.
        rms_share: f64,
        /// The largest distance.
        max_share: f64,
    },
    /// The log was cut at a gap in its time stamps.
    Gap {
        /// Stamp before the gap \[s\].
        at_s: f64,
        /// Time without samples \[s\].
        length_s: f64,
    },
    /// A piece between two gaps was too short.
    PieceDropped {
        /// Stamp of its first sample \[s\].
        at_s: f64,
        /// Samples it had.
        samples: usize,
    },
    /// The log had too many rows.
    Thinned {
        /// Rows of the log for each sample.
        factor: usize,
    },
    /// Samples at the beginning were left out on request.
    HeadSkipped {
        /// Time left out \[s\].
        length_s: f64,
    },
}

impl From<&Note> for LogFinding {
    fn from(note: &Note) -> Self {
        match *note {
            Note::GapCut { at_s, length_s } => Self::Gap { at_s, length_s },
            Note::PieceDropped { at_s, samples } => Self::PieceDropped { at_s, samples },
            Note::Thinned { factor } => Self::Thinned { factor },
            Note::HeadSkipped { seconds } => Self::HeadSkipped { length_s: seconds },
        }
    }
}

impl fmt::Display for LogFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::RepeatedRun { first } => {
                write!(f, "all samples are those of {first}: this run is not used")
            }
            Self::Jitter { rms_share, max_share } => write!(
                f,
                "time stamps differ from an even grid by {:.1} % of the sample time (rms; at most {:.0} %): samples \
                 are taken as evenly spaced",
                100.0 * rms_share,
                100.0 * max_share
            ),
            Self::Gap { at_s, length_s } => write!(
                f,
                "the log has a gap of {length_s:.4} s after {at_s:.4} s: it is cut there, and this run begins after \
                 the gap"
            ),
            Self::PieceDropped { at_s, samples } => write!(
                f,
                "the piece from {at_s:.4} s on, between two gaps, has only {samples} samples: it is not used"
            ),
            Self::Thinned { factor } => {
                write!(f, "the log is thinned: each sample stands for {factor} rows of it")
            }
            Self::HeadSkipped { length_s } => {
                write!(f, "the first {length_s} s are left out, as the campaign asks")
            }
        }
    }
}

impl Describe for LogFinding {
    fn code(&self) -> &'static str {
        self.into()
    }

    fn severity(&self) -> Severity {
        match self {
            Self::RepeatedRun { .. } | Self::Jitter { .. } => Severity::Warning,
            Self::Gap { .. }
            | Self::PieceDropped { .. }
            | Self::Thinned { .. }
            | Self::HeadSkipped { .. } => Severity::Info,
        }
    }

    fn affects(&self) -> Vec<&'static str> {
        match self {
            Self::RepeatedRun { .. } => vec![key::RAW_RESPONSE],
            Self::Jitter { .. } => vec![key::INERTIA, key::VISCOUS, key::RAW_RESPONSE],
            Self::Gap { .. }
            | Self::PieceDropped { .. }
            | Self::Thinned { .. }
            | Self::HeadSkipped { .. } => Vec::new(),
        }
    }

    fn hint(&self) -> &'static str {
        match self {
            Self::RepeatedRun { .. } => {
                "remove it from the campaign: a log that counts twice makes standard errors too small"
            }
            Self::Jitter { .. } => "log with the clock of the controller",
            Self::Gap { .. } | Self::PieceDropped { .. } => "log without interruption",
            Self::Thinned { .. } => "log fewer samples, or cut the log into several runs",
            Self::HeadSkipped { .. } => "",
        }
    }
}
