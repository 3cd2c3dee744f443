//! MATLAB files of versions 4 to 7.

#![expect(clippy::unwrap_used, reason = "tests")]

mod samples;

use lissom_formats::{Clock, Format, FormatError, read_bytes};

use samples::{names, sample};

fn header(big_endian: bool) -> Vec<u8> {
    let mut bytes = b"MATLAB 5.0 MAT-file".to_vec();
    bytes.resize(124, b' ');
    bytes.extend(if big_endian { *b"\x01\x00MI" } else { *b"\x00\x01IM" });
    bytes
}

/// A data element.
fn element(kind: u32, data: &[u8], big_endian: bool) -> Vec<u8> {
    let word = |word: u32| if big_endian { word.to_be_bytes() } else { word.to_le_bytes() };
    let mut bytes = [word(kind), word(data.len() as u32)].concat();
    bytes.extend(data);
    bytes.resize(bytes.len().next_multiple_of(8), 0);
    bytes
}

fn words(words: &[u32], big_endian: bool) -> Vec<u8> {
    let bytes = |w: &u32| if big_endian { w.to_be_bytes() } else { w.to_le_bytes() };
    words.iter().flat_map(bytes).collect()
}

/// An array of a class with its content behind the name.
fn matrix(class: u32, lengths: &[u32], name: &str, content: &[u8], big_endian: bool) -> Vec<u8> {
    let parts = [
        element(6, &words(&[class, 0], big_endian), big_endian),
        element(5, &words(lengths, big_endian), big_endian),
        element(1, name.as_bytes(), big_endian),
        content.to_vec(),
    ];
    element(14, &parts.concat(), big_endian)
}

/// An object of a class.
fn object(name: &str, class: &str) -> Vec<u8> {
    let parts = [
        element(6, &words(&[17, 0], false), false),
        element(1, name.as_bytes(), false),
        element(1, b"MCOS", false),
        element(1, class.as_bytes(), false),
        element(14, &[], false),
    ];
    element(14, &parts.concat(), false)
}

#[test]
fn structs_struct_arrays_and_cells_are_paths() {
    for file in ["structs_v6.mat", "structs_v7.mat"] {
        let found = sample(file);
        assert_eq!(found.format, Format::Matlab);
        let paths = [
            "t",
            "log/data[1]",
            "log/data[2]",
            "log/sub/on",
            "run/rate",
            "run[1]/theta",
            "run[2]/theta",
            "run[3]/theta",
            "c[1]",
            "z/real",
            "z/imag",
            "n",
        ];
        assert_eq!(names(&found), paths);
        assert!((found.channels[1].values[1] - 0.29552).abs() < 1e-12);
        assert!((found.channels[3].values[1] - 1.0).abs() < 1e-12);
        assert!((found.channels[4].values[2] - 5.0).abs() < 1e-12);
        assert_eq!(found.channels[9].values, [0.0, 2.0]);
        assert_eq!(found.channels[10].values, [1.0, 0.0]);
        assert!((found.channels[11].values[1] + 2.0).abs() < 1e-12);
        assert_eq!(found.channels[2].unit.as_deref(), Some("rad"));
        assert_eq!(found.channels[3].unit, None);
        assert!(found.notes.is_empty(), "{:?}", found.notes);
    }
}

#[test]
fn a_structure_with_time_has_its_clock() {
    let found = sample("simulink.mat");
    assert_eq!(names(&found), ["out/time", "out/signals/values[1]", "out/signals/values[2]"]);
    assert_eq!(found.channels[2].clock, Clock::Channel(0));
    assert_eq!(found.channels[0].clock, Clock::Unstated);
}

#[test]
fn a_file_of_version_4_is_read() {
    let found = sample("v4.mat");
    assert_eq!(names(&found), ["t", "data[1]", "data[2]", "n"]);
    assert!((found.channels[0].values[39] - 0.078).abs() < 1e-12);
    assert!((found.channels[3].values[39] - 39.0).abs() < 1e-12);
}

#[test]
fn both_byte_orders_are_read() {
    for big_endian in [false, true] {
        let values = [1.5_f64, -2.5, 1e300];
        let bytes = |v: &f64| if big_endian { v.to_be_bytes() } else { v.to_le_bytes() };
        let data: Vec<u8> = values.iter().flat_map(bytes).collect();
        let x = matrix(6, &[3, 1], "x", &element(9, &data, big_endian), big_endian);
        let found = read_bytes([header(big_endian), x].concat()).unwrap();
        assert_eq!(names(&found), ["x"]);
        assert_eq!(found.channels[0].values, values);
    }
}

#[test]
fn objects_are_named_with_the_lines_that_convert_them() {
    let x = matrix(9, &[1, 2], "x", &element(2, &[1, 2], false), false);
    let table = object("T", "table");
    let found = read_bytes([header(false), table.clone(), x].concat()).unwrap();
    assert_eq!(names(&found), ["x"]);
    assert!(found.notes[0].contains("T (MATLAB tables)"), "{:?}", found.notes);
    assert!(found.notes[0].contains("table2struct(T, \"ToScalar\", true)"), "{:?}", found.notes);
    let error = read_bytes([header(false), table].concat()).unwrap_err();
    assert!(matches!(error, FormatError::LeftOut { .. }), "{error}");
    assert!(error.hint().contains("table2struct"), "{}", error.hint());
    let error = read_bytes([header(false), object("TT", "timetable")].concat()).unwrap_err();
    assert!(error.hint().contains("RowTimes"), "{}", error.hint());
}

#[test]
fn deep_nesting_and_large_counts_end() {
    let mut inner = matrix(6, &[1, 2], "", &element(2, &[1, 2], false), false);
    for _ in 0..200 {
        inner = matrix(1, &[1, 1], "c", &inner, false);
    }
    let error = read_bytes([header(false), inner].concat()).unwrap_err();
    assert!(error.to_string().contains("nested too deep"), "{error}");
    let cells = matrix(1, &[u32::MAX, u32::MAX, u32::MAX], "c", &[], false);
    assert!(read_bytes([header(false), cells].concat()).is_err());
    let none = [element(5, &words(&[32], false), false), element(1, &[], false)].concat();
    let no_fields = matrix(2, &[u32::MAX, 1], "s", &none, false);
    assert!(read_bytes([header(false), no_fields].concat()).is_err());
}

#[test]
#[cfg(not(feature = "hdf5"))]
fn a_build_without_the_feature_names_a_file_of_version_7_3() {
    let mut bytes = b"MATLAB 7.3 MAT-file, Platform: GLNXA64".to_vec();
    bytes.resize(124, b' ');
    bytes.extend(b"\x00\x02IM");
    let error = read_bytes(bytes).unwrap_err();
    assert!(error.to_string().contains("version 7.3 (HDF5)"), "{error}");
    assert!(error.hint().contains("--features full"), "{}", error.hint());
}
