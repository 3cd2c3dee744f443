//! MCAP files.

#![cfg(feature = "mcap")]
#![expect(clippy::unwrap_used, reason = "tests")]

mod samples;

use std::path::{Path, PathBuf};

use lissom_formats::{Clock, Format, read_bytes};

use samples::{names, sample};

fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files").join(name)
}

const NAMES: [&str; 8] = [
    "/joint_states/time",
    "/joint_states/position[wrist]",
    "/joint_states/position[elbow]",
    "/joint_states/effort[wrist]",
    "/joint_states/effort[elbow]",
    "/command/time",
    "/command/data",
    "/command/on",
];

#[test]
fn joints_are_named_whatever_their_order() {
    for name in ["chunks_zstd.mcap", "chunk_lz4.mcap", "no_end.mcap"] {
        let found = sample(name);
        assert_eq!(found.format, Format::Mcap);
        assert_eq!(names(&found), NAMES, "{name}");
        let wrist = &found.channels[1].values;
        assert_eq!(wrist[..4], [0.25, -1.0, 2.25, -3.0]);
        assert_eq!(found.channels[6].values[7].to_bits(), 3.5_f64.to_bits());
        assert_eq!(found.channels[2].clock, Clock::Channel(0));
        assert_eq!(found.channels[7].clock, Clock::Channel(5));
    }
}

#[test]
fn times_keep_their_nanoseconds() {
    let found = sample("chunk_lz4.mcap");
    let [stamps, logged] = [0, 5].map(|k: usize| &found.channels[k]);
    assert_eq!(stamps.unit.as_deref(), Some("s"));
    assert_eq!(stamps.values[..2], [0.0, 0.002]);
    assert_eq!(logged.values[..2], [0.000_001, 0.002_001]);
}

#[test]
fn a_file_without_an_end_is_read_with_a_note() {
    let found = sample("no_end.mcap");
    assert!(found.notes[0].starts_with("the file has no end"), "{:?}", found.notes);
    assert!(sample("chunk_lz4.mcap").notes.is_empty());
}

#[test]
fn a_chunk_with_a_wrong_checksum_is_left_out_with_a_note() {
    let mut bytes = std::fs::read(path("chunks_zstd.mcap")).unwrap();
    let zstd = bytes.windows(4).rposition(|window| window == b"\x28\xb5\x2f\xfd").unwrap();
    bytes[zstd + 40] ^= 0x10;
    let found = read_bytes(bytes).unwrap();
    assert!(found.channels[0].values.len() < 8);
    assert!(found.notes[0].starts_with("the chunk at byte "), "{:?}", found.notes);
}

#[test]
fn messages_of_a_chunk_that_is_cut_off_are_kept() {
    let bytes = std::fs::read(path("chunk_lz4.mcap")).unwrap();
    let found = read_bytes(bytes[..bytes.len() / 2].to_vec());
    let no_end = std::fs::read(path("no_end.mcap")).unwrap();
    let shorter = read_bytes(no_end[..no_end.len() - 200].to_vec()).unwrap();
    assert!((1..8).contains(&shorter.channels[0].values.len()));
    // A block of LZ4 that is not whole has no messages: an error or a note, and no wrong value.
    assert!(found.is_err() || !found.unwrap().notes.is_empty());
}
