//! Excel workbooks.

use std::path::{Path, PathBuf};

use lissom_formats::read;

fn path() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files/sheets.xlsx")
}

#[test]
#[cfg(feature = "xlsx")]
fn the_sheet_with_the_longest_block_has_its_header_and_its_units() {
    let found = read(&path()).unwrap();
    assert_eq!(found.format, lissom_formats::Format::Xlsx);
    let names: Vec<&str> = found.channels.iter().map(|c| c.name.as_str()).collect();
    let units: Vec<Option<&str>> = found.channels.iter().map(|c| c.unit.as_deref()).collect();
    assert_eq!(names, ["time", "i", "angle [°]"]);
    assert_eq!(units, [Some("s"), Some("A"), Some("°")]);
    assert_eq!(found.channels[0].values[..3], [0.0, 0.25, 0.5]);
    assert!(found.channels[1].values[3].is_nan());
    assert_eq!(found.channels[2].values[..4], [1.0, -1.0, 1.0, -3.0]);
    let note = found.notes.last().unwrap();
    assert_eq!(note, "sheet log is read, with the longest block of numbers, and not summary");
}

#[test]
#[cfg(not(feature = "xlsx"))]
fn a_build_without_the_feature_names_a_workbook() {
    let Err(error) = read(&path()) else { panic!("a workbook was read") };
    assert!(error.to_string().starts_with("is an Excel workbook"), "{error}");
    assert!(error.hint().contains("--features full"), "{}", error.hint());
}

#[test]
#[cfg(feature = "xlsx")]
fn sheets_with_the_same_columns_are_groups() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files/sheet_of_each_run.xlsx");
    let found = read(&path).unwrap();
    let channels: Vec<(&str, usize)> =
        found.channels.iter().map(|c| (c.name.as_str(), c.values.len())).collect();
    let expected =
        [("Run 1/t [s]", 14), ("Run 1/q [rad]", 14), ("Run 2/t [s]", 17), ("Run 2/q [rad]", 17)];
    assert_eq!(channels, expected);
    assert_eq!(found.notes.last().unwrap(), "sheets that are left out: info");
    assert_eq!(found.groups("Run *").len(), 2);
}
