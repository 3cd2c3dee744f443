//! Another payload's prediction as JSON. Its schema is `docs/payload.schema.json`.

use lissom::identify::{Finding, LoadedArm, Response};
use serde_json::{Value, json};

use super::estimate_json::{figure, finding};

/// What was predicted from a campaign with one payload.
#[derive(Debug, Clone)]
pub struct PayloadPrediction {
    /// Tip that carries it.
    pub tip: String,
    /// Distance of its point from the axis \[m\]; `None` of linear axes.
    pub distance_m: Option<f64>,
    /// Payload that the campaign's runs were made with \[kg\].
    pub mass_kg: f64,
    /// Frequencies of the responses \[rad/s\].
    pub omega_rad_s: Vec<f64>,
    /// What was asked for, in its order.
    pub payloads: Vec<PredictedPayload>,
    /// What the identification found.
    pub findings: Vec<Finding>,
}

/// One of the payloads asked for.
#[derive(Debug, Clone)]
pub struct PredictedPayload {
    /// Its mass \[kg\].
    pub mass_kg: f64,
    /// The arm with it.
    pub loaded: LoadedArm,
    /// θ_i/θ_m of that tip.
    pub tip: Vec<Response>,
}

/// What `lissom payload` writes, SI and rad/s throughout.
pub fn payload_json(found: &PayloadPrediction) -> Value {
    let payload = |p: &PredictedPayload| {
        let modes = p.loaded.modes.iter().map(|mode| {
            json!({
                "natural_frequency_rad_s": figure(Some(mode.natural_frequency_rad_s)),
                "damping_ratio": figure(Some(mode.damping_ratio)),
            })
        });
        let response = |r: &Response| json!({ "re": r.value.re, "im": r.value.im, "std": r.std });
        json!({
            "mass_kg": p.mass_kg,
            "modes": modes.collect::<Vec<_>>(),
            "tip": p.tip.iter().map(response).collect::<Vec<_>>(),
        })
    };
    json!({
        "lissom": env!("CARGO_PKG_VERSION"),
        "tip": found.tip,
        "distance_m": found.distance_m,
        "mass_kg": found.mass_kg,
        "omega_rad_s": found.omega_rad_s,
        "payloads": found.payloads.iter().map(payload).collect::<Vec<_>>(),
        "findings": found.findings.iter().map(finding).collect::<Vec<_>>(),
    })
}
