//! Drives with the effects of real logs: noisy measured currents, friction that wanders and is not linear in speed,
//! loads, ripple, late time stamps, few strokes, modes that are not measured.
//!
//! [`DriveCampaign`] is drawn and simulated. [`FrictionLine`] is the friction that the result should give.
//! [`TorqueBound`] has the smallest possible standard errors. [`DriveScore`] compares; [`drive_study`] does this for
//! many campaigns.

mod drive_campaign;
mod drive_description;
mod drive_logs;
mod drive_parameter;
mod drive_report;
mod drive_rows;
mod drive_score;
mod drive_study;
mod effects;
mod friction_line;
mod planned_motion;
mod torque_bound;

pub use drive_campaign::{DriveCampaign, DriveNumbers};
pub use drive_description::describe_drive;
pub use drive_logs::{LogsError, write_logs};
pub use drive_parameter::DriveParameter;
pub use drive_report::drive_report;
pub use drive_rows::drive_rows;
pub use drive_score::{DriveScore, FoundCode, ParameterScore, score_drive};
pub use drive_study::{DriveOutcome, DriveStudyPlan, drive_study};
pub use effects::{
    Cause, DriveStudy, Effects, GearRipple, Gravity, Input, Lag, NearRest, UnseenMode, Wander,
};
pub use friction_line::{FrictionLine, LineOf};
pub use planned_motion::MotionKind;
pub use torque_bound::TorqueBound;
