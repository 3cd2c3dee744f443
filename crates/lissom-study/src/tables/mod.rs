//! The study's results as markdown.

mod draws;
mod figures;
mod goals;
mod groups;
mod laws;
mod markdown;
mod responses;
mod worst;

use crate::law::Law;
use crate::score::Score;
use crate::study::{Scored, Study};

/// Outcome of one study.
type Outcome = Vec<Option<Scored>>;

/// Everything about the studies made, true Coulomb friction first where it is among them.
pub fn report(studies: &[(Study, Outcome)]) -> String {
    let mut sections = vec![include_str!("preamble.md").trim_end().to_owned()];
    sections.push(goals::section(studies));
    for (study, outcome) in studies.iter().filter(|(study, _)| study.law == Law::None) {
        sections.push(figures::section(study, outcome));
        sections.push(responses::section(outcome));
        sections.push(groups::section(outcome));
        sections.push(worst::section(outcome));
        sections.push(draws::section(outcome));
    }
    if studies.iter().any(|(study, _)| study.law != Law::None) {
        sections.push(laws::section(studies));
    }
    sections.join("\n\n") + "\n"
}

/// The campaigns that were drawn.
fn drawn(outcome: &Outcome) -> Vec<&Scored> {
    outcome.iter().flatten().collect()
}

/// Those that were identified, with their scores.
fn scores(outcome: &Outcome) -> Vec<(&Scored, &Score)> {
    drawn(outcome).into_iter().filter_map(|one| Some((one, one.score.as_ref().ok()?))).collect()
}
