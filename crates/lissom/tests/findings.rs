//! `docs/findings.md` explains every finding there is, and no other.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::BTreeSet;
use std::path::Path;

/// Names of channels and directions that stand where a code may stand.
const NO_CODES: [&str; 4] = ["motor", "command", "forward", "backward"];
/// What comes before a code in the sources.
const BEFORE: [&str; 2] = ["(", "refuse(findings,"];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Words of small letters and hyphens that are the first argument of a call or the first of a pair.
fn codes(source: &str) -> BTreeSet<String> {
    let code = source.split("#[cfg(test)]").next().unwrap();
    let code: Vec<&str> = code.lines().filter(|l| !l.trim_start().starts_with("//")).collect();
    let code = code.join("\n");
    let pieces: Vec<&str> = code.split('"').collect();
    pieces
        .windows(2)
        .filter(|pair| BEFORE.iter().any(|before| pair[0].trim_end().ends_with(before)))
        .map(|pair| pair[1])
        .filter(|word| word.len() > 2 && word.chars().all(|c| c.is_ascii_lowercase() || c == '-'))
        .filter(|word| !NO_CODES.contains(word))
        .map(str::to_owned)
        .collect()
}

fn in_sources() -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut folders = vec![root().join("src/identify")];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else {
                found.extend(codes(&std::fs::read_to_string(path).unwrap()));
            }
        }
    }
    found
}

fn in_document() -> BTreeSet<String> {
    let text = std::fs::read_to_string(root().join("../../docs/findings.md")).unwrap();
    let code = |line: &str| Some(line.strip_prefix("| `")?.split('`').next()?.to_owned());
    text.lines().filter_map(code).collect()
}

#[test]
fn every_finding_is_explained() {
    let (sources, document) = (in_sources(), in_document());
    assert!(sources.contains("sticking") && sources.contains("too-few-periods"), "{sources:?}");
    let missing: Vec<_> = sources.difference(&document).collect();
    assert!(missing.is_empty(), "docs/findings.md lacks {missing:?}");
    let stale: Vec<_> = document.difference(&sources).collect();
    assert!(stale.is_empty(), "docs/findings.md explains {stale:?}, which no source has");
}
