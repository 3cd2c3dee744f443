//! Options and commands that help with a finding. The library's own hints name none of them.

use lissom::identify::findings::{
    EquivalentFinding, EquivalentMotorFinding, FindingKind, OutputErrorFinding, RegressionFinding,
    ValidationFinding,
};
use lissom::identify::{EquivalentRefusal, Finding, MissingKind, MovedBy};
use lissom_io::result::FindingEntry;
use lissom_views::ProgramHints;

/// What the command adds to the report page of an identification.
pub(crate) fn page_hints(findings: &[Finding]) -> ProgramHints {
    hints_of(findings.iter().map(|finding| command_hint(&finding.kind)))
}

/// What the command adds to the report page of a stored result. Only the codes of its findings are known.
pub(crate) fn stored_page_hints(findings: &[FindingEntry]) -> ProgramHints {
    hints_of(findings.iter().map(|finding| code_hint(&finding.code)))
}

fn hints_of(of_findings: impl Iterator<Item = Option<&'static str>>) -> ProgramHints {
    let equivalent_intervals = Some("The command lissom equivalent gives the 95 % intervals.");
    ProgramHints { of_findings: of_findings.collect(), equivalent_intervals }
}

/// The hint of findings for which it does not depend on their numbers.
fn code_hint(code: &str) -> Option<&'static str> {
    match code {
        "one-sine" => Some(WITHOUT_QUICK),
        "more-than-noise" => Some(RESIDUALS),
        "faint-mode" => Some(MODEL_MODES),
        _ => None,
    }
}

/// The option or command that helps with a finding, in addition to the finding's own hint.
pub(crate) fn command_hint(kind: &FindingKind) -> Option<&'static str> {
    match kind {
        FindingKind::Regression(RegressionFinding::OneSine) => Some(WITHOUT_QUICK),
        FindingKind::Regression(RegressionFinding::MissingTerm { term, .. }) => {
            (term.kind == MissingKind::BeamDamping).then_some(WITHOUT_QUICK)
        }
        FindingKind::OutputError(OutputErrorFinding::MoreThanNoise { .. }) => Some(RESIDUALS),
        FindingKind::OutputError(OutputErrorFinding::FaintMode { .. }) => Some(MODEL_MODES),
        FindingKind::Equivalent(found) => equivalent(found),
        FindingKind::EquivalentMotor(EquivalentMotorFinding::EquivalentMotorFriction {
            ..
        }) => Some("`lissom identify CAMPAIGN` removes friction and identifies the arm from logs"),
        FindingKind::Validation(
            ValidationFinding::TorqueNotPredicted { coupling_known: true }
            | ValidationFinding::TorqueHidden { .. },
        ) => Some("--window TIME sets the length of the window"),
        FindingKind::Validation(ValidationFinding::ModeMoved { moved }) => (moved.by
            == MovedBy::Load)
            .then_some("`lissom payload CAMPAIGN` predicts the modes with another payload"),
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
            Some("`lissom identify CAMPAIGN` identifies the arm from logs")
        }
        _ => None,
    }
}

/// The option that states what a log does not.
pub(crate) fn option(key: &str, value: &str) -> String {
    let key = if key == "tips" { "tip".to_owned() } else { key.replace('_', "-") };
    let plain = value.chars().all(|c| c.is_alphanumeric() || "_.:/[]*,=".contains(c));
    if plain { format!("--{key} {value}") } else { format!("--{key} \"{value}\"") }
}

/// The option or command that helps when no equivalent arm is found.
pub(crate) fn refusal_hint(refusal: &EquivalentRefusal) -> Option<&'static str> {
    match refusal {
        EquivalentRefusal::FewerPoints { .. } => {
            Some("`lissom equivalent` with --modes N keeps the N lowest modes")
        }
        EquivalentRefusal::Beam { .. } => Some(
            "`lissom equivalent` with --arm ARM --at NAME=LENGTH finds a better place for a point, on a beam of known \
             dimensions",
        ),
        EquivalentRefusal::NoAngle => {
            Some("`lissom identify CAMPAIGN` finds modes and torques from such signals")
        }
        _ => None,
    }
}

const RESIDUALS: &str = "`lissom validate RESULT CAMPAIGN` shows the residual of each channel";
const MODEL_MODES: &str = "`lissom model ARM` gives the frequencies of a beam of known dimensions";
const WITHOUT_QUICK: &str =
    "this method is used unless --quick is given or the command is too noisy for it";
