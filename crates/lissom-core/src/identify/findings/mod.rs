//! The table of findings: what the logs cannot show, what is wrong with them, and what to know before an estimate is used.
//!
//! A row is a struct of the numbers in its message. The macro `findings` declares its code, severity, affected result keys,
//! message and hint with it; [`Finding::get`] gives the row of a finding. Rows for one thing to the user share a code.

mod beam_finding;
mod channel_finding;
mod constant_velocity_finding;
mod equivalent_finding;
mod estimate_finding;
mod friction_law_finding;
mod log_finding;
mod number_text;
mod output_error_finding;
mod prediction_finding;
mod regression_finding;
mod regression_words;
mod response_finding;
mod run_finding;
mod units;

pub use channel_finding::Channel;
pub use estimate_finding::JudgedParameter;
pub use friction_law_finding::{BetterLaw, LawSource};
pub use run_finding::MovedParameter;
pub use units::EstimateUnits;

pub use crate::finding::{Finding, Severity};

/// Rows of the table.
pub mod rows {
    pub use super::beam_finding::*;
    pub use super::channel_finding::*;
    pub use super::constant_velocity_finding::*;
    pub use super::equivalent_finding::*;
    pub use super::estimate_finding::*;
    pub use super::friction_law_finding::*;
    pub use super::log_finding::*;
    pub use super::output_error_finding::*;
    pub use super::prediction_finding::*;
    pub use super::regression_finding::*;
    pub use super::response_finding::*;
    pub use super::run_finding::*;
    pub use crate::record::note::*;
}

/// All codes, each once.
pub fn codes() -> Vec<&'static str> {
    let mut codes = [
        channel_finding::CODES,
        log_finding::CODES,
        crate::record::note::CODES,
        run_finding::CODES,
        constant_velocity_finding::CODES,
        regression_finding::CODES,
        friction_law_finding::CODES,
        output_error_finding::CODES,
        response_finding::CODES,
        beam_finding::CODES,
        estimate_finding::CODES,
        equivalent_finding::CODES,
        prediction_finding::CODES,
    ]
    .concat();
    codes.sort_unstable();
    codes.dedup();
    codes
}

/// Sort order among findings of the same severity: 0 for effects on the joint or in the log, 2 for findings about
/// responses only, 1 for all others.
pub(crate) fn rank(finding: &Finding) -> u8 {
    let on_the_joint = [
        regression_finding::CODES,
        friction_law_finding::CODES,
        log_finding::CODES,
        crate::record::note::CODES,
        &[rows::Offset::CODE],
    ];
    match finding.code() {
        code if on_the_joint.iter().any(|codes| codes.contains(&code)) => 0,
        rows::NoPairs::CODE => 2,
        code if response_finding::CODES.contains(&code) => 2,
        _ => 1,
    }
}

/// Findings that may be the cause of others: wrong readings, a run unlike the others, a missing term of the equation, a
/// lag, a mode without a tip, friction that varies.
const CAUSES: &[&str] = &[
    rows::Spike::CODE,
    rows::AngleInDegrees::CODE,
    rows::FrozenChannel::CODE,
    rows::CommandSign::CODE,
    rows::RunStandsOut::CODE,
    rows::UnlikeOthers::CODE,
    rows::MissingTerm::CODE,
    rows::HiddenMode::CODE,
    rows::AngleLag::CODE,
    rows::CommandLag::CODE,
    rows::TipLag::CODE,
    rows::FrictionVaries::CODE,
    rows::MoreModesThanTips::CODE,
];

/// Whether it may be the cause of other findings.
pub(crate) fn is_cause(finding: &Finding) -> bool {
    CAUSES.contains(&finding.code())
}
