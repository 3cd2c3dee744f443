//! Channels of a file while it is read, and what of the file is left out.

use std::collections::HashSet;

use crate::bytes::MOST_BYTES;
use crate::channel_ref::Wanted;
use crate::format::Format;
use crate::format_error::FormatError;
use crate::log_data::{Channel, Clock, LogData};

/// Most names in a note.
const MOST_NAMES: usize = 5;
/// Most notes of a file.
const MOST_NOTES: usize = 50;

/// Why a part of a file is left out, and how the user can convert it.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct LeftOut {
    /// What the part is, in the plural.
    pub(crate) what: &'static str,
    /// What the user can do.
    pub(crate) way_out: &'static str,
}

/// Names of the parts of a file that are left out for one reason.
#[derive(Debug, Default)]
struct Names {
    first: Vec<String>,
    all: HashSet<String>,
}

impl Names {
    /// The first names, and the number of others.
    fn listed(&self) -> String {
        match self.all.len() - self.first.len() {
            0 => self.first.join(", "),
            more => format!("{} and {more} more", self.first.join(", ")),
        }
    }
}

/// The channels of a file while it is read.
#[derive(Debug)]
pub(crate) struct Collected<'a> {
    pub(crate) channels: Vec<Channel>,
    /// The channels whose values are read.
    pub(crate) wanted: Wanted<'a>,
    notes: Vec<String>,
    left_out: Vec<(&'static LeftOut, Names)>,
    /// The bytes that the file may still take in memory.
    budget: u64,
}

impl<'a> Collected<'a> {
    /// With the values of all channels.
    pub(crate) fn new() -> Self {
        Self::of(Wanted::ALL)
    }

    /// With the values of these channels, and their time stamps.
    pub(crate) fn of(wanted: Wanted<'a>) -> Self {
        let (channels, notes, left_out) = (Vec::new(), Vec::new(), Vec::new());
        Self { channels, wanted, notes, left_out, budget: MOST_BYTES }
    }

    /// Reads all values from now on. Returns what was wanted before.
    pub(crate) fn want_all(&mut self) -> Wanted<'a> {
        std::mem::replace(&mut self.wanted, Wanted::ALL)
    }

    /// Counts bytes that a part of the file takes in memory: compressed files, and numbers of few bits, become larger than
    /// the file.
    ///
    /// # Errors
    /// [`FormatError::TooLarge`] if the file becomes too large.
    pub(crate) fn take_bytes(&mut self, bytes: usize) -> Result<(), FormatError> {
        match self.budget.checked_sub(bytes as u64) {
            Some(left) => {
                self.budget = left;
                Ok(())
            }
            None => Err(FormatError::TooLarge { most: MOST_BYTES }),
        }
    }

    /// Counts bytes that are no longer in memory.
    pub(crate) fn release_bytes(&mut self, bytes: usize) {
        self.budget = self.budget.saturating_add(bytes as u64).min(MOST_BYTES);
    }

    /// Notes something once.
    pub(crate) fn note(&mut self, note: impl Into<String>) {
        let note = note.into();
        if self.notes.len() < MOST_NOTES && !self.notes.contains(&note) {
            self.notes.push(note);
        }
    }

    /// Leaves out a part of the file.
    pub(crate) fn leave_out(&mut self, name: &str, why: &'static LeftOut) {
        let place = self.left_out.iter().position(|(reason, _)| *reason == why);
        let place = place.unwrap_or_else(|| {
            self.left_out.push((why, Names::default()));
            self.left_out.len() - 1
        });
        let Some((_, names)) = self.left_out.get_mut(place) else { return };
        if !names.all.contains(name) {
            names.all.insert(name.to_owned());
            if names.first.len() < MOST_NAMES {
                names.first.push(name.to_owned());
            }
        }
    }

    /// The content of the file.
    ///
    /// # Errors
    /// [`FormatError::LeftOut`] if all that the file contains is left out; [`FormatError::NoTable`] if it contains nothing.
    pub(crate) fn finish(mut self, format: Format) -> Result<LogData, FormatError> {
        if self.channels.is_empty() {
            let Some((why, names)) = self.left_out.first() else {
                return Err(match self.notes.into_iter().next() {
                    Some(note) => FormatError::content("no channel can be read", note),
                    None => FormatError::NoTable,
                });
            };
            let what = format!("{} ({})", why.what, names.listed());
            return Err(FormatError::LeftOut { what, way_out: why.way_out });
        }
        for (why, names) in &self.left_out {
            let names = names.listed();
            self.notes.push(format!("left out: {names} ({}); {}", why.what, why.way_out));
        }
        let Self { mut channels, wanted, notes, .. } = self;
        drop_unwanted(&mut channels, wanted);
        // In brackets at the end of a name of MCAP is the name of a joint.
        if format != Format::Mcap {
            channels.iter_mut().for_each(Channel::take_unit_of_name);
        }
        Ok(LogData { format, channels, decimal_comma: false, notes })
    }
}

/// Drops the values of channels that are neither wanted nor time stamps of one that is: some were read before their name or
/// number was known.
pub(crate) fn drop_unwanted(channels: &mut [Channel], wanted: Wanted) {
    let is_wanted = |(k, channel): (usize, &Channel)| wanted.has_at(&channel.name, Some(k + 1));
    let mut kept: Vec<bool> = channels.iter().enumerate().map(is_wanted).collect();
    for (k, channel) in channels.iter().enumerate() {
        if let Clock::Channel(clock) = channel.clock
            && is_wanted((k, channel))
            && let Some(kept) = kept.get_mut(clock)
        {
            *kept = true;
        }
    }
    for (channel, _) in channels.iter_mut().zip(kept).filter(|(_, kept)| !kept) {
        channel.values = Vec::new();
    }
}
