//! Universal files with datasets 58.

use std::path::{Path, PathBuf};

use lissom_formats::{Clock, Format, FormatError, LogData, read, read_bytes};

fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files").join(name)
}

fn names(data: &LogData) -> Vec<&str> {
    data.channels.iter().map(|c| c.name.as_str()).collect()
}

#[test]
fn time_responses_of_text_and_of_bytes_are_read() {
    for file in ["functions.uff", "functions_58b.uff"] {
        let found = read(&path(file)).unwrap();
        assert_eq!(found.format, Format::Uff58);
        assert_eq!(names(&found), ["arm/1-RX", "2[2]/time", "2[2]"]);
        let [first, time, second] = &found.channels[..] else { panic!("three channels") };
        assert_eq!(first.clock, Clock::Even { start_s: 0.25, step_s: 0.004 });
        assert_eq!(first.unit.as_deref(), Some("m/s^2"));
        assert!((first.values[8] - 8_f64.sin()).abs() < 1e-10);
        assert_eq!((time.unit.as_deref(), time.values.len()), (Some("s"), 7));
        assert_eq!((second.clock, second.values.len()), (Clock::Channel(1), 7));
        assert!(
            found.notes[0].starts_with("left out: 2 (frequency responses"),
            "{:?}",
            found.notes
        );
    }
}

#[test]
fn a_file_with_responses_alone_is_an_error() {
    let text = std::fs::read_to_string(path("functions.uff")).unwrap();
    let responses = text.replace("\n    1         0    0", "\n    4         0    0");
    let error = read_bytes(responses.into_bytes()).unwrap_err();
    assert!(matches!(error, FormatError::LeftOut { .. }), "{error}");
}

#[test]
fn a_dataset_that_is_cut_off_keeps_its_values() {
    let text = std::fs::read_to_string(path("functions.uff")).unwrap();
    let cut = text.find("-7.568").unwrap() + 8;
    let found = read_bytes(text.as_bytes()[..cut].to_vec()).unwrap();
    assert_eq!(found.channels[0].values.len(), 4);
    assert_eq!(found.notes, ["arm/1-RX: the dataset ends after 4 of 9 samples"]);
    let damaged = text.replacen("-7.568", "-7,568", 1);
    let found = read_bytes(damaged.into_bytes()).unwrap();
    assert_eq!(names(&found), ["2[2]/time", "2[2]"]);
    assert!(found.notes[0].contains("in row 15 is not a number"), "{:?}", found.notes);
}

#[test]
fn a_table_that_begins_with_minus_one_is_no_universal_file() {
    let found = read_bytes(b"    -1  5\n    58  6\n    59  7\n    60  8\n".to_vec()).unwrap();
    assert_eq!(found.format, Format::Text);
}
