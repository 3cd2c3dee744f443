//! `docs/findings.md` explains every finding there is, and no other.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::BTreeSet;
use std::path::Path;

use lissom::identify::FindingKind;

/// The first cell of every row whose first cell is code.
fn explained() -> BTreeSet<String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/findings.md");
    let text = std::fs::read_to_string(path).unwrap();
    let code = |line: &str| Some(line.strip_prefix("| `")?.split('`').next()?.to_owned());
    text.lines().filter_map(code).collect()
}

#[test]
fn every_finding_is_explained() {
    let codes: BTreeSet<String> = FindingKind::codes().map(str::to_owned).collect();
    assert_eq!(codes.len(), FindingKind::codes().count(), "a code is used twice");
    let document = explained();
    let missing: Vec<_> = codes.difference(&document).collect();
    assert!(missing.is_empty(), "docs/findings.md lacks {missing:?}");
    let stale: Vec<_> = document.difference(&codes).collect();
    assert!(stale.is_empty(), "docs/findings.md explains {stale:?}, which is no code");
}
