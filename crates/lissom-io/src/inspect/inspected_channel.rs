//! A channel of a log, described by itself.

use lissom_formats::{Channel, Clock};

use super::channel_facts::ChannelFacts;
use super::relations::Relation;
use super::stated_unit::{StatedUnit, stated_unit};
use crate::units::Dimension;
use lissom_formats::bare_name;

/// A channel, described by itself.
#[derive(Debug, Clone)]
pub struct InspectedChannel {
    /// Number of the channel, from 1, as a `campaign.toml` counts.
    pub number: usize,
    /// Its name; empty if the file has no names.
    pub name: String,
    /// Its unit, as the file states it.
    pub unit: Option<StatedUnit>,
    /// What its values show.
    pub facts: ChannelFacts,
    /// How it follows from another channel.
    pub relation: Option<Relation>,
    /// Index of the channel with its time stamps, where the format says so.
    pub time: Option<usize>,
    /// The first cell that is not a number: row and text.
    pub not_a_number: Option<(usize, String)>,
}

impl InspectedChannel {
    /// The channel with this index, without what the others say about it.
    pub(super) fn of(k: usize, channel: &Channel) -> Self {
        Self {
            number: k + 1,
            name: bare_name(&channel.name).to_owned(),
            unit: stated_unit(channel),
            facts: ChannelFacts::of(&channel.values),
            relation: None,
            time: match channel.clock {
                Clock::Channel(time) => Some(time),
                Clock::Unstated | Clock::Even { .. } => None,
            },
            not_a_number: channel.not_a_number.clone(),
        }
    }

    /// Its name, or `column 3` if it has none.
    pub fn label(&self) -> String {
        if self.name.is_empty() { format!("column {}", self.number) } else { self.name.clone() }
    }

    /// Its name, or its number if it has none: what can be asked for.
    pub fn asked(&self) -> String {
        if self.name.is_empty() { self.number.to_string() } else { self.name.clone() }
    }

    /// Dimension of its unit, if it is known.
    pub fn dimension(&self) -> Option<Dimension> {
        self.unit.as_ref()?.known.map(|(_, dimension)| dimension)
    }

    /// Size of its unit in SI, if it is known.
    pub(super) fn size(&self) -> Option<f64> {
        self.unit.as_ref()?.known.map(|(size, _)| size)
    }
}
