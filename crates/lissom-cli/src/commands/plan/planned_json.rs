//! A plan for programs: `docs/planned.schema.json`.

use lissom::plan::{Expected, Plan, PlanNote, PlannedMotion, PlannedRun, Wishes};
use serde_json::{Value, json};

pub(crate) fn plan(wishes: &Wishes, plan: &Plan) -> Value {
    let parameters = plan.parameters.iter().map(|(parameter, value, std)| {
        // JSON has no infinity: what no run shows is null.
        json!({ "name": parameter.name(), "value": value, "std": finite(*std) })
    });
    json!({
        "lissom": env!("CARGO_PKG_VERSION"),
        "time_s": plan.time_s,
        "within_s": wishes.within_s,
        "longest_wait_s": plan.longest_wait_s,
        "runs": plan.runs.iter().map(run).collect::<Vec<_>>(),
        "expected": plan.expected.iter().map(expected).collect::<Vec<_>>(),
        "parameters": parameters.collect::<Vec<_>>(),
        "notes": plan.notes.iter().map(note).collect::<Vec<_>>(),
    })
}

fn finite(value: f64) -> Option<f64> {
    Some(value).filter(|v| v.is_finite())
}

fn run(run: &PlannedRun) -> Value {
    let (kind, from, to, phases) = match run.motion {
        PlannedMotion::Sine { omega_rad_s } => ("sine", omega_rad_s, omega_rad_s, None),
        PlannedMotion::Multisine { omega_rad_s, to_rad_s, phases } => {
            ("multisine", omega_rad_s, to_rad_s, Some(phases))
        }
        PlannedMotion::Chirp { from_rad_s, to_rad_s, .. } => ("chirp", from_rad_s, to_rad_s, None),
    };
    let without = run
        .without
        .map(|(figure, std)| json!({ "figure": figure.name(), "relative_std": finite(std) }));
    json!({
        "kind": kind,
        "from_rad_s": from,
        "to_rad_s": to,
        "phases": phases,
        "amplitude_rad": run.amplitude_rad,
        "periods": run.motion.periods(run.record_s),
        "record_s": run.record_s,
        "waited_s": run.waited_s,
        "peak_current_a": run.peak_current_a,
        "moved_rad": run.moved_rad,
        "stuck_share": run.stuck_share,
        "paired": run.paired,
        "without": without,
    })
}

fn expected(expected: &Expected) -> Value {
    json!({
        "figure": expected.figure.name(),
        "value": expected.value,
        "relative_std": finite(expected.std),
        "wanted": expected.wanted,
    })
}

fn note(note: &PlanNote) -> Value {
    let severity = if note.is_warning() { "warning" } else { "info" };
    json!({ "code": note.code(), "severity": severity, "message": note.to_string() })
}
