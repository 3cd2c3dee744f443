//! What is wrong with the readings of motor and tips, in findings: ends of the range, spikes, jumps, frozen sensors.

use std::ops::Range;

use crate::identify::findings::{Channel, EstimateUnits, Finding, rows};
use crate::identify::prepare::channel_check::{clipped_share, encoder_bits, jumps};
use crate::identify::prepare::frozen_sensor::{frozen_motor, frozen_tip};
use crate::identify::prepare::thresholds::{CLIPPED_REPORTED, WHOLE_TURN};
use crate::identify::thresholds::RUNS_LEFT_OUT_OF;
use crate::record::spikes::spikes;
use crate::record::{Axis, Campaign, Run, Tip, TipQuantity};

pub(crate) fn findings(campaign: &Campaign, run: &Run) -> Vec<Finding> {
    let units = EstimateUnits::new(&campaign.channels);
    let mut found = Vec::new();
    found.extend(clipped(&Channel::Motor, run.motor()));
    found.extend(alone_or_jumping(&Channel::Motor, run.motor(), units.angle(), run));
    let still = frozen_motor(run.motor(), run.command());
    let left_out = campaign.runs.len() >= RUNS_LEFT_OUT_OF;
    found.extend(still.map(|still| {
        let (channel, x, unit) = (Channel::Motor, run.motor(), units.angle());
        stands_still(channel, (x, unit), (run, still), left_out)
    }));
    let rotary = campaign.channels.axis == Axis::Rotary;
    found.extend(rotary.then(|| in_degrees(&Channel::Motor, run.motor())).flatten());
    for (tip, x) in campaign.channels.tips.iter().zip(run.tips()) {
        let (channel, unit) = (Channel::Tip(tip.name.clone()), tip_unit(units, tip));
        found.extend(clipped(&channel, x));
        // Knocks are in accelerations as they are.
        if tip.quantity != TipQuantity::Acceleration {
            found.extend(alone_or_jumping(&channel, x, unit, run));
        }
        // At a constant velocity a deflection stands still.
        if tip.quantity == TipQuantity::Angle {
            let still = frozen_tip(x, run.motor());
            found.extend(
                still.map(|still| stands_still(channel.clone(), (x, unit), (run, still), left_out)),
            );
            found.extend((rotary && tip.calibrated).then(|| in_degrees(&channel, x)).flatten());
        }
    }
    found.into_iter().map(|finding| Finding::of_run(run.name(), finding)).collect()
}

/// Unit of a tip's readings; empty where it is not that of the motor's.
pub(super) fn tip_unit(units: EstimateUnits, tip: &Tip) -> &'static str {
    let is_angle = tip.calibrated && tip.quantity != TipQuantity::Acceleration;
    if is_angle { units.angle() } else { "" }
}

fn alone_or_jumping(
    channel: &Channel,
    x: &[f64],
    unit: &'static str,
    run: &Run,
) -> impl Iterator<Item = Finding> {
    [spiked(channel, x, unit, run), jumping(channel, x, unit, run)].into_iter().flatten()
}

fn jumping(channel: &Channel, x: &[f64], unit: &'static str, run: &Run) -> Option<Finding> {
    let found = jumps(x);
    let (first, step) = *found.first()?;
    let turns = step.abs() / std::f64::consts::TAU;
    Some(Finding::new(rows::ReadingJumps {
        channel: channel.clone(),
        step,
        time_s: first as f64 * run.sample_time_s(),
        count: found.len(),
        whole_turns: turns.round() >= 1.0 && (turns - turns.round()).abs() < WHOLE_TURN,
        unit,
    }))
}

fn in_degrees(channel: &Channel, x: &[f64]) -> Option<Finding> {
    let bits = encoder_bits(x, 360.0)?;
    Some(rows::AngleInDegrees { channel: channel.clone(), bits }.into())
}

fn stands_still(
    channel: Channel,
    (x, unit): (&[f64], &'static str),
    (run, still): (&Run, Range<usize>),
    left_out: bool,
) -> Finding {
    let t = run.sample_time_s();
    rows::FrozenChannel {
        channel,
        value: x[still.start],
        from_s: still.start as f64 * t,
        to_s: (still.end - 1) as f64 * t,
        unit,
        left_out,
    }
    .into()
}

fn clipped(channel: &Channel, x: &[f64]) -> Option<Finding> {
    let share = clipped_share(x);
    (share > CLIPPED_REPORTED)
        .then(|| rows::ClippedChannel { channel: channel.clone(), share }.into())
}

fn spiked(channel: &Channel, x: &[f64], unit: &'static str, run: &Run) -> Option<Finding> {
    let found = spikes(x);
    let first = *found.first()?;
    let beside = [first.checked_sub(1), Some(first + 1)].into_iter().flatten();
    Some(Finding::new(rows::Spike {
        channel: channel.clone(),
        value: x[first],
        neighbours: beside.filter_map(|k| x.get(k)).copied().collect(),
        time_s: first as f64 * run.sample_time_s(),
        count: found.len(),
        unit,
    }))
}
