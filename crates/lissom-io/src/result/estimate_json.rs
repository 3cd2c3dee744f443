//! Estimates, findings and names that several files share, as JSON.

use lissom::identify::{Estimate, Finding, ModeEstimate, Severity};
use lissom::record::{Axis, TipQuantity};
use serde_json::{Map, Value, json};

use super::unit_names::UnitNames;

pub(super) fn axis(axis: Axis) -> &'static str {
    match axis {
        Axis::Rotary => "rotary",
        Axis::Linear => "linear",
    }
}

/// A figure as JSON.
pub(super) fn figure(e: Option<Estimate>) -> Value {
    e.map_or(Value::Null, |e| json!({ "value": e.value, "std": e.std, "ci95": e.ci95() }))
}

/// A torque under its own unit and, where both are known, the command's.
pub(super) fn torque(
    map: &mut Map<String, Value>,
    names: UnitNames,
    k: f64,
    key: &str,
    e: Option<Estimate>,
) {
    map.insert(format!("{key}_{}", names.command()), figure(e.map(|e| e.scaled(1.0 / k))));
    if names.torque_known {
        map.insert(format!("{key}_{}", names.torque()), figure(e));
    }
}

pub(super) fn mode(m: &ModeEstimate) -> Value {
    json!({
        "natural_frequency_rad_s": figure(Some(m.natural_frequency_rad_s)),
        "damping_ratio": figure(Some(m.damping_ratio)),
    })
}

pub(super) fn quantity(q: TipQuantity) -> &'static str {
    match q {
        TipQuantity::Angle => "angle",
        TipQuantity::Deflection => "deflection",
        TipQuantity::Acceleration => "acceleration",
    }
}

pub(super) fn finding(f: &Finding) -> Value {
    json!({
        "code": f.code,
        "severity": match f.severity {
            Severity::Info => "info",
            Severity::Warning => "warning",
            Severity::Refusal => "refusal",
        },
        "run": f.run,
        "affects": f.affects,
        "message": f.message,
        "hint": f.hint,
    })
}
