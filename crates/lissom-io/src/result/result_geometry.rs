//! An arm as described beside the one that logs show, as JSON.

use lissom::identify::{ArmQuantity, Explanation, GeometryCheck};
use serde_json::{Value, json};

use super::estimate_json::figure;

/// The check, and every number that was let go.
pub(super) fn geometry(check: &GeometryCheck) -> Value {
    json!({
        "agrees": check.agrees(),
        "difference_rms": check.before,
        "explanations": check.explanations.iter().map(explanation).collect::<Vec<_>>(),
    })
}

fn explanation(e: &Explanation) -> Value {
    let (quantity, span) = match e.quantity {
        ArmQuantity::Length(span) => ("length", span),
        ArmQuantity::Stiffness(span) => ("flexural_rigidity", span),
        ArmQuantity::Mass(span) => ("mass", span),
        ArmQuantity::Payload => ("payload", None),
        ArmQuantity::MotorInertia => ("motor_inertia", None),
    };
    json!({
        "quantity": quantity,
        "span": span.map(|i| i + 1),
        "factor": figure(Some(e.factor)),
        "left_rms": e.left,
    })
}
