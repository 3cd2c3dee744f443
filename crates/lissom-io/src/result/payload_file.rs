//! Prediction of an arm with other payloads in JSON.

use lissom_core::identify::{Finding, LoadedArm, Response};
use serde::{Deserialize, Serialize};

use super::estimate_entry::BeamModeEntry;
use super::finding_entry::FindingEntry;

/// A prediction with other payloads, from a campaign with one payload.
#[derive(Debug, Clone)]
pub struct PayloadPrediction {
    /// Name of the tip at which the payload is fixed.
    pub tip: String,
    /// Distance of this point from the axis \[m\]; `None` for linear axes.
    pub distance_m: Option<f64>,
    /// Payload in the runs of the campaign \[kg\].
    pub mass_kg: f64,
    /// Frequencies of the responses \[rad/s\].
    pub omega_rad_s: Vec<f64>,
    /// The payloads asked for, in their order.
    pub payloads: Vec<PredictedPayload>,
    /// Findings of the identification.
    pub findings: Vec<Finding>,
}

/// One of the payloads asked for.
#[derive(Debug, Clone)]
pub struct PredictedPayload {
    /// Its mass \[kg\].
    pub mass_kg: f64,
    /// The arm with it.
    pub loaded: LoadedArm,
    /// Response θ_i/θ_m of this tip.
    pub tip: Vec<Response>,
}

/// An arm that was identified with one payload and predicted with others. SI units and rad/s.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PayloadFile {
    /// Version of lissom that wrote the file.
    pub lissom: String,
    /// Name of the tip at which the payload is fixed.
    pub tip: String,
    /// Distance of this point from the axis; null for linear axes.
    pub distance_m: Option<f64>,
    /// Payload in the runs of the campaign.
    pub mass_kg: f64,
    /// Frequencies of the responses.
    pub omega_rad_s: Vec<f64>,
    /// The payloads asked for.
    pub payloads: Vec<PayloadEntry>,
    /// Findings of the identification.
    pub findings: Vec<FindingEntry>,
}

/// A payload that was asked for.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PayloadEntry {
    /// Mass of the predicted payload.
    pub mass_kg: f64,
    /// Modes with the motor clamped, ascending.
    pub modes: Vec<BeamModeEntry>,
    /// Response of the tip per motor angle, at each frequency.
    pub tip: Vec<ResponseEntry>,
}

/// A response at one frequency.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ResponseEntry {
    /// Real part.
    pub re: f64,
    /// Imaginary part.
    pub im: f64,
    /// Standard error of the complex value, sqrt(E|G^ - G|^2).
    pub std: f64,
}

impl PayloadFile {
    /// The content that `lissom payload` writes.
    pub fn of(found: &PayloadPrediction) -> Self {
        Self {
            lissom: env!("CARGO_PKG_VERSION").to_owned(),
            tip: found.tip.clone(),
            distance_m: found.distance_m,
            mass_kg: found.mass_kg,
            omega_rad_s: found.omega_rad_s.clone(),
            payloads: found.payloads.iter().map(PayloadEntry::of).collect(),
            findings: FindingEntry::list(&found.findings),
        }
    }
}

impl PayloadEntry {
    fn of(p: &PredictedPayload) -> Self {
        let response = |r: &Response| ResponseEntry { re: r.value.re, im: r.value.im, std: r.std };
        Self {
            mass_kg: p.mass_kg,
            modes: BeamModeEntry::list(&p.loaded.modes),
            tip: p.tip.iter().map(response).collect(),
        }
    }
}
