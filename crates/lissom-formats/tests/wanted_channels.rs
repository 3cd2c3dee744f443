//! Reading some channels gives what reading all gives: the same names, and for the channels asked for the same values.

#![expect(clippy::unwrap_used, reason = "tests")]

use std::path::{Path, PathBuf};

use lissom_formats::{Channel, ChannelRef, Clock, LogData, ReadOptions, read, read_channels};

/// The files that this build reads: those of the tests, and those of the folder that LISSOM_EXTERNAL names.
fn files() -> Vec<(PathBuf, LogData)> {
    let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files")];
    folders.extend(std::env::var_os("LISSOM_EXTERNAL").map(PathBuf::from));
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_none_or(|end| end != "json" && end != "py") {
                files.extend(read(&path).ok().map(|data| (path, data)));
            }
        }
    }
    files
}

fn same_values(a: &Channel, b: &Channel) -> bool {
    let bits = |channel: &Channel| channel.values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
    bits(a) == bits(b)
}

/// Reads one channel, and compares what was read with the whole file.
#[track_caller]
fn compare(path: &Path, whole: &LogData, asked: &ChannelRef, place: usize) {
    let part = read_channels(path, &ReadOptions::default(), std::slice::from_ref(asked)).unwrap();
    let label = format!("{}: {asked}", path.display());
    assert_eq!(part.notes, whole.notes, "{label}");
    assert_eq!(part.channels.len(), whole.channels.len(), "{label}");
    for (of_part, of_whole) in part.channels.iter().zip(&whole.channels) {
        let name = &of_part.name;
        assert_eq!(name, &of_whole.name, "{label}");
        assert_eq!((&of_part.unit, of_part.clock), (&of_whole.unit, of_whole.clock), "{label}");
        assert!(of_part.values.is_empty() || same_values(of_part, of_whole), "{label}: {name}");
    }
    let clock = match whole.channels[place].clock {
        Clock::Channel(clock) => clock,
        _ => place,
    };
    for place in [place, clock] {
        assert!(same_values(&part.channels[place], &whole.channels[place]), "{label}");
    }
    if let ChannelRef::Number(_) = asked {
        let read = part.channels.iter().enumerate().filter(|(_, c)| !c.values.is_empty());
        assert!(read.map(|(k, _)| k).all(|k| k == place || k == clock), "{label}: others are read");
    }
}

#[test]
fn a_channel_alone_is_as_in_the_whole_file() {
    let files = files();
    assert!(files.len() >= 10);
    for (path, whole) in files {
        for (place, channel) in whole.channels.iter().enumerate() {
            let end = channel.name.rsplit('/').next().unwrap();
            for name in [channel.name.as_str(), end] {
                compare(&path, &whole, &ChannelRef::Name(name.to_owned()), place);
            }
            compare(&path, &whole, &ChannelRef::Number(place + 1), place);
        }
    }
}

#[test]
fn a_name_that_is_not_there_leaves_all_names_and_no_values() {
    for (path, whole) in files() {
        let asked = [ChannelRef::Name("no such channel".to_owned())];
        let part = read_channels(&path, &ReadOptions::default(), &asked).unwrap();
        let names =
            |data: &LogData| data.channels.iter().map(|c| c.name.clone()).collect::<Vec<_>>();
        assert_eq!(names(&part), names(&whole), "{}", path.display());
    }
}
