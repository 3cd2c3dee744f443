//! Options and commands that help with a finding. The library's own hints name none of them.

use lissom::identify::findings::rows;
use lissom::identify::{EquivalentRefusal, Finding, MissingKind, MovedBy};
use lissom_io::result::FindingEntry;
use lissom_views::ProgramHints;

/// What the command adds to the report page of an identification.
pub(crate) fn page_hints(findings: &[Finding]) -> ProgramHints {
    hints_of(findings.iter().map(command_hint))
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
        rows::OneSine::CODE => Some(WITHOUT_QUICK),
        rows::MoreThanNoise::CODE => {
            Some("`lissom validate RESULT CAMPAIGN` shows the residual of each channel")
        }
        rows::FaintMode::CODE => {
            Some("`lissom model ARM` gives the frequencies of a beam of known dimensions")
        }
        rows::EquivalentMotorFriction::CODE => {
            Some("`lissom identify CAMPAIGN` removes friction and identifies the arm from logs")
        }
        rows::EquivalentTermsInS::CODE => {
            Some("`lissom identify CAMPAIGN` identifies the arm from logs")
        }
        rows::TorqueHidden::CODE => Some(WINDOW),
        _ => None,
    }
}

/// The option or command that helps with a finding, in addition to the finding's own hint.
pub(crate) fn command_hint(finding: &Finding) -> Option<&'static str> {
    if let Some(rows::EquivalentRefused { refusal }) = finding.get() {
        return refusal_hint(refusal);
    }
    let is_damping = |row: &rows::MissingTerm| row.term.kind == MissingKind::BeamDamping;
    let by_load = |row: &rows::ModeMoved| row.moved.by == MovedBy::Load;
    match finding {
        _ if finding.get().is_some_and(is_damping) => Some(WITHOUT_QUICK),
        _ if finding.get().is_some_and(by_load) => {
            Some("`lissom payload CAMPAIGN` predicts the modes with another payload")
        }
        _ if finding.is::<rows::NoWindow>() => Some(WINDOW),
        _ if finding.is::<rows::EquivalentModesLeftOut>() => {
            Some("--modes N keeps the N lowest modes")
        }
        _ => code_hint(finding.code()),
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

const WITHOUT_QUICK: &str =
    "this method is used unless --quick is given or the command is too noisy for it";
const WINDOW: &str = "--window TIME sets the length of the window";
