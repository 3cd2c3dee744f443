//! Every campaign.toml and arm.toml in the documents can be read.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use lissom_io::{ArmFile, BeamKind, PlanFile, read_campaign};

/// Columns of the log that stands in for those that the documents name.
const COLUMNS: [&str; 12] =
    ["t", "i", "theta_m", "theta_t", "u", "v", "x", "y", "goal", "position", "torque", "n"];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The blocks of a document that are fenced as TOML.
fn blocks(document: &str) -> Vec<String> {
    let text = std::fs::read_to_string(root().join(document)).unwrap();
    let fenced = text.split("```toml\n").skip(1);
    fenced.map(|rest| rest.split("```").next().unwrap().to_owned()).collect()
}

/// A log of 3000 rows in which every column moves in its own way and the first is time at 2 ms.
fn log(separator: &str) -> String {
    let mut text = COLUMNS.join(separator) + "\n";
    for k in 0..3000 {
        let wave = |column: usize| (f64::from(k) * 0.02 + 0.1 * column as f64).sin();
        let cells: Vec<String> = (1..COLUMNS.len()).map(|c| format!("{:.6}", wave(c))).collect();
        writeln!(text, "{:.3}{separator}{}", f64::from(k) * 0.002, cells.join(separator)).unwrap();
    }
    text
}

fn read_as_campaign(block: &str) {
    let folder = tempfile::tempdir().unwrap();
    let comma = block.contains("decimal = \",\"");
    for line in block.lines() {
        if let Some(file) = line.strip_prefix("file = \"").and_then(|rest| rest.split('"').next()) {
            let text = if comma { log("\t").replace('.', ",") } else { log(",") };
            let path = folder.path().join(file);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, text).unwrap();
        }
    }
    let path = folder.path().join("campaign.toml");
    std::fs::write(&path, block).unwrap();
    if let Err(error) = read_campaign(&path) {
        panic!("{error} ({:?})\n{block}", error.hint());
    }
}

fn read_as_arm(block: &str) {
    let path = Path::new("arm.toml");
    let file = ArmFile::from_text(path, block).unwrap();
    match file.beam_kind(path).ok() {
        Some(BeamKind::Lumped) => drop(file.lumped_beam(path).unwrap()),
        Some(BeamKind::Distributed) => drop(file.distributed_beam(path).unwrap()),
        Some(BeamKind::Modal) => drop(file.modal_beam(path).unwrap()),
        None => {}
    }
    if file.rig.is_some() && file.beam_kind(path).is_ok() {
        file.rig(path).unwrap();
    }
}

fn read_as_plan(block: &str) {
    assert!(!PlanFile::from_text(Path::new("plan.toml"), block).unwrap().runs.is_empty());
}

#[test]
fn the_documents_describe_files_that_can_be_read() {
    let (mut campaigns, mut arms, mut plans) = (0, 0, 0);
    for document in [
        "README.md",
        "docs/src/reference/campaign.md",
        "docs/src/reference/arm.md",
        "docs/src/reference/plan.md",
    ] {
        for block in blocks(document) {
            if block.contains("[signals]") {
                read_as_campaign(&block);
                campaigns += 1;
            } else if block.contains("[[runs]]") {
                read_as_plan(&block);
                plans += 1;
            } else {
                read_as_arm(&block);
                arms += 1;
            }
        }
    }
    let counts = (campaigns, arms, plans);
    assert!(campaigns >= 5 && arms >= 5 && plans >= 2, "campaigns, arms, plans: {counts:?}");
}
