//! Arrays of NumPy.

#![expect(clippy::unwrap_used, reason = "tests")]

mod samples;

use lissom_formats::{Format, FormatError, read_bytes};

use samples::{names, sample};

/// An array with this header.
fn array(version: u8, header: &str, content: &[u8]) -> Vec<u8> {
    let mut bytes = b"\x93NUMPY".to_vec();
    bytes.extend([version, 0]);
    let length = header.len() as u32;
    match version {
        1 => bytes.extend((length as u16).to_le_bytes()),
        _ => bytes.extend(length.to_le_bytes()),
    }
    bytes.extend(header.as_bytes());
    bytes.extend(content);
    bytes
}

fn f64s(values: &[f64]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

#[test]
fn the_columns_of_an_array_are_channels() {
    let found = sample("columns.npy");
    assert_eq!(found.format, Format::Npy);
    assert_eq!(names(&found), ["data[1]", "data[2]", "data[3]"]);
    assert_eq!(found.channels[0].values.len(), 24);
    assert!((found.channels[0].values[23] - 0.046).abs() < 1e-8);
    assert!((found.channels[1].values[3] - 2.1_f64.sin()).abs() < 1e-6);
}

#[test]
fn the_fields_of_a_structured_array_are_channels() {
    let found = sample("record.npy");
    assert_eq!(names(&found), ["t", "joint/q[1]", "joint/q[2]", "joint/on", "n"]);
    assert!((found.channels[0].values[11] - 0.022).abs() < 1e-12);
    assert!((found.channels[3].values[1] - 1.0).abs() < 1e-12);
    assert!((found.channels[4].values[0] + 5.0).abs() < 1e-12);
}

#[test]
fn an_archive_has_the_channels_of_its_arrays() {
    let found = sample("deflated.npz");
    assert_eq!(found.format, Format::Npz);
    assert_eq!(names(&found), ["t", "run[1]", "run[2]", "z/real", "z/imag"]);
    assert_eq!(found.channels[2].values.len(), 24);
    assert!(found.channels[3].values.iter().all(|re| re.abs() < 1e-12));
    assert!((found.channels[4].values[2] - 0.98545).abs() < 1e-12 && found.notes.is_empty());
    let found = sample("stored.npz");
    let fields = ["t", "rec/t", "rec/joint/q[1]", "rec/joint/q[2]", "rec/joint/on", "rec/n"];
    assert_eq!(names(&found), fields);
    assert!(found.notes[0].starts_with("left out: o (pickled"), "{:?}", found.notes);
}

#[test]
fn headers_of_all_versions_are_read() {
    let header = "{'descr': '<f8', 'fortran_order': False, 'shape': (3,), }";
    for version in [1, 2, 3] {
        let found = read_bytes(array(version, header, &f64s(&[1.0, 2.0, 3.0]))).unwrap();
        assert_eq!((names(&found)[0], found.channels[0].values.len()), ("data", 3));
    }
    let python_2 = "{'descr': [(u'a', '<f8')], 'fortran_order': False, 'shape': (3L,)}";
    let found = read_bytes(array(1, python_2, &f64s(&[1.0, 2.0, 3.0]))).unwrap();
    assert_eq!(names(&found), ["a"]);
}

#[test]
fn pickled_objects_are_never_loaded() {
    let header = "{'descr': '|O', 'fortran_order': False, 'shape': (3,), }";
    let error = read_bytes(array(1, header, b"\x80\x04cos\nsystem\n")).unwrap_err();
    assert!(matches!(error, FormatError::LeftOut { .. }), "{error}");
    assert!(error.to_string().contains("pickled Python objects"), "{error}");
    assert!(error.hint().contains("allow_pickle=True"), "{}", error.hint());
}

#[test]
fn a_file_that_is_cut_off_keeps_whole_rows() {
    let header = "{'descr': '<f8', 'fortran_order': False, 'shape': (5, 2), }";
    let values: Vec<f64> = (0..10).map(f64::from).collect();
    let cut = array(1, header, &f64s(&values)[..68]);
    let found = read_bytes(cut).unwrap();
    assert_eq!(found.channels[1].values.len(), 4);
    assert_eq!(found.notes, ["data: the file ends after 4 of 5 samples"]);
    let columns = header.replace("False", "True");
    let error = read_bytes(array(1, &columns, &f64s(&values)[..68])).unwrap_err();
    assert_eq!(error.to_string(), "data: the file ends inside the array");
}

#[test]
fn a_shape_larger_than_the_file_takes_no_memory() {
    for shape in ["(1000000000000,)", "(4294967296, 4294967296, 2)", "(0, 99999999999999999999)"] {
        let header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}}}");
        assert!(read_bytes(array(1, &header, &f64s(&[1.0]))).is_err(), "{shape}");
    }
    let deep = "[('a', ".repeat(10_000) + "'<f8'" + &")]".repeat(10_000);
    let header = format!("{{'descr': {deep}, 'fortran_order': False, 'shape': (2,)}}");
    assert!(read_bytes(array(2, &header, &[])).is_err());
}

#[test]
fn an_archive_without_arrays_is_named() {
    // The end of a directory without entries.
    let directory = b"PK\x05\x06\0\0\0\0\0\0\0\0\0\0\0\0\x04\0\0\0\0\0";
    let empty = [b"PK\x03\x04", &directory[..]].concat();
    let error = read_bytes(empty).unwrap_err();
    assert!(error.to_string().starts_with("is a ZIP archive without NumPy arrays"), "{error}");
    let error = read_bytes(b"PK\x03\x04 no directory".to_vec()).unwrap_err();
    assert!(matches!(error, FormatError::Damaged { .. }), "{error}");
}
