//! The accuracy study: random arms and campaigns are simulated, identified, and compared with the truth.
//!
//! [`draw_campaign`] makes a campaign from a seed and an index, as an engineer would: each run is
//! tried, and repeated if it saturates or sticks. [`Truth`] has the true parameters; [`Score`]
//! compares; [`study`] does all of this for many campaigns in parallel, and [`report`] makes tables
//! of the scores. The generator does not depend on the estimators, and the scores use only
//! [`lissom::identify::Identified`].

mod arm;
mod bench;
mod bound;
mod campaign;
mod csv;
mod draw;
mod drives;
mod external;
mod kept;
mod law;
mod plan;
mod position_loop;
mod rejected;
mod score;
mod scored_parameter;
mod single;
mod statistics;
mod stratum;
mod study;
mod tables;
mod trial;
mod truth;

pub use bound::Bound;
pub use campaign::{Campaign, Definition, PlannedRun, RunFacts, draw_campaign};
pub use csv::rows;
pub use drives::{
    Cause, DriveCampaign, DriveNumbers, DriveOutcome, DriveParameter, DriveScore, DriveStudy,
    DriveStudyPlan, Effects, FoundCode, FrictionLine, GearRipple, Gravity, Input, Lag, LineOf,
    LogsError, MotionKind, NearRest, ParameterScore, TorqueBound, UnseenMode, Wander,
    describe_drive, drive_report, drive_rows, drive_study, score_drive, write_logs,
};
pub use external::{ExternalError, export, simulated};
pub use kept::{Kept, KeptError};
pub use law::Law;
pub use rejected::{Dropped, Rejected};
pub use score::{EstimateScore, FindingScore, PointScore, Score, score};
pub use scored_parameter::ScoredParameter;
pub use single::describe;
pub use statistics::{Share, median, quantile};
pub use stratum::{Kind, Stratum};
pub use study::{Independent, Scored, Study, identified, independent, study};
pub use tables::{external_report, report};
pub use truth::Truth;
