//! What the logs separate, as JSON.

use lissom::identify::{ArmSource, Direction, FigureKnown, RunShare, RunToAdd, Separability};
use lissom::plan::PlannedMotion;
use lissom::record::Axis;
use serde_json::{Value, json};

use super::unit_names::UnitNames;

/// The verdict.
pub(super) fn verdict(axis: Axis, names: UnitNames, found: &Separability) -> Value {
    json!({
        "words": found.words(axis),
        "source": match found.source {
            ArmSource::OutputError => "output_error",
            ArmSource::Regression => "regression",
        },
        "condition": finite(found.condition),
        "figures": found.figures.iter().map(figure).collect::<Vec<_>>(),
        "directions": found.directions.iter().map(direction).collect::<Vec<_>>(),
        "runs": found.runs.iter().map(|r| run(found, r)).collect::<Vec<_>>(),
        "run_to_add": found.run_to_add.as_ref().map(|r| run_to_add(names, r)),
        "doubted_by": found.doubted_by,
    })
}

/// JSON has no infinity: what the logs do not show is null.
fn finite(value: f64) -> Option<f64> {
    Some(value).filter(|v| v.is_finite())
}

fn figure(known: &FigureKnown) -> Value {
    json!({
        "figure": known.figure.name(),
        "relative_std": finite(known.std),
        "relative_std_if_others_known": finite(known.alone),
    })
}

fn direction(direction: &Direction) -> Value {
    let part = |p: &lissom::identify::Part| {
        json!({
            "figure": p.figure.name(),
            "weight": p.weight,
            "share_of_variance": p.of_variance,
        })
    };
    json!({
        "relative_std": finite(direction.std),
        "parts": direction.parts.iter().map(part).collect::<Vec<_>>(),
    })
}

fn run(found: &Separability, run: &RunShare) -> Value {
    let figure = |c: &lissom::identify::Carried| {
        json!({
            "figure": c.figure.name(),
            "std_growth_without": finite(c.growth),
            "relative_change_without": finite(c.change),
            "deviations": finite(c.deviations),
        })
    };
    json!({
        "name": run.run,
        "residual_beside_others": finite(run.residual),
        "stands_out": found.stands_out() == Some(run),
        "figures": run.figures.iter().map(figure).collect::<Vec<_>>(),
    })
}

fn run_to_add(names: UnitNames, run: &RunToAdd) -> Value {
    let (kind, from, to) = match run.motion {
        PlannedMotion::Sine { omega_rad_s } => ("sine", omega_rad_s, omega_rad_s),
        PlannedMotion::Multisine { omega_rad_s, to_rad_s, .. } => {
            ("multisine", omega_rad_s, to_rad_s)
        }
        PlannedMotion::Chirp { from_rad_s, to_rad_s, .. } => ("chirp", from_rad_s, to_rad_s),
    };
    json!({
        "kind": kind,
        "from_rad_s": from,
        "to_rad_s": to,
        (format!("amplitude_{}", names.angle())): run.amplitude_rad,
        "record_s": run.record_s,
        "figure": run.figure.name(),
        "relative_std_now": finite(run.std_now),
        "relative_std_then": finite(run.std_then),
    })
}
