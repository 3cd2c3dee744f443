//! The friction curve and the choice of friction's law, as JSON.

use lissom::identify::{
    CurvePoint, Estimate, Friction, FrictionLaw, LawCandidate, LawTerm, RippleEstimate,
};
use serde_json::{Map, Value, json};

use super::estimate_json::{figure, torque};
use super::unit_names::UnitNames;

/// `friction.curve`.
pub(super) fn curve(names: UnitNames, constant: f64, points: &[CurvePoint]) -> Value {
    let point = |p: &CurvePoint| {
        let mut map = Map::new();
        map.insert("direction".to_owned(), json!(direction(p.direction)));
        map.insert(format!("speed_{}_per_s", names.angle()), json!(p.speed));
        torque(&mut map, names, constant, "friction", Some(p.friction));
        map.insert("windows".to_owned(), json!(p.windows));
        Value::Object(map)
    };
    points.iter().map(point).collect()
}

fn direction(sign: f64) -> &'static str {
    if sign > 0.0 { "forward" } else { "backward" }
}

/// `friction.near_rest`, `friction.ripples` and `friction.bristles`, where there are any.
pub(super) fn terms(map: &mut Map<String, Value>, names: UnitNames, constant: f64, f: &Friction) {
    if let Some(near) = f.near_rest {
        let mut own = Map::new();
        torque(&mut own, names, constant, "amplitude", Some(near.torque));
        own.insert(format!("speed_{}_per_s", names.angle()), figure(Some(near.speed)));
        own.insert("falloff".to_owned(), json!(near.falloff.name()));
        map.insert("near_rest".to_owned(), Value::Object(own));
    }
    let ripple = |r: &RippleEstimate| {
        let mut own = Map::new();
        torque(&mut own, names, constant, "amplitude", Some(r.torque));
        own.insert(format!("period_{}", names.angle()), figure(Some(r.period())));
        Value::Object(own)
    };
    if !f.ripples.is_empty() {
        map.insert("ripples".to_owned(), f.ripples.iter().map(ripple).collect());
    }
    if let Some(b) = f.bristles {
        let mut own = Map::new();
        own.insert(names.coupling_key("stiffness"), figure(Some(b.stiffness)));
        own.insert(names.viscous_key("damping"), figure(Some(b.damping)));
        own.insert(format!("travel_{}", names.angle()), figure(Some(b.travel)));
        map.insert("bristles".to_owned(), Value::Object(own));
    }
}

/// `methods.friction_law`.
pub(super) fn law(names: UnitNames, constant: f64, law: &FrictionLaw) -> Value {
    let [simplest, chosen, curve] = law.relative_residual;
    let fit = &law.chosen;
    let mut map = Map::new();
    torque(&mut map, names, constant, "coulomb", fit.coulomb);
    torque(&mut map, names, constant, "offset", fit.offset);
    map.insert(names.viscous_key("viscous"), figure(fit.viscous));
    map.insert(names.inertia_key(), figure(fit.inertia));
    map.insert(names.coupling_key("coupling"), figure(fit.total_coupling));
    let terms = fit.terms.iter().map(|(term, amplitudes)| {
        let mut map = named(names, *term);
        // A ripple's period stands beside it.
        let all: Vec<Value> = amplitudes.iter().take(2).map(|e| figure(Some(*e))).collect();
        map.insert(amplitude_key(names, *term), Value::Array(all));
        Value::Object(map)
    });
    map.insert("terms".to_owned(), terms.collect());
    json!({
        "window_s": law.window_s,
        "relative_residual": { "simplest": simplest, "chosen": chosen, "curve": curve },
        "chosen": map,
        "candidates": law.candidates.iter().map(|c| candidate(names, c)).collect::<Vec<_>>(),
    })
}

fn candidate(names: UnitNames, c: &LawCandidate) -> Value {
    let mut map = named(names, c.term);
    map.insert("beside_terms".to_owned(), json!(c.beside));
    map.insert(amplitude_key(names, c.term), figure(Some(c.amplitude)));
    map.insert("residual_ratio".to_owned(), json!(c.residual_ratio));
    map.insert("paired_deviations".to_owned(), json!(c.paired));
    map.insert("stretch_ratio".to_owned(), json!(c.stretch_ratio));
    let at_rest = Estimate { value: c.at_rest, std: c.at_rest_std };
    map.insert(format!("at_rest_{}", names.torque()), figure(Some(at_rest)));
    map.insert("taken".to_owned(), json!(c.taken));
    Value::Object(map)
}

/// A term's name and what is in it beside its amplitude.
fn named(names: UnitNames, term: LawTerm) -> Map<String, Value> {
    let mut map = Map::new();
    map.insert("term".to_owned(), json!(term.name()));
    match term {
        LawTerm::NearRest { speed, falloff } => {
            map.insert("falloff".to_owned(), json!(falloff.name()));
            map.insert(format!("speed_{}_per_s", names.angle()), json!(speed));
        }
        LawTerm::Ripple { per_angle } => {
            let period = std::f64::consts::TAU / per_angle;
            map.insert(format!("period_{}", names.angle()), json!(period));
        }
        LawTerm::AfterTravel { travel } | LawTerm::Bristles { travel } => {
            map.insert(format!("travel_{}", names.angle()), json!(travel));
        }
        LawTerm::ViscousByDirection | LawTerm::Root | LawTerm::CommandLag => {}
    }
    map
}

/// `amplitude` with its unit.
fn amplitude_key(names: UnitNames, term: LawTerm) -> String {
    match term {
        LawTerm::ViscousByDirection => names.viscous_key("amplitude"),
        LawTerm::NearRest { .. } | LawTerm::AfterTravel { .. } | LawTerm::Ripple { .. } => {
            format!("amplitude_{}", names.torque())
        }
        LawTerm::Root => format!("amplitude_{}_per_root_{}_per_s", names.torque(), names.angle()),
        LawTerm::Bristles { .. } => format!("amplitude_{}", names.angle()),
        LawTerm::CommandLag => "amplitude_s".to_owned(),
    }
}
