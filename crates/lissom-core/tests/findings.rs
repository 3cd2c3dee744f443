//! `docs/src/reference/findings.md` explains every finding there is, and no other.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::BTreeSet;
use std::path::Path;

use lissom::identify::findings;

/// The first cell of every row whose first cell is code.
fn explained() -> BTreeSet<String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/src/reference/findings.md");
    let text = std::fs::read_to_string(path).unwrap();
    let code = |line: &str| Some(line.strip_prefix("| `")?.split('`').next()?.to_owned());
    text.lines().filter_map(code).collect()
}

#[test]
fn every_finding_is_explained() {
    let codes: BTreeSet<String> = findings::codes().into_iter().map(str::to_owned).collect();
    let document = explained();
    let missing: Vec<_> = codes.difference(&document).collect();
    assert!(missing.is_empty(), "docs/src/reference/findings.md lacks {missing:?}");
    let stale: Vec<_> = document.difference(&codes).collect();
    assert!(
        stale.is_empty(),
        "docs/src/reference/findings.md explains {stale:?}, which is no code"
    );
}

/// Lines of a file or of the files in a folder that are not comments.
fn code_lines(path: &Path) -> Vec<String> {
    if path.is_dir() {
        let entries = std::fs::read_dir(path).unwrap().map(|entry| entry.unwrap().path());
        return entries.flat_map(|entry| code_lines(&entry)).collect();
    }
    let text = std::fs::read_to_string(path).unwrap();
    let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
    code.map(str::to_owned).collect()
}

#[test]
fn no_text_names_an_option_or_a_command() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    for place in ["identify/findings", "identify/equivalent/refusal.rs", "record/note.rs"] {
        for line in code_lines(&source.join(place)) {
            let names = ["--", "`lissom", "lissom "].iter().any(|word| line.contains(word));
            assert!(!names, "{place}: the command adds this, the library does not: {line}");
        }
    }
}
