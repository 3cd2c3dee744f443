//! Table of a plan.

use std::path::Path;

use lissom::plan::{BETWEEN_S, Plan, PlannedMotion, PlannedRun, percent};
use lissom_views::digits::counted;

use super::printer;

pub(crate) fn report(arm: &Path, plan: &Plan, out: &Path) {
    let head = ["run", "rad/s", "amplitude", "periods", "logged", "waiting", "current", "sticking"];
    let mut rows = vec![head.map(str::to_owned).to_vec()];
    rows.extend(plan.runs.iter().map(row));
    printer::table(&rows);
    for run in &plan.runs {
        printer::line(&format!("  {}: {}", run.motion, run.in_words()));
    }
    printer::line(&format!(
        "\n{} in {:.0} s, including {BETWEEN_S} s before each run",
        counted(plan.runs.len(), "run"),
        plan.time_s
    ));
    printer::line("");
    let head = ["standard error of", "expected", "wanted"];
    let mut rows = vec![head.map(str::to_owned).to_vec()];
    rows.extend(plan.expected.iter().map(|e| {
        let got = if e.std < 1.0 { percent(e.std) } else { "not identified".to_owned() };
        vec![e.parameter.name(), got, percent(e.wanted)]
    }));
    printer::table(&rows);
    printer::line("");
    for note in &plan.notes {
        let kind = if note.is_warning() { "warning" } else { "note" };
        printer::line(&format!("{kind} [{}]: {note}", note.code()));
    }
    printer::line(&format!(
        "run it with: lissom rig {} --campaign {} --out DIR",
        arm.display(),
        out.display()
    ));
}

fn row(run: &PlannedRun) -> Vec<String> {
    let (kind, band) = match run.motion {
        PlannedMotion::Sine { omega_rad_s } => ("sine", format!("{omega_rad_s}")),
        PlannedMotion::Multisine { omega_rad_s, to_rad_s, .. } => {
            ("multisine", format!("{omega_rad_s} to {to_rad_s}"))
        }
        PlannedMotion::Chirp { from_rad_s, to_rad_s, .. } => {
            ("chirp", format!("{from_rad_s} to {to_rad_s}"))
        }
    };
    let periods = run.motion.periods(run.record_s);
    vec![
        kind.to_owned(),
        band,
        format!("{} rad", run.amplitude_rad),
        periods.map_or_else(|| "-".to_owned(), |p| p.to_string()),
        format!("{:.1} s", run.record_s),
        format!("{:.1} s", run.waited_s),
        format!("{:.2} A", run.peak_current_a),
        format!("{:.1} %", 100.0 * run.stuck_share),
    ]
}
