//! What `lissom inspect --json` writes.

use serde::{Deserialize, Serialize};

use super::inspected_channel::InspectedChannel;
use super::inspection::Inspection;
use super::relations::Relation;
use super::stated_unit::UnitSource;

/// What `lissom inspect --json` writes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct InspectionFile {
    /// The logs.
    pub logs: Vec<InspectedLogEntry>,
}

/// A log. Values are in the units of the file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct InspectedLogEntry {
    /// The log.
    pub file: String,
    /// Its format.
    pub format: String,
    /// The clock that the time stamps give; null if no channel has time stamps.
    pub clock: Option<ClockEntry>,
    /// The channels, in the order of the file.
    pub channels: Vec<InspectedChannelEntry>,
    /// Which channel is probably what.
    pub roles: Vec<RoleEntry>,
    /// What was left out, and what does not agree.
    pub notes: Vec<String>,
}

/// What the time stamps show, in their unit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ClockEntry {
    /// Usual step.
    pub step: f64,
    /// Smallest step.
    pub step_min: f64,
    /// Largest step.
    pub step_max: f64,
    /// Number of steps that are more than half longer than the usual one.
    pub gaps: usize,
    /// Number of stamps that are equal to the one before.
    pub repeated: usize,
    /// Number of stamps that are earlier than the one before.
    pub back: usize,
    /// From the first to the last stamp.
    pub length: f64,
}

/// A channel.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct InspectedChannelEntry {
    /// Its number, from 1.
    pub number: usize,
    /// Its name; empty if the file has none.
    pub name: String,
    /// Its unit as stated; null if it is not.
    pub unit: Option<String>,
    /// Whether the unit stands at the end of the name, not by itself.
    pub unit_from_name: bool,
    /// Number of values.
    pub values: usize,
    /// Number of them that are missing.
    pub missing: usize,
    /// Smallest value; null if all are missing.
    pub min: Option<f64>,
    /// Largest value.
    pub max: Option<f64>,
    /// Step of the values (of an encoder or converter); null if there is none.
    pub step: Option<f64>,
    /// Bits of the range in such steps.
    pub bits: Option<u32>,
    /// Whether the value never changes.
    pub constant: bool,
    /// Share of values that stay equal to the smallest; null below 2 %.
    pub at_min_share: Option<f64>,
    /// Share of values that stay equal to the largest; null below 2 %.
    pub at_max_share: Option<f64>,
    /// Number of jumps by about the whole range.
    pub wraps: usize,
    /// Number of the channel of which it is a multiple.
    pub multiple_of: Option<usize>,
    /// Number of the channel of which it is the rate.
    pub rate_of: Option<usize>,
    /// Factor of this relation, in the units of the file.
    pub factor: Option<f64>,
    /// Row of the first cell that is not a number.
    pub not_a_number_in_row: Option<usize>,
}

/// A guess.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RoleEntry {
    /// The role: time, current, torque, voltage, motor, speed, tip.
    pub role: String,
    /// Number of the channel, from 1.
    pub channel: usize,
    /// Why.
    pub why: String,
}

impl InspectionFile {
    /// The content for some logs.
    pub fn of(logs: &[Inspection]) -> Self {
        Self { logs: logs.iter().map(InspectedLogEntry::of).collect() }
    }
}

impl InspectedLogEntry {
    fn of(found: &Inspection) -> Self {
        let clock = found.clock.as_ref().map(|c| ClockEntry {
            step: c.step,
            step_min: c.steps[0],
            step_max: c.steps[1],
            gaps: c.gaps,
            repeated: c.repeated,
            back: c.back,
            length: c.length,
        });
        let role = |(role, guess): &(super::roles::Role, super::roles::Guess)| RoleEntry {
            role: role.name().to_owned(),
            channel: guess.channel + 1,
            why: guess.why.clone(),
        };
        Self {
            file: found.file.display().to_string(),
            format: found.format.name().to_owned(),
            clock,
            channels: found.channels.iter().map(entry).collect(),
            roles: found.roles.all().iter().map(role).collect(),
            notes: found.notes.clone(),
        }
    }
}

fn entry(channel: &InspectedChannel) -> InspectedChannelEntry {
    let facts = &channel.facts;
    let finite = |value: f64| value.is_finite().then_some(value);
    let (multiple_of, rate_of, factor) = match channel.relation {
        None => (None, None, None),
        Some(Relation::Multiple { of, factor }) => (Some(of + 1), None, Some(factor)),
        Some(Relation::Rate { of, factor }) => (None, Some(of + 1), Some(factor)),
    };
    InspectedChannelEntry {
        number: channel.number,
        name: channel.name.clone(),
        unit: channel.unit.as_ref().map(|u| u.text.clone()),
        unit_from_name: channel.unit.as_ref().is_some_and(|u| u.source == UnitSource::Name),
        values: facts.values,
        missing: facts.missing,
        min: finite(facts.range[0]),
        max: finite(facts.range[1]),
        step: facts.step,
        bits: facts.bits(),
        constant: facts.constant,
        at_min_share: facts.at_end_share[0],
        at_max_share: facts.at_end_share[1],
        wraps: facts.wraps,
        multiple_of,
        rate_of,
        factor,
        not_a_number_in_row: channel.not_a_number.as_ref().map(|(row, _)| *row),
    }
}
