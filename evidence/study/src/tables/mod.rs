//! The results of the study as markdown.

mod curve;
mod draws;
mod estimates;
mod external;
mod goals;
mod groups;
mod laws;
mod limit;
mod markdown;
mod responses;
mod worst;

pub use external::report as external_report;
pub(crate) use markdown::table;

use crate::law::Law;
use crate::score::Score;
use crate::study::{Scored, Study};

/// Outcome of one study.
type Outcome = Vec<Option<Scored>>;

/// The page of studies. A single study of Coulomb friction gets all tables; otherwise the page compares the laws.
pub fn report(studies: &[(Study, Outcome)]) -> String {
    let sections = match studies {
        [(study, outcome)] if study.law == Law::None => vec![
            preamble(study),
            goals::section(studies),
            estimates::section(study, outcome),
            limit::section(outcome),
            responses::section(outcome),
            curve::section(outcome),
            groups::section(outcome),
            worst::section(outcome),
            draws::section(outcome),
        ],
        several => vec![laws::section(several), goals::section(several)],
    };
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

/// The beginning of the page: what is drawn, and the command that makes the page.
fn preamble(study: &Study) -> String {
    include_str!("preamble.md")
        .trim_end()
        .replace("{campaigns}", &study.campaigns.to_string())
        .replace("{seed}", &study.seed.to_string())
}
