//! TDMS files.

#![expect(clippy::unwrap_used, reason = "tests")]

mod samples;

use std::path::Path;

use lissom_formats::{Clock, Format, FormatError, read_bytes};

use samples::{names, sample};

#[test]
fn channels_of_all_segments_are_joined() {
    let found = sample("segments.tdms");
    assert_eq!(found.format, Format::Tdms);
    assert_eq!(names(&found), ["motor/i", "motor/raw", "motor/when"]);
    let [i, raw, when] = &found.channels[..] else { panic!("three channels") };
    assert_eq!(i.clock, Clock::Even { start_s: 0.5, step_s: 0.002 });
    assert_eq!((i.unit.as_deref(), when.unit.as_deref()), (Some("A"), Some("s")));
    assert_eq!((i.values.len(), when.values.len()), (40, 12));
    assert!((i.values[39] - 39_f64.sin()).abs() < 1e-6);
    assert!((when.values[11] - 0.022).abs() < 1e-9);
    // Its scale is 1 + raw/2.
    assert!((raw.values[30] - 16.0).abs() < 1e-12);
    assert!(found.notes[0].starts_with("left out: motor/z (complex numbers)"), "{:?}", found.notes);
}

#[test]
fn interleaved_raw_data_are_read() {
    let found = sample("interleaved.tdms");
    assert_eq!(names(&found), ["g/a", "g/b"]);
    assert_eq!(found.channels[1].values.len(), 30);
    assert!((found.channels[0].values[29] - 14_f64.cos()).abs() < 1e-12);
    assert!((found.channels[1].values[17] + 2.0).abs() < 1e-12);
}

#[test]
fn raw_data_of_daqmx_are_read() {
    let found = sample("daqmx.tdms");
    assert_eq!(names(&found), ["Group/i", "Group/u", "Group/q"]);
    let lengths: Vec<usize> = found.channels.iter().map(|c| c.values.len()).collect();
    assert_eq!(lengths, [16, 16, 12]);
    assert!((found.channels[0].values[15] + 7.0).abs() < 1e-12);
    assert!((found.channels[1].values[9] - 60001.0).abs() < 1e-12);
    assert!((found.channels[2].values[11] - 2.5).abs() < 1e-12);
    assert!(found.notes[0].starts_with("left out: Group/two (channels of NI-DAQmx"));
}

#[test]
fn a_segment_that_was_not_finished_keeps_its_values() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files/interleaved.tdms");
    let mut bytes = std::fs::read(path).unwrap();
    bytes[12..20].fill(0xff);
    bytes.truncate(bytes.len() - 280);
    let found = read_bytes(bytes).unwrap();
    assert!(found.notes[0].starts_with("segment 1 was not finished"), "{:?}", found.notes);
    assert_eq!(found.channels[0].values.len(), 9);
}

#[test]
fn a_file_without_values_is_an_error() {
    let mut bytes = b"TDSm\x0e\x00\x00\x00\x69\x12\x00\x00".to_vec();
    assert!(matches!(read_bytes(bytes.clone()), Err(FormatError::Content { .. })));
    bytes.extend(4_u64.to_le_bytes());
    bytes.extend(4_u64.to_le_bytes());
    bytes.extend(0_u32.to_le_bytes());
    assert!(matches!(read_bytes(bytes), Err(FormatError::NoTable)));
}
