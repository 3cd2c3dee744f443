//! The reference files.

use lissom::beam::{LumpedBeam, Payload, Span};
use num_complex::Complex64;
use serde_json::Value;

/// A file beside this one.
pub(crate) fn read(name: &str) -> Value {
    let path = format!("{}/tests/beam_reference/{name}", env!("CARGO_MANIFEST_DIR"));
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

pub(crate) fn cases(file: &Value) -> &[Value] {
    file["cases"].as_array().unwrap()
}

pub(crate) fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

pub(crate) fn complex(value: &Value) -> Complex64 {
    Complex64::new(value[0].as_f64().unwrap(), value[1].as_f64().unwrap())
}

pub(crate) fn list(value: &Value) -> Vec<Complex64> {
    value.as_array().unwrap().iter().map(complex).collect()
}

pub(crate) fn real(case: &Value, key: &str) -> f64 {
    case[key].as_f64().unwrap_or(0.0)
}

pub(crate) fn payload(case: &Value) -> Payload {
    Payload {
        mass_kg: real(case, "payload_mass_kg"),
        inertia_kg_m2: real(case, "payload_inertia_kg_m2"),
        offset_m: real(case, "payload_offset_m"),
    }
}

pub(crate) fn beam(case: &Value) -> LumpedBeam {
    let (l, m, ei) =
        (numbers(&case["lengths_m"]), numbers(&case["masses_kg"]), numbers(&case["ei_n_m2"]));
    let damping = case.get("damping_n_s_per_m").map(numbers);
    let spans: Vec<Span> = (0..l.len())
        .map(|i| Span {
            length_m: l[i],
            flexural_rigidity_n_m2: ei[i],
            mass_kg: m[i],
            damping_n_s_per_m: damping.as_ref().map_or(0.0, |d| d[i]),
        })
        .collect();
    let beam = LumpedBeam::new(&spans).unwrap();
    beam.with_hub_radius(real(case, "hub_radius_m"))
        .and_then(|b| b.with_payload(payload(case)))
        .unwrap()
}

/// Largest relative difference of two lists, each entry against itself.
pub(crate) fn entrywise(found: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len(), "{found:?} {expected:?}");
    let pairs = found.iter().zip(expected);
    pairs
        .map(|(f, e)| if f.total_cmp(e).is_eq() { 0.0 } else { (f - e).abs() / e.abs() })
        .fold(0.0, f64::max)
}

/// Largest relative distance of an expected root from the nearest found, as many being found.
pub(crate) fn nearest(found: &[Complex64], expected: &[Complex64]) -> f64 {
    assert_eq!(found.len(), expected.len(), "{found:?} {expected:?}");
    let distance = |e: &Complex64| {
        let least = found.iter().map(|f| (f - e).norm()).fold(f64::INFINITY, f64::min);
        least / e.norm().max(f64::MIN_POSITIVE)
    };
    expected.iter().map(distance).fold(0.0, f64::max)
}
