//! What is wrong with the readings of motor and tips, in findings: end stops, spikes, jumps, frozen sensors.

use crate::identify::finding::{Finding, Severity, key};
use crate::identify::prepare::channel_check::{clipped_share, encoder_bits, frozen, jumps, spikes};
use crate::identify::prepare::thresholds::{CLIPPED_REPORTED, WHOLE_TURN};
use crate::record::{Axis, Campaign, Run, TipQuantity};

pub(crate) fn findings(campaign: &Campaign, run: &Run) -> Vec<Finding> {
    let mut found = Vec::new();
    found.extend(clipped("motor", run.motor()));
    found.extend(alone_or_jumping("motor", run.motor(), run));
    let rotary = campaign.channels.axis == Axis::Rotary;
    found.extend(rotary.then(|| in_degrees("motor", run.motor())).flatten());
    for (tip, x) in campaign.channels.tips.iter().zip(run.tips()) {
        found.extend(clipped(&tip.name, x));
        // Knocks are in accelerations as they are.
        if tip.quantity != TipQuantity::Acceleration {
            found.extend(alone_or_jumping(&tip.name, x, run));
        }
        // At a constant velocity a deflection stands still.
        if tip.quantity == TipQuantity::Angle {
            found.extend(stands_still(&tip.name, x, run));
            found.extend((rotary && tip.calibrated).then(|| in_degrees(&tip.name, x)).flatten());
        }
    }
    found.into_iter().map(|finding| finding.of(run.name())).collect()
}

fn alone_or_jumping(name: &str, x: &[f64], run: &Run) -> impl Iterator<Item = Finding> {
    [spiked(name, x, run), jumping(name, x, run)].into_iter().flatten()
}

const EVERYTHING: [&str; 6] =
    [key::COULOMB, key::VISCOUS, key::INERTIA, key::COUPLING, key::MODES, key::TIPS];

fn jumping(name: &str, x: &[f64], run: &Run) -> Option<Finding> {
    let found = jumps(x);
    let (first, by) = *found.first()?;
    let others = match found.len() {
        1 => String::new(),
        n => format!(", the first of {n} such jumps"),
    };
    let turns = by.abs() / std::f64::consts::TAU;
    let whole = turns.round() >= 1.0 && (turns - turns.round()).abs() < WHOLE_TURN;
    let (what, hint) = if whole {
        (
            " (whole turns)",
            "a sensor that wraps round: add the turns up over the log (unwrap) before identifying",
        )
    } else {
        (
            "",
            "lost counts, a sensor that wraps round, or samples that are missing: take the jump out of what follows \
             it, or leave the stretch out (skip)",
        )
    };
    Some(Finding::new(
        "reading-jumps",
        Severity::Warning,
        &EVERYTHING,
        format!(
            "channel {name} jumps by {by:.4}{what} from one sample to the next, {:.4} s after the run's first \
             sample{others}. No figure of this run is what it would be without",
            first as f64 * run.sample_time_s()
        ),
        hint,
    ))
}

fn in_degrees(name: &str, x: &[f64]) -> Option<Finding> {
    let bits = encoder_bits(x, 360.0)?;
    Some(Finding::new(
        "angle-in-degrees",
        Severity::Warning,
        &EVERYTHING,
        format!(
            "channel {name} reads in steps of 360/2^{bits} rad: an encoder of {bits} bits in degrees. Figures are 57.3 times \
             too small or too large if it is"
        ),
        "give its column unit = \"deg\"",
    ))
}

fn stands_still(tip: &str, x: &[f64], run: &Run) -> Option<Finding> {
    let still = frozen(x, run.motor())?;
    let t = run.sample_time_s();
    Some(Finding::new(
        "frozen-channel",
        Severity::Warning,
        &EVERYTHING,
        format!(
            "channel {tip} reads {:.4} from {:.4} s to {:.4} s after the run's first sample while the motor moves on: \
             frozen. No figure of this run is what it would be without",
            x[still.start],
            still.start as f64 * t,
            (still.end - 1) as f64 * t
        ),
        "a lost connection or a logger that repeats its last value: leave the stretch out (skip, or cut the log)",
    ))
}

fn clipped(name: &str, x: &[f64]) -> Option<Finding> {
    let share = clipped_share(x);
    (share > CLIPPED_REPORTED).then(|| {
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
    let beside = [first.checked_sub(1), Some(first + 1)].into_iter().flatten();
    let beside: Vec<String> =
        beside.filter_map(|k| x.get(k)).map(|neighbour| format!("{neighbour:.4}")).collect();
    Some(Finding::new(
        "spike",
        Severity::Warning,
        &EVERYTHING,
        format!(
            "channel {name} reads {:.4} beside {}, {:.4} s after the run's first sample: a spike{others}. \
             No figure of this run is what it would be without",
            x[first],
            beside.join(" and "),
            first as f64 * run.sample_time_s()
        ),
        "a bad reading or a lost count: put the mean of its neighbours in its place, or leave the stretch out (skip)",
    ))
}
