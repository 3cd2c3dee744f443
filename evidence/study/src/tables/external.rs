//! The page about campaigns of another simulator.

use super::estimates::errors;
use super::{drawn, limit, scores, worst};
use crate::score::EstimateScore;
use crate::statistics::{Share, quantile};
use crate::study::{Independent, Study};

/// The page about campaigns that another simulator made.
pub fn report(study: &Study, found: &Independent) -> String {
    let all = scores(&found.outcome);
    let silent = all.iter().filter(|(_, s)| s.estimates.iter().any(EstimateScore::silently_wrong));
    let silent = Share { hits: silent.count(), of: all.len() };
    [
        include_str!("external.md").trim_end().replace("COUNT", &study.campaigns.to_string()),
        format!(
            "## Random arms\n\nSeed {}, {} campaigns identified. Campaigns with a silently wrong parameter: {silent}. \
             {}\n\n[Accuracy on random arms](accuracy.md) explains the columns. All estimates:",
            study.seed,
            all.len(),
            agreement(found),
        ),
        errors(&all, |f| f.estimate.is_some()),
        limit::section(&found.outcome),
        worst::section(&found.outcome),
        // Written by hand, with the tables of `cargo xtask external`.
        include_str!("mujoco_sysid.md").trim_end().to_owned(),
    ]
    .join("\n\n")
        + "\n"
}

/// Compares the motion of the other simulator with that of the rig, and with the replay of the logs through the true
/// arm.
fn agreement(found: &Independent) -> String {
    let all: Vec<f64> = drawn(&found.outcome).iter().flat_map(|s| s.left.iter().copied()).collect();
    let at = |share| quantile(&all, share).map_or_else(|| "–".to_owned(), |v| format!("{v:.3}"));
    format!(
        "Without noise, {} of {} readings are the same as those of lissom's rig. The residual that the true arm's replay of \
         the logs leaves, divided by the sensor's standard deviation √(s² + q²/12), is {} in the median, and {} to {} over \
         all channels.",
        found.alike.hits,
        found.alike.of,
        at(0.5),
        at(0.0),
        at(1.0)
    )
}
