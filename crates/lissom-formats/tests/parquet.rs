//! Parquet files.

use std::path::{Path, PathBuf};

use lissom_formats::read;

fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files").join(name)
}

#[test]
#[cfg(feature = "parquet")]
fn columns_of_numbers_and_times_are_channels() {
    for name in ["columns_snappy.parquet", "columns_zstd.parquet"] {
        let found = read(&path(name)).unwrap();
        assert_eq!(found.format, lissom_formats::Format::Parquet);
        let names: Vec<&str> = found.channels.iter().map(|c| c.name.as_str()).collect();
        assert_eq!(names, ["at", "i", "count", "on", "part/x"]);
        assert!(found.channels.iter().all(|channel| channel.values.len() == 24), "{name}");
        assert_eq!(found.channels[0].values[..3], [0.0, 0.002, 0.004]);
        assert_eq!(found.channels[0].unit.as_deref(), Some("s"));
        assert!(found.channels[1].values[3].is_nan());
        assert_eq!(found.channels[2].values[22..], [-22.0, -23.0]);
        assert_eq!(found.channels[3].values[..4], [1.0, 0.0, 0.0, 1.0]);
        assert!(found.notes[0].contains("columns of lists"), "{:?}", found.notes);
    }
}

#[test]
#[cfg(not(feature = "parquet"))]
fn a_build_without_the_feature_names_a_parquet_file() {
    let error = read(&path("columns_snappy.parquet")).unwrap_err();
    assert!(error.to_string().starts_with("is a Parquet file"), "{error}");
    assert!(error.hint().contains("--features full"), "{}", error.hint());
}
