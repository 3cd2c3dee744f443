//! The finding that reports the law of friction.

use crate::identify::estimate::Estimate;
use crate::identify::findings::{BetterLaw, EstimateUnits, Finding, LawSource, rows};
use crate::identify::judge::Evidence;
use crate::identify::methods::friction_law::thresholds::LAW_LEAVES_MUCH;
use crate::identify::methods::friction_law::{LawCandidate, LawTerm, ModelTerm};
use crate::identify::methods::regression::MotorRegression;
use crate::identify::output_error::OutputError;

/// The law of friction that the data call for: that of the replay where it describes the runs.
pub(crate) fn finding(evidence: &Evidence<'_>) -> Option<Finding> {
    let units = EstimateUnits::new(&evidence.campaign.channels);
    let reported = |terms: Vec<(LawTerm, Vec<Estimate>)>, source: LawSource| {
        Some(Finding::new(rows::FrictionLaw { terms, source, units }))
    };
    let replay = evidence.replay();
    let by_replay = replay.map_or(Vec::new(), OutputError::law_terms);
    if !by_replay.is_empty() {
        let source = LawSource::OutputError {
            whole_runs: replay.is_some_and(|oe| oe.describes_whole_runs() && !oe.is_in_windows()),
        };
        return reported(by_replay, source);
    }
    let law = evidence.methods.friction_law.as_ref()?;
    let is_friction = |(term, _): &(LawTerm, Vec<Estimate>)| *term != LawTerm::CommandLag;
    if !law.chosen.terms.iter().any(is_friction) {
        return None;
    }
    let is_lag = |c: &LawCandidate| c.term == ModelTerm::Law(LawTerm::CommandLag);
    let taken = law.candidates.iter().filter(|c| c.taken && !is_lag(c));
    let paired = taken.map(|c| c.standard_errors).fold(f64::INFINITY, f64::min);
    let of_noise = |r: &MotorRegression| r.left.is_noise();
    let of_noise = evidence.methods.regression.as_ref().is_some_and(of_noise);
    let left_over = law.relative_residual[1];
    let source = LawSource::SlipPhases {
        left_over: (left_over > LAW_LEAVES_MUCH && !of_noise).then_some(left_over),
        // The replay describes whole runs with the simplest law, and its estimates are taken.
        replayed_without: replay.is_some(),
        better: paired.is_finite().then(|| BetterLaw {
            residual_ratio: law.relative_residual[1] / law.relative_residual[0],
            standard_errors: paired,
        }),
    };
    reported(law.chosen.terms.clone(), source)
}
