//! Files that other people's libraries wrote, in the folder that LISSOM_EXTERNAL names: `external/write.py` writes it.

#![expect(clippy::unwrap_used, clippy::print_stdout, reason = "tests")]

use std::path::{Path, PathBuf};

use lissom_formats::{Channel, Clock, LogData, read};
use serde_json::Value;

/// Largest relative difference of two values: those of scaled and of text files are rounded.
const ROUNDING: f64 = 1e-12;

fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(files(&path));
        } else if path.extension().is_none_or(|e| e != "json" && e != "py") {
            found.push(path);
        }
    }
    found.sort();
    found
}

fn number(value: &Value) -> f64 {
    match value {
        Value::String(text) => text.parse().unwrap(),
        other => other.as_f64().unwrap(),
    }
}

fn same(found: f64, wanted: f64) -> bool {
    found.to_bits() == wanted.to_bits()
        || (found.is_nan() && wanted.is_nan())
        || (found - wanted).abs() <= ROUNDING * wanted.abs()
}

fn same_clock(data: &LogData, clock: Clock, wanted: &Value) -> bool {
    match (clock, wanted) {
        (Clock::Unstated, Value::Null) => true,
        (Clock::Channel(k), Value::String(name)) => data.channels[k].name == *name,
        (Clock::Even { start_s, step_s }, Value::Array(pair)) => {
            same(start_s, number(&pair[0])) && same(step_s, number(&pair[1]))
        }
        _ => false,
    }
}

/// What is wrong with a channel.
fn compared(data: &LogData, found: &Channel, wanted: &Value) -> Result<(), String> {
    let name = &found.name;
    let same_text = |text: Option<&str>, key: &str| text == wanted[key].as_str();
    if !same_text(Some(name), "name") || !same_text(found.unit.as_deref(), "unit") {
        return Err(format!("{name} {:?}: {} {}", found.unit, wanted["name"], wanted["unit"]));
    }
    let values = wanted["values"].as_array().unwrap();
    if values.len() != found.values.len() {
        return Err(format!("{name}: {} values, not {}", found.values.len(), values.len()));
    }
    for (k, (value, wanted)) in found.values.iter().zip(values).enumerate() {
        if !same(*value, number(wanted)) {
            return Err(format!("{name}: value {k} is {value}, not {wanted}"));
        }
    }
    if !same_clock(data, found.clock, &wanted["clock"]) {
        return Err(format!("{name}: clock {:?}, not {}", found.clock, wanted["clock"]));
    }
    Ok(())
}

/// The number of channels of a file that were compared.
fn compare(file: &Path) -> Result<usize, String> {
    let mut beside = file.as_os_str().to_owned();
    beside.push(".json");
    let text = std::fs::read_to_string(beside).map_err(|e| e.to_string())?;
    let wanted: Value = serde_json::from_str(&text).map_err(|e| e.to_string())?;
    let channels = wanted["channels"].as_array().unwrap();
    let data = match read(file) {
        Ok(data) => data,
        Err(_) if channels.is_empty() => return Ok(0),
        Err(error) => return Err(format!("{error}; {}", error.hint())),
    };
    if data.channels.len() != channels.len() {
        let names: Vec<&str> = data.channels.iter().map(|c| c.name.as_str()).collect();
        return Err(format!("{} channels, not {}: {names:?}", names.len(), channels.len()));
    }
    for (found, wanted) in data.channels.iter().zip(channels) {
        compared(&data, found, wanted)?;
    }
    let note = wanted["note"].as_str();
    if note.is_some_and(|note| !data.notes.iter().any(|n| n.contains(note))) {
        return Err(format!("no note {note:?}: {:?}", data.notes));
    }
    Ok(channels.len())
}

#[test]
fn files_of_other_libraries_have_their_channels() {
    let Ok(folder) = std::env::var("LISSOM_EXTERNAL") else {
        println!("LISSOM_EXTERNAL is not set: tests/external/write.py writes such a folder");
        return;
    };
    let (mut count, mut channels, mut wrong) = (0, 0, Vec::new());
    for file in files(Path::new(&folder)) {
        count += 1;
        match compare(&file) {
            Ok(compared) => channels += compared,
            Err(reason) => wrong.push(format!("{}: {reason}", file.display())),
        }
    }
    println!("{count} files, {channels} channels compared");
    assert!(wrong.is_empty(), "{} files differ:\n{}", wrong.len(), wrong.join("\n"));
}
