//! Table of a virtual campaign.

use std::path::Path;

use lissom::beam::Base;
use lissom::rig::Rig;
use lissom_io::{ArmFile, PlanFile, RigRunEntry};

use super::printer;

/// Largest number of findings of one kind that are shown.
const WARNED: usize = 3;
/// Number of natural frequencies of a lumped beam that are compared.
const SHOWN: usize = 3;

/// How point masses change the frequencies of a beam with mass along it; `None` for other beams.
pub(crate) fn lumped(file: &ArmFile, path: &Path, rig: &Rig) -> Option<String> {
    let beam = file.distributed_beam(path).ok()?;
    let exact = beam.frequencies_rad_s(Base::Clamped, SHOWN);
    let found = rig.arm.beam().frequencies_rad_s(Base::Clamped, SHOWN);
    let errors = found.iter().zip(&exact).map(|(a, b)| format!("{:+.2} %", 100.0 * (a / b - 1.0)));
    let errors: Vec<String> = errors.collect();
    Some(format!(
        "the beam is simulated with {} point masses: its lowest frequencies are off by {}; use more `masses` \
         in [rig] for a smaller error",
        rig.arm.beam().len(),
        errors.join(", ")
    ))
}

pub(crate) fn report(plan: &PlanFile, entries: &[RigRunEntry], campaign: &Path) {
    let head = ["run", "samples", "settled after", "transient [rad]", "sticking"];
    let mut rows = vec![head.map(str::to_owned).to_vec()];
    for (run, entry) in plan.runs.iter().zip(entries) {
        rows.push(vec![
            run.name.clone(),
            entry.samples.to_string(),
            format!("{:.1} s", entry.waited_s),
            entry.transient_left_rad.map_or_else(|| "-".to_owned(), |v| format!("{v:.1e}")),
            format!("{:.1} %", 100.0 * entry.stuck_share),
        ]);
    }
    printer::table(&rows);
    warn(plan, entries);
    printer::line("");
    printer::line(&format!("identify it with: lissom identify {}", campaign.display()));
}

/// Prints the findings, those of one kind together.
fn warn(plan: &PlanFile, entries: &[RigRunEntry]) {
    let mut kinds: Vec<(&str, Vec<String>)> = Vec::new();
    for (run, entry) in plan.runs.iter().zip(entries) {
        for finding in &entry.findings {
            let line = format!("warning: {}: {}", run.name, finding.message);
            match kinds.iter_mut().find(|(code, _)| *code == finding.code) {
                Some((_, lines)) => lines.push(line),
                None => kinds.push((finding.code.as_str(), vec![line])),
            }
        }
    }
    for (_, lines) in kinds {
        lines.iter().take(WARNED).for_each(|line| printer::line(line));
        if lines.len() > WARNED {
            printer::line(&format!(
                "  … and {} more of this kind, in rig.json",
                lines.len() - WARNED
            ));
        }
    }
}
