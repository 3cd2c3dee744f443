//! The layers of the command's source.

#![expect(clippy::unwrap_used, reason = "tests")]

use std::fs;
use std::path::{Path, PathBuf};

/// From the lowest to the highest.
const LAYERS: [&str; 5] = ["args", "shared", "tasks", "views", "commands"];

fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries.flat_map(|path| if path.is_dir() { files(&path) } else { vec![path] }).collect()
}

#[test]
fn no_file_uses_a_layer_above_its_own() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    for (level, layer) in LAYERS.iter().enumerate() {
        let files = files(&source.join(layer));
        assert!(!files.is_empty(), "{layer}");
        for file in files {
            let text = fs::read_to_string(&file).unwrap();
            assert!(!text.contains("crate::{"), "{}: name one module a line", file.display());
            for above in &LAYERS[level + 1..] {
                let used = text.contains(&format!("crate::{above}"));
                assert!(!used, "{} is below {above}", file.display());
            }
        }
    }
}

/// `cargo test` without arguments stops at the command: its list of tests names the recipe that goes on, which README and
/// CONTRIBUTING name too.
#[test]
fn tests_of_all_crates_run_with_cargo_xtask_test() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let recipes = fs::read_to_string(root.join("xtask/src/main.rs")).unwrap();
    assert!(recipes.contains("name: \"test\""));
    for page in ["README.md", "CONTRIBUTING.md"] {
        let text = fs::read_to_string(root.join(page)).unwrap();
        assert!(text.contains("`cargo xtask test`"), "{page}");
    }
}
