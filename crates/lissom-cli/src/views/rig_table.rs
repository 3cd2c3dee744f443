//! A virtual campaign.

use std::path::Path;

use lissom::beam::Base;
use lissom::rig::Rig;
use lissom_io::{ArmFile, PlanFile};
use serde_json::Value;

use super::printer;

/// Findings of one kind that are shown.
const WARNED: usize = 3;
/// Frequencies of a lumped beam that are compared.
const SHOWN: usize = 3;

/// What lumping did to a beam with mass along it.
pub(crate) fn lumped(file: &ArmFile, path: &Path, rig: &Rig) -> Option<String> {
    let beam = file.distributed_beam(path).ok()?;
    let exact = beam.frequencies_rad_s(Base::Clamped, SHOWN);
    let found = rig.arm.beam().frequencies_rad_s(Base::Clamped, SHOWN);
    let errors = found.iter().zip(&exact).map(|(a, b)| format!("{:+.2} %", 100.0 * (a / b - 1.0)));
    let errors: Vec<String> = errors.collect();
    Some(format!(
        "the beam is lumped, masses: {}; its first frequencies are off by {}; `masses` in [rig] \
         changes that",
        rig.arm.beam().len(),
        errors.join(", ")
    ))
}

pub(crate) fn report(plan: &PlanFile, facts: &[Value], campaign: &Path) {
    let head = ["run", "samples", "settled after", "left [rad]", "stuck"];
    let mut rows = vec![head.map(str::to_owned).to_vec()];
    let figure = |facts: &Value, key: &str, digits: usize, unit: &str| {
        facts[key].as_f64().map_or_else(|| "-".to_owned(), |v| format!("{v:.digits$}{unit}"))
    };
    for (run, facts) in plan.runs.iter().zip(facts) {
        let left = facts["transient_left_rad"].as_f64();
        rows.push(vec![
            run.name.clone(),
            facts["samples"].to_string(),
            figure(facts, "waited_s", 1, " s"),
            left.map_or_else(|| "-".to_owned(), |v| format!("{v:.1e}")),
            facts["stuck_share"]
                .as_f64()
                .map_or_else(String::new, |v| format!("{:.1} %", 100.0 * v)),
        ]);
    }
    printer::table(&rows);
    warn(plan, facts);
    printer::line("");
    printer::line(&format!("identify it with: lissom identify {}", campaign.display()));
}

/// The findings, those of one kind together.
fn warn(plan: &PlanFile, facts: &[Value]) {
    let mut kinds: Vec<(&str, Vec<String>)> = Vec::new();
    for (run, facts) in plan.runs.iter().zip(facts) {
        for finding in facts["findings"].as_array().into_iter().flatten() {
            let text = |key: &str| finding[key].as_str().unwrap_or_default();
            let line = format!("warning: {}: {}", run.name, text("message"));
            match kinds.iter_mut().find(|(code, _)| *code == text("code")) {
                Some((_, lines)) => lines.push(line),
                None => kinds.push((text("code"), vec![line])),
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
