//! The accuracy study: random arms and campaigns, simulated, identified, scored against truth.
//!
//! [`draw_campaign`] makes a campaign from a seed and an index, as an engineer would who tries each
//! run and repeats what saturates or sticks; [`Truth`] is what identification should find;
//! [`Score`] compares; [`study`] does all of it for many campaigns side by side, and [`report`]
//! turns the scores into tables. The generator knows nothing of the estimators, and the scores use
//! nothing but what [`lissom::identify::Identified`] gives.

mod arm;
mod bench;
mod bound;
mod campaign;
mod csv;
mod draw;
mod drives;
mod external;
mod figure;
mod kept;
mod law;
mod plan;
mod position_loop;
mod rejected;
mod score;
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
pub use figure::Figure;
pub use kept::{Kept, KeptError};
pub use law::Law;
pub use rejected::{Dropped, Rejected};
pub use score::{FigureScore, FindingScore, PointScore, Score, score};
pub use single::describe;
pub use statistics::{Share, median, quantile};
pub use stratum::{Kind, Stratum};
pub use study::{Independent, Scored, Study, identified, independent, study};
pub use tables::{external_report, report};
pub use truth::Truth;
