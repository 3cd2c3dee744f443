//! A model as JSON.

use lissom::beam::{Mode, Property, RootClass, TruncatedBeam, Zeros, class};
use lissom::lti::StateSpace;
use num_complex::Complex64;
use serde_json::{Value, json};

use super::beam_model::{Function, Model, PayloadCase};
use super::model_responses::Responses;
use crate::arm_file::BeamKind;

/// The model as JSON, SI and rad/s throughout.
pub fn model_json(model: &Model) -> Value {
    let m = model.matrices.as_ref();
    let dimensions = model.kind != BeamKind::Modal;
    json!({
        "lissom": env!("CARGO_PKG_VERSION"),
        "kind": match model.kind {
            BeamKind::Lumped => "lumped",
            BeamKind::Distributed => "distributed",
            BeamKind::Modal => "modal",
        },
        "n": model.len(),
        "length_m": dimensions.then(|| model.length_m()),
        "hub_radius_m": dimensions.then_some(model.hub_radius_m),
        "mass_kg": model.mass_kg,
        "mass_along_kg": model.mass_along_kg,
        "position_m": model.position_m,
        "payload": dimensions.then(|| json!({
            "mass_kg": model.payload.mass_kg,
            "inertia_kg_m2": model.payload.inertia_kg_m2,
            "offset_m": model.payload.offset_m,
        })),
        "inertia_kg_m2": model.inertia_kg_m2,
        "ei_a": m.map(|m| rows(&m.ei_a)),
        "ei_b": m.map(|m| m.ei_b.as_slice()),
        "p": m.map(|m| m.p.as_slice()),
        "q": m.map(|m| m.q.as_slice()),
        "u": m.map(|m| rows(&m.u)),
        "h": m.map(|m| m.h.as_slice()),
        "h_motor": m.map(|m| m.h_motor),
        "h_torque": m.map(|m| m.h_torque),
        "natural_frequencies_rad_s": model.natural_frequencies_rad_s,
        "coupled_frequencies_rad_s": model.coupled_frequencies_rad_s,
        "modes": model.modes.as_ref().map(|modes| modes.iter().map(mode).collect::<Vec<_>>()),
        "tip_zeros": model.tip_zeros.as_ref().map(zeros),
        "transfer_functions": model.functions.iter().map(function).collect::<Vec<_>>(),
        "state_space": model.state_space.as_ref().map(state_space),
        "truncated": model.truncated.as_ref().map(truncated),
        "frequency_response": model.response.as_ref().map(responses),
        "payload_study": model.payload_study.as_ref().map(|cases| {
            cases.iter().map(payload_case).collect::<Vec<_>>()
        }),
        "properties": model.properties.as_ref().map(|all| {
            all.iter().map(property).collect::<Vec<_>>()
        }),
        "notes": model.notes,
        "warnings": model.warnings,
    })
}

/// A matrix as a list of rows.
pub(crate) fn rows(m: &lissom::Matrix) -> Vec<Vec<f64>> {
    m.row_iter().map(|r| r.iter().copied().collect()).collect()
}

/// Complex values; `null` where a part is not finite.
fn complex(list: &[Complex64]) -> Vec<Value> {
    list.iter().map(|v| json!({ "re": v.re, "im": v.im })).collect()
}

fn mode(m: &Mode) -> Value {
    json!({
        "natural_frequency_rad_s": m.natural_frequency_rad_s,
        "shape": m.shape,
        "share": m.share,
        "inertia_kg_m2": m.inertia_kg_m2,
    })
}

fn zeros(found: &Zeros) -> Value {
    let each = |z: &Complex64| json!({ "s_squared": { "re": z.re, "im": z.im }, "class": letter(class(*z)) });
    found.z.iter().map(each).collect()
}

fn letter(class: RootClass) -> String {
    class.letter().to_string()
}

fn function(f: &Function) -> Value {
    let polynomials = if f.lowest { None } else { f.roots.transfer_function() };
    // With zeros not looked for, only one that is found can tell.
    let minimum_phase = Some(f.roots.minimum_phase()).filter(|m| !(f.lowest && *m));
    json!({
        "from": f.from,
        "to": f.to,
        "num": polynomials.as_ref().map(|g| &g.num),
        "den": polynomials.as_ref().map(|g| &g.den),
        "zeros": complex(&f.roots.zeros),
        "poles": complex(&f.roots.poles),
        "gain": Some(f.roots.gain).filter(|_| !f.lowest),
        "minimum_phase": minimum_phase,
        "missing": f.roots.missing,
    })
}

/// A state space with the names of its states, inputs and outputs.
pub(crate) fn state_space(s: &StateSpace) -> Value {
    json!({
        "a": rows(&s.a),
        "b": rows(&s.b),
        "c": rows(&s.c),
        "d": rows(&s.d),
        "states": s.states,
        "inputs": s.inputs,
        "outputs": s.outputs,
    })
}

fn truncated(t: &TruncatedBeam) -> Value {
    json!({
        "points_m": t.points_m,
        "natural_frequencies_rad_s": t.natural_frequencies_rad_s,
        "a": rows(&t.a),
        "b": t.b.as_slice(),
        "h": t.h.as_slice(),
        "h_motor": t.h_motor,
        "residual_inertia_kg_m2": t.residual_inertia_kg_m2,
    })
}

fn payload_case(case: &PayloadCase) -> Value {
    json!({
        "tip_mass_kg": case.tip_mass_kg,
        "payload_inertia_kg_m2": case.inertia_kg_m2,
        "factor": case.factor,
        "natural_frequencies_rad_s": case.natural_frequencies_rad_s,
        "zeros": zeros(&case.zeros),
        "zero_shift": case.zero_shift,
    })
}

fn property(p: &Property) -> Value {
    json!({
        "name": p.name,
        "statement": p.statement,
        "measured": p.measured,
        "bound": p.bound,
        "holds": p.holds,
        "note": p.note,
    })
}

fn responses(r: &Responses) -> Value {
    json!({
        "omega_rad_s": r.omega_rad_s,
        "to": r.masses.iter().map(|i| format!("theta_{}", i + 1)).collect::<Vec<_>>(),
        "tips": r.tips.iter().map(|tip| complex(tip)).collect::<Vec<_>>(),
        "coupling_nm_per_rad": complex(&r.coupling),
        "motor_rad_per_a": r.motor.as_ref().map(|motor| complex(motor)),
    })
}
