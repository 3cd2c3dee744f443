//! JSON: objects of arrays, arrays of records, and a record on each line.
//!
//! A path of keys joined by `/` names a channel. Lists of numbers inside a record are channels `name[0]`, `name[1]`, ...;
//! records with long lists are groups of channels `runs[0]/t`, `runs[1]/t`, ...

use std::collections::HashMap;

use serde_json::{Map, Value};

use crate::format::Format;
use crate::format_error::FormatError;
use crate::log_data::{Channel, LogData};
use crate::words::WordsBuilder;

/// Most numbers of a list inside a record that become channels.
const MOST_ITEMS: usize = 64;
/// Most names of channels in a list of a note.
const MOST_NAMES: usize = 5;

/// Reads a text; `None` if it is not JSON.
pub(crate) fn read(text: &str) -> Result<Option<LogData>, FormatError> {
    let mut notes = Vec::new();
    let mut channels = match serde_json::from_str::<Value>(text) {
        Ok(value) => of_value(&value),
        Err(error) => {
            let lines: Vec<&str> = text.lines().filter(|l| !l.trim().is_empty()).collect();
            let parsed = |line: &&str| serde_json::from_str::<Value>(line).ok();
            let mut records: Vec<Value> = lines.iter().map_while(parsed).collect();
            if records.len() + 1 == lines.len() && records.len() > 1 {
                notes.push("the last line is incomplete and left out".to_owned());
            } else if records.len() < lines.len() || records.len() < 2 {
                // A bracket alone may begin a text that is no JSON.
                let looks = text.trim_start().starts_with('{') || records.len() > 1;
                return if looks {
                    Err(FormatError::Json { reason: error.to_string() })
                } else {
                    Ok(None)
                };
            }
            records.retain(Value::is_object);
            of_records("", &records)
        }
    };
    if channels.is_empty() {
        return Err(FormatError::NoTable);
    }
    channels.iter_mut().for_each(Channel::take_unit_of_name);
    notes.extend(gaps(&channels));
    Ok(Some(LogData { format: Format::Json, channels, decimal_comma: false, notes }))
}

/// Notes about values that are missing.
fn gaps(channels: &[Channel]) -> Vec<String> {
    let names = |of: &[&Channel]| {
        let first: Vec<&str> = of.iter().take(MOST_NAMES).map(|c| c.name.as_str()).collect();
        let more = if of.len() > first.len() { ", ..." } else { "" };
        first.join(", ") + more
    };
    let has_gaps = |channel: &&Channel| {
        channel.words.is_none() && channel.values.iter().any(|value| value.is_nan())
    };
    let with_gaps: Vec<&Channel> = channels.iter().filter(has_gaps).collect();
    let mut notes = Vec::new();
    if !with_gaps.is_empty() {
        notes.push(format!("values are missing, null or text in {}", names(&with_gaps)));
    }
    let mut lengths: Vec<usize> = channels.iter().map(|channel| channel.values.len()).collect();
    lengths.sort_unstable();
    lengths.dedup();
    if lengths.len() > 1 {
        let of_length = |length: &usize| {
            let of = |channel: &&Channel| channel.values.len() == *length;
            format!("{length} in {}", names(&channels.iter().filter(of).collect::<Vec<_>>()))
        };
        let lengths: Vec<String> = lengths.iter().map(of_length).collect();
        notes.push(format!("the arrays differ in length: {}", lengths.join("; ")));
    }
    notes
}

/// The channels of a document.
fn of_value(value: &Value) -> Vec<Channel> {
    let mut channels = Vec::new();
    collect("", value, &mut channels);
    channels
}

fn joined(path: &str, key: &str) -> String {
    if path.is_empty() { key.to_owned() } else { format!("{path}/{key}") }
}

fn collect(path: &str, value: &Value, channels: &mut Vec<Channel>) {
    match value {
        Value::Object(map) => {
            for (key, value) in map {
                collect(&joined(path, key), value, channels);
            }
        }
        Value::Array(items) if items.iter().any(has_channels) => {
            for (k, item) in items.iter().enumerate() {
                collect(&format!("{path}[{k}]"), item, channels);
            }
        }
        Value::Array(items) if items.iter().any(Value::is_object) => {
            channels.extend(of_records(path, items));
        }
        Value::Array(items) if items.iter().any(Value::is_array) => {
            channels.extend(of_rows(path, items));
        }
        Value::Array(items) if items.len() > 1 && items.iter().any(Value::is_number) => {
            channels.push(Channel::of(path, items.iter().map(number).collect()));
        }
        _ => {}
    }
}

/// Whether a record is a group of channels, and not a row: it has a long list of numbers.
fn has_channels(record: &Value) -> bool {
    let is_long = |value: &Value| {
        value.as_array().is_some_and(|a| a.len() > MOST_ITEMS && a.iter().any(Value::is_number))
    };
    record.as_object().is_some_and(|map| map.values().any(is_long))
}

/// Arrays in an array: each a row of a table, or each a channel if they are long and few.
fn of_rows(path: &str, rows: &[Value]) -> Vec<Channel> {
    let width = rows.iter().filter_map(Value::as_array).map(Vec::len).max().unwrap_or(0);
    let name = |k: usize| format!("{path}[{k}]");
    if width > rows.len() {
        let channel = |(k, row): (usize, &Value)| {
            let values = row.as_array().map_or_else(Vec::new, |r| r.iter().map(number).collect());
            Channel::of(name(k), values)
        };
        return rows.iter().enumerate().map(channel).collect();
    }
    let value = |row: &Value, k: usize| row.get(k).map_or(f64::NAN, number);
    let channel = |k: usize| Channel::of(name(k), rows.iter().map(|r| value(r, k)).collect());
    (0..width).map(channel).collect()
}

/// Records, each with the same keys: a channel for each key with a number.
fn of_records(path: &str, records: &[Value]) -> Vec<Channel> {
    let mut places: HashMap<String, usize> = HashMap::new();
    let mut channels: Vec<Channel> = Vec::new();
    for (row, record) in records.iter().enumerate() {
        let Some(map) = record.as_object() else { continue };
        numbers(path, map, &mut |name, value| {
            let place = *places.entry(name.to_owned()).or_insert_with(|| {
                channels.push(Channel::of(name, vec![f64::NAN; records.len()]));
                channels.len() - 1
            });
            channels[place].values[row] = value;
        });
    }
    channels.extend(words(path, records));
    channels
}

/// Channels of the texts in records, which may name the run or the joint of each.
fn words(path: &str, records: &[Value]) -> Vec<Channel> {
    let mut places: HashMap<&str, usize> = HashMap::new();
    let mut found: Vec<(&str, WordsBuilder, String)> = Vec::new();
    for (row, record) in records.iter().enumerate() {
        let Some(map) = record.as_object() else { continue };
        for (key, value) in map {
            let Some(word) = value.as_str().filter(|word| word.parse::<f64>().is_err()) else {
                continue;
            };
            let place = *places.entry(key).or_insert_with(|| {
                found.push((key, WordsBuilder::default(), word.chars().take(40).collect()));
                found.len() - 1
            });
            found[place].1.push(row, word);
        }
    }
    let channel = |(key, words, first): (&str, WordsBuilder, String)| {
        let words = words.finish(records.len())?;
        let channel = Channel::of(joined(path, key), vec![f64::NAN; records.len()]);
        Some(Channel { words: Some(words), not_a_number: Some((0, first)), ..channel })
    };
    found.into_iter().filter_map(channel).collect()
}

/// Calls `take` for each number in a record.
fn numbers(path: &str, map: &Map<String, Value>, take: &mut impl FnMut(&str, f64)) {
    for (key, value) in map {
        let name = joined(path, key);
        match value {
            Value::Number(_) | Value::Bool(_) => take(&name, number(value)),
            Value::Object(inner) => numbers(&name, inner, take),
            Value::Array(items) if items.len() <= MOST_ITEMS => {
                for (k, item) in items.iter().enumerate().filter(|(_, item)| item.is_number()) {
                    take(&format!("{name}[{k}]"), number(item));
                }
            }
            _ => {}
        }
    }
}

fn number(value: &Value) -> f64 {
    match value {
        Value::Bool(truth) => f64::from(u8::from(*truth)),
        Value::String(text) => text.trim().parse().unwrap_or(f64::NAN),
        other => other.as_f64().unwrap_or(f64::NAN),
    }
}
