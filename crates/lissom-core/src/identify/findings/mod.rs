//! Findings: what the logs cannot show, what is wrong with them, and what to know before an estimate is used.
//!
//! Each kind of finding is a variant with its numbers. Its code, severity, affected result keys, message and
//! hint follow from the variant, and all texts are in this module. Codes are stable; `docs/src/reference/findings.md` explains
//! each of them.

mod beam_finding;
mod channel_finding;
mod constant_velocity_finding;
mod describe;
mod equivalent_finding;
mod equivalent_motor_finding;
mod estimate_finding;
mod finding;
mod finding_kind;
mod friction_law_finding;
mod log_finding;
mod note;
mod number_text;
mod output_error_finding;
mod payload_finding;
mod regression_finding;
mod regression_words;
mod response_finding;
pub(crate) mod result_key;
mod run_finding;
mod severity;
mod units;
mod validation_finding;

pub use beam_finding::BeamFinding;
pub use channel_finding::{Channel, ChannelFinding};
pub use constant_velocity_finding::{ConstantVelocityFinding, Curvature, SlipDirection};
pub use equivalent_finding::EquivalentFinding;
pub use equivalent_motor_finding::EquivalentMotorFinding;
pub use estimate_finding::{EstimateFinding, FrictionSign, JudgedParameter, OtherMethod};
pub use finding::Finding;
pub use finding_kind::FindingKind;
pub use friction_law_finding::{BetterLaw, FrictionLawFinding, LawSource};
pub use log_finding::LogFinding;
pub use output_error_finding::{LagCause, OutputErrorFinding};
pub use payload_finding::PayloadFinding;
pub use regression_finding::RegressionFinding;
pub use response_finding::ResponseFinding;
pub use run_finding::{MovedParameter, RunFinding};
pub use severity::Severity;
pub use units::EstimateUnits;
pub use validation_finding::ValidationFinding;
