//! The layers of the identification.

#![expect(clippy::unwrap_used, reason = "tests")]

use std::fs;
use std::path::{Path, PathBuf};

/// From the lowest to the highest; `findings` beside them is the table that all of them write to.
const LAYERS: [&str; 8] = [
    "prepare",
    "methods",
    "responses",
    "output_error",
    "replayed_responses",
    "judge",
    "identified",
    "pipeline",
];

fn files(path: &Path) -> Vec<PathBuf> {
    if path.is_file() {
        return vec![path.to_owned()];
    }
    let entries = fs::read_dir(path).unwrap().map(|entry| entry.unwrap().path());
    entries.flat_map(|entry| files(&entry)).collect()
}

#[test]
fn no_file_uses_a_layer_above_its_own() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/identify");
    for (level, layer) in LAYERS.iter().enumerate() {
        let folder = source.join(layer);
        let path = if folder.is_dir() { folder } else { source.join(format!("{layer}.rs")) };
        for file in files(&path) {
            let text = fs::read_to_string(&file).unwrap();
            assert!(!text.contains("identify::{self"), "{}: name the modules", file.display());
            for above in &LAYERS[level + 1..] {
                let used = text.contains(&format!("crate::identify::{above}::"));
                assert!(!used, "{} is below {above}", file.display());
            }
        }
    }
}
