//! `model.json`: a beam, and the arm that it makes with its drive, as numbers for programs.
//!
//! Its schema is `docs/model.schema.json`. A key is `null` where the model has no such thing or is
//! too large for it; a sentence in `notes` then says why.

mod frequencies;
mod response;

pub use frequencies::{FrequencyError, read_frequencies};
pub use response::Responses;

use lissom::beam::{BeamMatrices, Mode, Payload, Property, RootClass, TruncatedBeam, Zeros, class};
use lissom::lti::{StateSpace, ZeroPoleGain};
use num_complex::Complex64;
use serde_json::{Value, json};

use crate::arm_file::BeamKind;

/// Everything that `lissom model` finds out about a beam.
#[derive(Debug, Clone)]
pub struct Model {
    /// Where its mass is.
    pub kind: BeamKind,
    /// Point masses, base to tip \[kg\]; without the payload.
    pub mass_kg: Vec<f64>,
    /// Distance of each from the motor's axis \[m\].
    pub position_m: Vec<f64>,
    /// Mass along the spans \[kg\].
    pub mass_along_kg: f64,
    /// Distance of the clamp from the motor's axis \[m\].
    pub hub_radius_m: f64,
    /// What the tip carries beside the last mass.
    pub payload: Payload,
    /// Inertia about the motor's axis as one body \[kg·m²\].
    pub inertia_kg_m2: f64,
    /// The matrices of (10), (13) and (15).
    pub matrices: Option<BeamMatrices>,
    /// Natural frequencies with the motor clamped, ascending, damping left out \[rad/s\].
    pub natural_frequencies_rad_s: Vec<f64>,
    /// The same with the rotor free to turn; `None` without a drive.
    pub coupled_frequencies_rad_s: Option<Vec<f64>>,
    /// Modes with the motor clamped.
    pub modes: Option<Vec<Mode>>,
    /// Zeros of the tip's response, damping left out.
    pub tip_zeros: Option<Zeros>,
    /// Transfer functions.
    pub functions: Vec<Function>,
    /// The arm with its drive.
    pub state_space: Option<StateSpace>,
    /// A distributed beam by its first modes.
    pub truncated: Option<TruncatedBeam>,
    /// Responses at the frequencies asked for.
    pub response: Option<Responses>,
    /// The same beam with other loads.
    pub payload_study: Option<Vec<PayloadCase>>,
    /// Section 3, measured.
    pub properties: Option<Vec<Property>>,
    /// What is left out, and why.
    pub notes: Vec<String>,
    /// What the numbers cannot be trusted for.
    pub warnings: Vec<String>,
}

/// A transfer function and what it leads from and to.
#[derive(Debug, Clone, PartialEq)]
pub struct Function {
    /// `motor` or `current`.
    pub from: &'static str,
    /// `theta_1` …, `motor` or `coupling_torque`.
    pub to: String,
    /// Its zeros, poles and gain.
    pub roots: ZeroPoleGain,
    /// It has roots without end: these are the lowest, and neither gain nor polynomials exist.
    pub lowest: bool,
}

/// A beam with another load at its tip.
#[derive(Debug, Clone, PartialEq)]
pub struct PayloadCase {
    /// The load: the payload's mass where there is one, else the last mass \[kg\].
    pub tip_mass_kg: f64,
    /// Rotary inertia of the payload \[kg·m²\].
    pub inertia_kg_m2: f64,
    /// Load over that of the file; `None` where the file has none.
    pub factor: Option<f64>,
    /// Natural frequencies, motor clamped \[rad/s\].
    pub natural_frequencies_rad_s: Vec<f64>,
    /// Zeros of the tip's response.
    pub zeros: Zeros,
    /// Largest relative distance of a zero z = s² from that of the file's beam; `None` where their
    /// numbers differ.
    pub zero_shift: Option<f64>,
}

impl Model {
    /// Number of masses, of pieces of a distributed beam, or of points of one known by its modes.
    pub fn len(&self) -> usize {
        match self.kind {
            BeamKind::Modal => self.natural_frequencies_rad_s.len(),
            _ => self.position_m.len(),
        }
    }

    /// Never true of a beam.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Length from clamp to tip \[m\].
    pub fn length_m(&self) -> f64 {
        self.position_m.last().map_or(0.0, |tip| tip - self.hub_radius_m)
    }
}

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
        "frequency_response": model.response.as_ref().map(response::json),
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
