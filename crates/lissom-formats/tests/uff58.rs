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
            found.notes[0].starts_with("left out: 2 (functions of neither"),
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

#[test]
fn functions_of_the_frequency_have_their_frequencies_and_two_parts() {
    for file in ["responses.uff", "responses_58b.uff"] {
        let found = read(&path(file)).unwrap();
        let wanted = [
            "frequency",
            "2+Z/real",
            "2+Z/imag",
            "3+Z/real",
            "3+Z/imag",
            "2+Z[2]/frequency",
            "2+Z[2]/real",
            "2+Z[2]/imag",
            "2+Z[3]",
        ];
        assert_eq!(names(&found), wanted);
        let units: Vec<Option<&str>> = found.channels.iter().map(|c| c.unit.as_deref()).collect();
        assert_eq!(units[..3], [Some("Hz"), Some("m/s^2/N"), Some("m/s^2/N")]);
        assert_eq!((units[5], units[8]), (Some("Hz"), Some("m/s^2")));
        let values = |k: usize| &found.channels[k].values;
        for (k, f) in values(0).iter().enumerate() {
            assert!((f - 0.5 - 0.25 * k as f64).abs() < 1e-9);
            // 1/(a + ib) at this frequency.
            let (a, b) = (1.0 - (f / 1.2).powi(2), 0.1 * f);
            let size = a * a + b * b;
            assert!(
                (values(1)[k] - a / size).abs() < 1e-9 && (values(2)[k] + b / size).abs() < 1e-9
            );
            assert!((values(3)[k] - 2.0 * values(1)[k]).abs() < 1e-9);
        }
        assert_eq!(values(6).len(), 5);
        assert!((values(7)[3] - 1.9).abs() < 1e-6 && (values(5)[3] - 1.9).abs() < 1e-6);
        assert!((values(8)[8] - 0.9).abs() < 1e-9);
        assert!(
            found.channels.iter().all(|c| c.clock == Clock::Unstated) && found.notes.is_empty()
        );
    }
}
