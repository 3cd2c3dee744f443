//! Time stamps and samples of a log: what is wrong with them. What was done to them is a [`Note`](crate::record::Note).

use std::fmt;

use strum::{IntoStaticStr, VariantNames};

use crate::identify::findings::describe::Describe;
use crate::identify::findings::number_text::significant;
use crate::identify::findings::result_key as key;
use crate::identify::findings::severity::Severity;

/// Time stamps and samples of a log.
#[derive(Debug, Clone, PartialEq, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "kebab-case")]
#[non_exhaustive]
pub enum LogFinding {
    /// A run has the same samples as an earlier one.
    RepeatedRun {
        /// Name of the earlier run.
        first: String,
    },
    /// Time stamps are not evenly spaced.
    Jitter {
        /// Root mean square of their difference from an even grid, as a share of the sample time.
        rms_share: f64,
        /// The largest difference.
        max_share: f64,
    },
    /// The sample time of a run is far from that of the other runs.
    SampleTimeUnlike {
        /// Sample time of the run \[s\].
        sample_time_s: f64,
        /// Median of all runs \[s\].
        median_s: f64,
    },
    /// The samples are as far apart, or as close together, as no log of a drive has them.
    TimeUnit {
        /// Median sample time of the runs \[s\].
        sample_time_s: f64,
    },
    /// The command follows the motor as a position goal does.
    CommandFollowsMotor {
        /// Correlation of command and angle.
        correlation: f64,
    },
}

impl fmt::Display for LogFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::RepeatedRun { first } => {
                write!(f, "all samples are equal to those of {first}: this run is not used")
            }
            Self::SampleTimeUnlike { sample_time_s, median_s } => write!(
                f,
                "the sample time of this run is {} s, that of the runs in general {} s: its time stamps may be in another unit",
                significant(*sample_time_s, 3),
                significant(*median_s, 3)
            ),
            Self::TimeUnit { sample_time_s } => write!(
                f,
                "the samples are {} s apart, which no log of a drive is: the time stamps are probably in another unit",
                significant(*sample_time_s, 3)
            ),
            Self::Jitter { rms_share, max_share } => write!(
                f,
                "time stamps differ from an even grid by {:.1} % of the sample time (rms; at most {:.0} %): samples \
                 are taken as evenly spaced",
                100.0 * rms_share,
                100.0 * max_share
            ),
            Self::CommandFollowsMotor { correlation } => write!(
                f,
                "the command follows the motor's angle (correlation {correlation:.4}): it looks like the position goal of a \
                 servo. If it is one, all estimates are wrong"
            ),
        }
    }
}

impl Describe for LogFinding {
    fn code(&self) -> &'static str {
        self.into()
    }

    fn severity(&self) -> Severity {
        Severity::Warning
    }

    fn affects(&self) -> Vec<&'static str> {
        match self {
            Self::RepeatedRun { .. } => vec![key::RAW_RESPONSE],
            Self::SampleTimeUnlike { .. } | Self::TimeUnit { .. } => {
                let joint = [key::COULOMB, key::VISCOUS, key::INERTIA, key::GRAVITY];
                [&joint[..], &[key::COUPLING, key::MODES]].concat()
            }
            Self::Jitter { .. } => vec![key::INERTIA, key::VISCOUS, key::RAW_RESPONSE],
            Self::CommandFollowsMotor { .. } => vec![key::INERTIA, key::VISCOUS, key::COULOMB],
        }
    }

    fn hint(&self) -> &'static str {
        match self {
            Self::RepeatedRun { .. } => {
                "remove it from the campaign: a log that counts twice makes standard errors too small"
            }
            Self::SampleTimeUnlike { .. } => {
                "check the unit of time in this log; give a log with another unit in a campaign of its own"
            }
            Self::TimeUnit { .. } => {
                "check the unit of time; stamps that grow by 1 or 2 are often milliseconds, by 1000 or more microseconds"
            }
            Self::Jitter { .. } => "use the clock of the controller for the time stamps",
            Self::CommandFollowsMotor { .. } => {
                "if the command is a position goal, give it `quantity = \"goal\"`; nothing to do if a spring or gravity holds \
                 the motor"
            }
        }
    }
}
