//! Data logs of WPILib.

use std::path::Path;

use lissom_formats::{Clock, Format, LogData, read, read_bytes};

fn names(data: &LogData) -> Vec<&str> {
    data.channels.iter().map(|c| c.name.as_str()).collect()
}

fn header() -> Vec<u8> {
    let mut bytes = b"WPILOG\x00\x01".to_vec();
    bytes.extend(5_u32.to_le_bytes());
    bytes.extend(b"extra");
    bytes
}

fn record(entry: u8, stamp_us: u16, payload: &[u8]) -> Vec<u8> {
    let mut bytes = vec![0b001_0000, entry, payload.len() as u8];
    bytes.extend(stamp_us.to_le_bytes());
    bytes.extend(payload);
    bytes
}

fn start(entry: u8, name: &str, of: &str, metadata: &str) -> Vec<u8> {
    let mut payload = vec![0, entry, 0, 0, 0];
    for text in [name, of, metadata] {
        payload.extend((text.len() as u32).to_le_bytes());
        payload.extend(text.as_bytes());
    }
    record(0, 0, &payload)
}

fn finish(entry: u8) -> Vec<u8> {
    record(0, 0, &[1, entry, 0, 0, 0])
}

fn f64_record(entry: u8, stamp_us: u16, values: &[f64]) -> Vec<u8> {
    let payload: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
    record(entry, stamp_us, &payload)
}

#[test]
fn a_log_of_the_library_has_its_entries() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files/small.wpilog");
    let found = read(&path).unwrap();
    assert_eq!(found.format, Format::WpiLog);
    assert_eq!(
        names(&found)[..4],
        ["NT:/double/time", "NT:/double", "NT:/float/time", "NT:/float"]
    );
    assert_eq!(found.channels[0].unit.as_deref(), Some("s"));
    assert_eq!(found.channels[1].unit.as_deref(), Some("A"));
    assert_eq!(found.channels[3].clock, Clock::Channel(2));
    let pose = found.channels.iter().find(|c| c.name == "/pose/at[2]/y").unwrap();
    assert_eq!(pose.values.len(), 12);
    assert!(found.notes[0].starts_with("left out: /unknown (entries of"), "{:?}", found.notes);
}

#[test]
fn values_before_a_restart_are_kept() {
    let log = [
        header(),
        start(1, "a", "double", ""),
        f64_record(1, 1000, &[1.0]),
        finish(1),
        f64_record(1, 1500, &[9.0]),
        start(1, "b", "double", ""),
        start(2, "a", "double", "{\"unit\":\"N\"}"),
        f64_record(1, 2000, &[5.0]),
        f64_record(2, 3000, &[2.0]),
    ];
    let found = read_bytes(log.concat()).unwrap();
    assert_eq!(names(&found), ["a/time", "a", "b/time", "b"]);
    assert_eq!(found.channels[0].values, [0.001, 0.003]);
    assert_eq!(found.channels[1].values, [1.0, 2.0]);
    assert_eq!(found.channels[1].unit.as_deref(), Some("N"));
    assert_eq!(found.channels[3].values, [5.0]);
}

#[test]
fn arrays_of_changing_length_have_gaps() {
    let log = [
        header(),
        start(1, "a", "double[]", ""),
        f64_record(1, 1000, &[1.0]),
        f64_record(1, 2000, &[2.0, 3.0]),
        f64_record(1, 3000, &[]),
    ];
    let found = read_bytes(log.concat()).unwrap();
    assert_eq!(names(&found), ["a/time", "a[1]", "a[2]"]);
    let second = &found.channels[2].values;
    assert!(second[0].is_nan() && second[2].is_nan() && second.len() == 3);
    assert!((second[1] - 3.0).abs() < 1e-12);
}

#[test]
fn a_record_that_is_cut_off_is_left_out_with_a_note() {
    let log = [
        header(),
        start(1, "a", "double", ""),
        f64_record(1, 1000, &[1.0]),
        f64_record(1, 2000, &[2.0]),
        record(1, 2500, &[1, 2]),
        f64_record(1, 3000, &[3.0]),
    ]
    .concat();
    let found = read_bytes(log[..log.len() - 1].to_vec()).unwrap();
    assert_eq!(found.channels[1].values, [1.0, 2.0]);
    assert_eq!(found.notes[0], "the file ends inside a record, which is left out");
    assert!(found.notes[1].starts_with("left out: a (records whose size"), "{:?}", found.notes);
}
