//! A log, described before anything is known about it.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use lissom_core::identify::is_possible_sample_time;
use lissom_formats::{Channel, Format, LogData, ReadOptions, bare_name};

use super::clock_facts::ClockFacts;
use super::draft_error::DraftError;
use super::inspected_channel::InspectedChannel;
use super::relations::{MOST_CHANNELS, Relation, relation};
use super::roles::{Guess, Role, Roles, looks_like_time};
use super::row_labels::RowLabels;
use super::stated_unit::{StatedUnit, stated_unit};
use crate::io_error::Error;
use crate::log::{LogPath, alike_groups, all_groups};

/// Share by which the factor of a rate may differ from that of the stated units.
const UNITS_AGREE: f64 = 0.1;

/// A log, described before anything is known about it.
#[derive(Debug, Clone)]
pub struct Inspection {
    /// The file.
    pub file: PathBuf,
    /// Its format.
    pub format: Format,
    /// Whether numbers have a decimal comma.
    pub decimal_comma: bool,
    /// The channels, in the order of the file.
    pub channels: Vec<InspectedChannel>,
    /// The clock that most channels use, or that the time stamps give.
    pub clock: Option<ClockFacts>,
    /// The column that tells which run, or which joint, each row is of.
    pub labels: Option<RowLabels>,
    /// Paths of groups that have channels of the same names, and may be runs.
    pub groups: Vec<String>,
    /// Which channel is probably what.
    pub roles: Roles,
    /// What was left out while the file was read, and what does not agree, in words.
    pub notes: Vec<String>,
    /// The content of the file.
    pub data: LogData,
}

/// Reads a log of any format and describes it.
///
/// # Errors
/// [`Error::Log`] if the file cannot be read, is of a format that is not read, or has no table of numbers.
pub fn inspect(path: &Path) -> Result<Inspection, Error> {
    inspect_with(path, &ReadOptions::default())
}

/// Reads a log whose header, decimal sign or first row are stated, and describes it.
///
/// # Errors
/// As [`inspect`].
pub fn inspect_with(path: &Path, options: &ReadOptions) -> Result<Inspection, Error> {
    inspect_content(path, LogPath::of(path).read(options)?)
}

/// Describes the log at a path, whose file has this content: [`LogPath::read`] reads it once for several runs of the file.
///
/// # Errors
/// [`Error::Log`] if no group of the file fits.
pub fn inspect_content(path: &Path, content: Arc<LogData>) -> Result<Inspection, Error> {
    let mut parts = LogPath::of(path).parts_of(content)?;
    let groups: Vec<String> = parts.iter().map(|part| part.name.clone()).collect();
    let mut found = of_data(path, Arc::unwrap_or_clone(parts.swap_remove(0).data));
    if groups.len() > 1 {
        let groups = groups.join(", ");
        found.notes.push(format!("the groups {groups} fit; this is the first of them"));
    }
    if let [first, ..] = &found.groups[..] {
        found.notes.push(format!(
            "channels of the same name are in the groups {}: if these are runs, give the log as \"{}::{}\", or one of them as \
             \"{}::{}\"",
            found.groups.join(", "),
            path.display(),
            all_groups(&found.data),
            path.display(),
            first
        ));
    }
    Ok(found)
}

/// Describes a log in memory, which is called `name`.
pub fn inspect_data(name: &str, data: LogData) -> Inspection {
    of_data(Path::new(name), data.with_time_stamps())
}

fn of_data(path: &Path, data: LogData) -> Inspection {
    let all = data.channels.iter().enumerate();
    let mut channels: Vec<InspectedChannel> =
        all.map(|(k, channel)| InspectedChannel::of(k, channel)).collect();
    let stamps = looks_like_time(&channels, &data);
    let time = stamps.as_ref().map(|guess| guess.channel);
    relate(&mut channels, &data, time);
    let clock = time.and_then(|k| ClockFacts::of(&data.channels[k].values));
    let labels = RowLabels::of(&data, &channels, time);
    let roles = Roles::guessed(&channels, stamps);
    let mut notes = data.notes.clone();
    notes.extend(contradictions(&channels, clock.as_ref(), time));
    let file = path.display().to_string();
    notes.extend(labels.iter().map(|found| found.note(&channels[found.channel].asked(), &file)));
    Inspection {
        file: path.to_owned(),
        format: data.format,
        decimal_comma: data.decimal_comma,
        channels,
        clock,
        labels,
        groups: alike_groups(&data).unwrap_or_default(),
        roles,
        notes,
        data,
    }
}

/// Finds channels that follow from another one.
fn relate(channels: &mut [InspectedChannel], data: &LogData, time: Option<usize>) {
    if channels.len() > MOST_CHANNELS {
        return;
    }
    let values = |k: usize| &data.channels[k].values[..];
    let usable = |c: &InspectedChannel| !c.facts.constant && c.not_a_number.is_none();
    for k in 0..channels.len() {
        if Some(k) == time || !usable(&channels[k]) {
            continue;
        }
        let stamps = channels[k].time.or(time).map(values).filter(|t| t.len() == values(k).len());
        let multiples = (0..k).filter(|j| Some(*j) != time);
        let others: Vec<(usize, &[f64])> = multiples
            .chain(k + 1..channels.len())
            .filter(|j| Some(*j) != time && usable(&channels[*j]))
            .filter(|j| values(*j).len() == values(k).len())
            .map(|j| (j, values(j)))
            .collect();
        channels[k].relation = match relation(values(k), &others, stamps) {
            // Of two multiples the later one follows from the earlier one.
            Some(Relation::Multiple { of, .. }) if of > k => None,
            found => found,
        };
    }
}

/// What the data say against the stated units.
fn contradictions(
    channels: &[InspectedChannel],
    clock: Option<&ClockFacts>,
    time: Option<usize>,
) -> Vec<String> {
    let mut notes = Vec::new();
    let unit_s = time.and_then(|k| channels[k].size());
    if let (Some(clock), Some(unit_s), Some(k)) = (clock, unit_s, time) {
        let step_s = clock.step * unit_s;
        if !is_possible_sample_time(step_s) {
            notes.push(format!(
                "with the unit of {} as stated, samples are {step_s:.3e} s apart, which no log of a drive is: the unit of \
                 the time stamps is probably another one",
                channels[k].label()
            ));
        }
    }
    let Some(unit_s) = unit_s else { return notes };
    for channel in channels {
        let Some(Relation::Rate { of, factor }) = channel.relation else { continue };
        let (Some(speed), Some(angle)) = (channel.size(), channels[of].size()) else { continue };
        let ratio = factor * speed * unit_s / angle;
        if (ratio - 1.0).abs() > UNITS_AGREE {
            notes.push(format!(
                "{} is the rate of {}, but with the stated units it is {ratio:.4} times as large: one of the units, or that \
                 of the time stamps, is wrong",
                channel.label(),
                channels[of].label()
            ));
        }
    }
    notes
}

impl Inspection {
    /// Refuses another log, whose file has this content, if a channel of the same name has another unit in one of its runs.
    ///
    /// # Errors
    /// [`DraftError::OtherUnit`] with the first such channel; [`Error::Log`] if no group of the file fits.
    pub fn same_units(&self, other: &Path, content: Arc<LogData>) -> Result<(), Error> {
        let text = |unit: Option<StatedUnit>| unit.map(|u| u.text);
        let parts = LogPath::of(other).parts_of(content)?;
        let named = self.channels.iter().filter(|c| !c.name.is_empty());
        for (channel, part) in named.flat_map(|c| parts.iter().map(move |part| (c, part))) {
            let named = |c: &&Channel| bare_name(&c.name) == channel.name;
            let Some(same) = part.data.channels.iter().find(named) else { continue };
            let (unit, of_other) = (text(channel.unit.clone()), text(stated_unit(same)));
            if unit != of_other {
                let stated = |unit: Option<String>| unit.unwrap_or_else(|| "not stated".to_owned());
                return Err(Error::Draft(DraftError::OtherUnit {
                    file: part.label.clone(),
                    channel: channel.name.clone(),
                    unit: stated(of_other),
                    of_first: format!("in {} it is {}", self.file.display(), stated(unit)),
                }));
            }
        }
        Ok(())
    }

    /// The guess for a role.
    pub fn guess(&self, role: Role) -> Option<&Guess> {
        self.roles.of(role)
    }
}
