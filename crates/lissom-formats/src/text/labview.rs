//! LabVIEW measurement files (`.lvm`): segments, each with a header of its own and the next rows of the table.

use super::cells::Separator;
use super::find::find;
use super::stamps::Stamp;
use crate::channel_ref::Wanted;
use crate::format::Format;
use crate::format_error::FormatError;
use crate::log_data::{Channel, Clock, LogData};
use crate::read_options::ReadOptions;

/// First words of a file.
const BEGIN: &str = "LabVIEW Measurement";
/// The last line of a header.
const HEADER_END: &str = "***End_of_Header***";
/// The first cell of the header of a segment.
const SEGMENT: &str = "Channels";

/// Reads a text if it is such a file.
pub(super) fn read(text: &str, options: &ReadOptions) -> Option<Result<LogData, FormatError>> {
    if !text.starts_with(BEGIN) {
        return None;
    }
    // The header of the file ends before the first segment.
    let mut at = text.find(HEADER_END)?;
    let mut places: Vec<usize> = Vec::new();
    for line in text.get(at..)?.split_inclusive('\n') {
        if line.starts_with(SEGMENT) {
            places.push(at);
        }
        at += line.len();
    }
    let ends = places.iter().skip(1).copied().chain([text.len()]);
    let segments = places.iter().zip(ends).filter_map(|(from, end)| text.get(*from..end));
    (!places.is_empty()).then(|| joined(segments, options))
}

/// The channels of all segments, one after the other.
fn joined<'a>(
    segments: impl Iterator<Item = &'a str>,
    options: &ReadOptions,
) -> Result<LogData, FormatError> {
    let mut all: Option<(LogData, Option<Stamp>)> = None;
    for (number, segment) in (1..).zip(segments) {
        let wrong = |reason: &str| FormatError::content(format!("segment {number}"), reason);
        let table = find(segment, 0, options.decimal_comma);
        let table = table.ok_or_else(|| wrong("it has no table of numbers"))?;
        let begin = begin(segment, table.separator);
        let found = table.read(None, Wanted::ALL, None).map_err(|error| match error {
            FormatError::Content { place, reason } => wrong(&format!("{place}: {reason}")),
            other => other,
        })?;
        let found = with_times(found);
        let Some((whole, first)) = &mut all else {
            all = Some((found, begin));
            continue;
        };
        let names =
            |data: &LogData| data.channels.iter().map(|c| c.name.clone()).collect::<Vec<_>>();
        if names(whole) != names(&found) {
            return Err(wrong("its channels are others than those of the first one"));
        }
        let since_s = first.zip(begin).map_or(0.0, |(first, begin)| begin.since_s(first));
        append(whole, found, since_s);
    }
    let (mut whole, _) = all.ok_or(FormatError::NoTable)?;
    whole.format = Format::LabView;
    set_clocks(&mut whole.channels);
    Ok(whole)
}

/// Of several columns of times, each is the clock of the next column; the file states the unit of the first one.
fn set_clocks(channels: &mut [Channel]) {
    if channels.iter().filter(|channel| is_time(channel)).count() < 2 {
        return;
    }
    let unit = channels.iter().find(|channel| is_time(channel)).and_then(|c| c.unit.clone());
    let mut clock = Clock::Unstated;
    for (k, channel) in channels.iter_mut().enumerate() {
        if is_time(channel) {
            clock = Clock::Channel(k);
            channel.unit.clone_from(&unit);
        } else {
            channel.clock = clock;
        }
    }
}

/// The same with its time in a channel.
fn with_times(data: LogData) -> LogData {
    let mut data = data.with_time_stamps();
    data.channels.retain(|channel| channel.values.iter().any(|value| value.is_finite()));
    data.channels.iter_mut().for_each(|channel| channel.clock = Clock::Unstated);
    data.notes.clear();
    data
}

/// When a segment begins.
fn begin(segment: &str, separator: Separator) -> Option<Stamp> {
    let second = |key: &str| {
        let mut rows = segment.lines().map(|line| separator.cells(line));
        let mut cells = rows.find(|cells| cells.clone().next() == Some(key))?;
        cells.find(|cell| cell.starts_with(|c: char| c.is_ascii_digit()))
    };
    Stamp::of(&format!("{} {}", second("Date")?, second("Time")?))
}

/// Appends a segment that begins a time after the first one. Its times may be counted on, or from its begin.
fn append(whole: &mut LogData, segment: LogData, since_s: f64) {
    for (channel, mut next) in whole.channels.iter_mut().zip(segment.channels) {
        let goes_on = channel.values.last() < next.values.first();
        if is_time(channel) && !goes_on {
            next.values.iter_mut().for_each(|value| *value += since_s);
        }
        channel.values.append(&mut next.values);
        channel.not_a_number = channel.not_a_number.take().or(next.not_a_number);
    }
}

fn is_time(channel: &Channel) -> bool {
    matches!(channel.name.as_str(), "X_Value" | "time")
}
