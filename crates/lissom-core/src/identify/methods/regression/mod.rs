//! Regression in slip phases: inertia, friction and coupling without differentiating a measured signal.
#![expect(clippy::inline_always, reason = "compiled for wide registers as one: half the time")]

mod beam;
mod cluster_covariance;
mod extra_delay;
mod fitted;
mod hidden_mode;
mod hold;
mod late_tip;
mod left_out;
mod left_torque;
mod mode_window;
mod motor;
mod motor_columns;
mod motor_rows;
mod normal;
mod row_noise;
mod run_difference;
mod scan;
mod sums_by_length;
mod terms;
pub(crate) mod thresholds;
mod velocity;

pub use beam::{BeamRegression, beam_regression};
pub(crate) use fitted::Fitted;
pub use hidden_mode::HiddenMode;
pub(crate) use hold::other_hold;
pub use hold::{HoldEvidence, HoldShown, OtherHold, hold_shown};
pub(crate) use late_tip::with_tips_in_time;
pub(crate) use left_out::{RunLeftOut, unlike_others};
pub use left_torque::LeftTorque;
pub(crate) use mode_window::{ModeShape, ModeWindow};
pub use motor::{MotorRegression, motor_regression};
pub(crate) use motor_columns::{
    MotorColumns, PLACE_COULOMB, PLACE_INERTIA, PLACE_OFFSET, PLACE_VISCOUS, coupled_tips,
};
pub(crate) use motor_rows::{Further, ModeTerms, MotorEquation, SineAndCosine};
pub(crate) use normal::{
    Cluster, NormalSums, Rows, ScoredEstimates, Scores, Solution, Term, solve, solve_sums,
    values_of,
};
pub use run_difference::RunDifference;
pub use scan::Candidate;
pub(crate) use scan::scan;
pub use terms::GravityPartner;
pub(crate) use terms::Terms;
pub(crate) use velocity::velocity_and_phases;
