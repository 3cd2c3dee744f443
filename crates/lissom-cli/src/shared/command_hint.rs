//! What options of this command, or other commands, do about a finding. The library names none of them.

use lissom::identify::findings::{
    EquivalentFinding, EquivalentMotorFinding, FindingKind, OutputErrorFinding, RegressionFinding,
    ValidationFinding,
};
use lissom::identify::{EquivalentRefusal, MissingKind, MovedBy};

/// Which option or command helps, beside the finding's own hint.
pub(crate) fn command_hint(kind: &FindingKind) -> Option<&'static str> {
    match kind {
        FindingKind::Regression(RegressionFinding::OneSine) => Some(WITHOUT_QUICK),
        FindingKind::Regression(RegressionFinding::MissingTerm { term, .. }) => {
            (term.kind == MissingKind::BeamDamping).then_some(WITHOUT_QUICK)
        }
        FindingKind::OutputError(OutputErrorFinding::MoreThanNoise { .. }) => {
            Some("`lissom validate RESULT CAMPAIGN` shows the residual")
        }
        FindingKind::OutputError(OutputErrorFinding::FaintMode { .. }) => {
            Some("`lissom model ARM` gives the frequencies of a beam of known dimensions")
        }
        FindingKind::Equivalent(found) => equivalent(found),
        FindingKind::EquivalentMotor(EquivalentMotorFinding::EquivalentMotorFriction {
            ..
        }) => Some("`lissom identify CAMPAIGN` removes friction and gives the arm from logs"),
        FindingKind::Validation(
            ValidationFinding::TorqueNotPredicted { coupling_known: true }
            | ValidationFinding::TorqueHidden { .. },
        ) => Some("--window TIME sets the window"),
        FindingKind::Validation(ValidationFinding::ModeMoved { moved }) => (moved.by
            == MovedBy::Load)
            .then_some("`lissom payload CAMPAIGN` predicts the arm with another payload"),
        _ => None,
    }
}

fn equivalent(found: &EquivalentFinding) -> Option<&'static str> {
    match found {
        EquivalentFinding::EquivalentRefused { refusal } => refusal_hint(refusal),
        EquivalentFinding::EquivalentModesLeftOut { .. } => {
            Some("--modes N keeps the N lowest modes")
        }
        EquivalentFinding::EquivalentTermsInS { .. } => {
            Some("`lissom identify CAMPAIGN` gives the arm from logs")
        }
        _ => None,
    }
}

/// Which option or command helps where there is no equivalent arm.
pub(crate) fn refusal_hint(refusal: &EquivalentRefusal) -> Option<&'static str> {
    match refusal {
        EquivalentRefusal::FewerPoints { .. } => {
            Some("`lissom equivalent` with --modes N keeps the N lowest modes")
        }
        EquivalentRefusal::Beam { .. } => Some(
            "`lissom equivalent` with --arm ARM --at NAME=LENGTH finds a place on a beam of known dimensions",
        ),
        EquivalentRefusal::NoAngle => {
            Some("`lissom identify CAMPAIGN` gives modes and torques from such signals")
        }
        _ => None,
    }
}

const WITHOUT_QUICK: &str = "leave out --quick";
