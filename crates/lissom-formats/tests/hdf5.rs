//! HDF5 files and MATLAB files of version 7.3.

#![cfg(feature = "hdf5")]
#![expect(clippy::unwrap_used, reason = "tests")]

mod samples;

use lissom_formats::{Clock, Format};

use samples::{names, sample};

#[test]
fn datasets_have_the_path_of_their_groups() {
    let found = sample("groups.h5");
    assert_eq!(found.format, Format::Hdf5);
    let wanted =
        ["again", "record/on", "record/p[1]", "record/p[2]", "run/theta[1]", "run/theta[2]"];
    assert_eq!(names(&found), wanted);
    assert_eq!(found.channels[0].unit.as_deref(), Some("s"));
    assert_eq!(found.channels[0].values.len(), 40);
    assert_eq!(found.channels[1].values, [1.0, 0.0, 1.0]);
    assert_eq!(found.channels[3].values, [2.0, 4.0, -6.0]);
    assert_eq!(found.channels[5].unit.as_deref(), Some("rad"));
}

#[test]
fn links_that_lead_back_are_not_followed_again() {
    let found = sample("groups.h5");
    let note = found.notes.iter().find(|note| note.contains("further names")).unwrap();
    assert!(note.starts_with("left out: t, "), "{note}");
}

#[test]
fn chunks_of_the_newer_format_are_read() {
    let found = sample("chunks_v110.h5");
    assert_eq!(names(&found), ["x", "y[1]", "y[2]"]);
    assert_eq!(found.channels[0].values[29].to_bits(), 29_f64.to_bits());
    assert_eq!(found.channels[2].values, [1.0, 3.0, 5.0, 7.0, 9.0, 11.0]);
    assert!(found.notes.is_empty(), "{:?}", found.notes);
}

#[test]
fn structs_of_matlab_7_3_are_read_as_those_of_earlier_versions() {
    let found = sample("structs_v73.mat");
    assert_eq!(found.format, Format::Matlab);
    let wanted = [
        "c[1]",
        "log/signals/values[1]",
        "log/signals/values[2]",
        "log/time",
        "run/rate",
        "run[1]/theta",
        "run[2]/theta",
        "z/real",
        "z/imag",
    ];
    assert_eq!(names(&found), wanted);
    assert_eq!(found.channels[1].unit.as_deref(), Some("rad"));
    assert_eq!(found.channels[1].clock, Clock::Channel(3));
    assert_eq!(found.channels[6].values, [0.0, 2.0, 4.0, 6.0]);
    assert_eq!([&found.channels[7].values, &found.channels[8].values], [&[1.0], &[2.0]]);
    assert!(found.notes.is_empty(), "{:?}", found.notes);
}
