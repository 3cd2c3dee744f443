//! What is wrong with the readings of motor and tips, in findings: end stops and spikes.

use super::channel_check::{clipped_share, spikes};
use super::finding::{Finding, Severity, key};
use crate::record::{Campaign, Run, TipQuantity};

/// Share of a run at an end stop from which on it is told of.
const CLIPPED: f64 = 0.002;

pub(super) fn findings(campaign: &Campaign, run: &Run) -> Vec<Finding> {
    let tips = campaign.channels.tips.iter().zip(run.tips());
    let tips = tips.map(|(tip, x)| (tip.name.as_str(), x.as_slice(), tip.quantity));
    let sensors = [("motor", run.motor(), TipQuantity::Angle)].into_iter().chain(tips);
    let each = sensors.flat_map(|(name, x, quantity)| {
        // Knocks are in accelerations as they are.
        let moves = quantity != TipQuantity::Acceleration;
        [clipped(name, x), moves.then(|| spiked(name, x, run)).flatten()]
    });
    each.flatten().map(|finding| finding.of(run.name())).collect()
}

fn clipped(name: &str, x: &[f64]) -> Option<Finding> {
    let share = clipped_share(x);
    (share > CLIPPED).then(|| {
        Finding::new(
            "clipped-channel",
            Severity::Warning,
            &[key::COULOMB, key::VISCOUS, key::INERTIA, key::TIPS],
            format!("channel {name} stands at its end stop for {:.1} % of the run", 100.0 * share),
            "the sensor's range or the axis' travel ends there: drive it with less amplitude",
        )
    })
}

fn spiked(name: &str, x: &[f64], run: &Run) -> Option<Finding> {
    let found = spikes(x);
    let first = *found.first()?;
    let others = match found.len() {
        1 => String::new(),
        n => format!(", the first of {n}"),
    };
    Some(Finding::new(
        "spike",
        Severity::Warning,
        &[key::COULOMB, key::VISCOUS, key::INERTIA, key::COUPLING, key::MODES, key::TIPS],
        format!(
            "channel {name} reads {:.4} between {:.4} and {:.4}, {:.4} s after the run's first sample: a spike{others}. \
             No figure of this run is what it would be without",
            x[first],
            x[first - 1],
            x[first + 1],
            first as f64 * run.sample_time_s()
        ),
        "a bad reading or a lost count: put the mean of its neighbours in its place, or leave the stretch out (skip)",
    ))
}
