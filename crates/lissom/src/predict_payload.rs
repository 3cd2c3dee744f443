//! An arm that was identified with one payload, predicted with others.

use lissom_core::identify::{Identified, LoadedArm, OutputError};
use lissom_core::record::{Axis, Channels};
use lissom_io::{PayloadPrediction, PredictedPayload};
use thiserror::Error;

/// Number of logarithmic steps in the frequencies of the responses.
const FREQUENCIES: i32 = 400;
/// Factor by which the responses extend beyond the modes on both sides.
const PLOTTED_BEYOND: f64 = 3.0;

/// Which payloads to predict.
#[derive(Debug, Clone, PartialEq)]
pub struct Payloads {
    /// Payload in the logged runs \[kg\].
    pub mass_kg: f64,
    /// Payloads to predict \[kg\].
    pub to_kg: Vec<f64>,
    /// Distance of the payload from a rotary axis \[m\].
    pub at_m: Option<f64>,
    /// Tip at which it is fixed; the last one if `None`.
    pub tip: Option<String>,
}

impl Payloads {
    /// The tip at which the payload is, and its distance from a rotary axis \[m\].
    ///
    /// # Errors
    /// [`PayloadError`] if the channels do not fit.
    pub fn place(&self, channels: &Channels) -> Result<(usize, Option<f64>), PayloadError> {
        let last = channels.tips.len().checked_sub(1).ok_or(PayloadError::NoTip)?;
        let tip = match &self.tip {
            None => last,
            Some(name) => {
                channels.tips.iter().position(|tip| tip.name == *name).ok_or_else(|| {
                    let tips = channels.tips.iter().map(|tip| tip.name.clone()).collect();
                    PayloadError::UnknownTip { name: name.clone(), tips }
                })?
            }
        };
        match (channels.axis, self.at_m) {
            (Axis::Rotary, None) => Err(PayloadError::NoDistance),
            (Axis::Linear, Some(_)) => Err(PayloadError::LinearAxis),
            (_, distance_m) => Ok((tip, distance_m)),
        }
    }
}

/// Why no payload can be predicted.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum PayloadError {
    /// The campaign has no tip.
    #[error("has no tip")]
    NoTip,
    /// No tip has this name.
    #[error("\"{name}\" is none of the tips of the campaign: {}", tips.join(", "))]
    UnknownTip {
        /// The name.
        name: String,
        /// The tips.
        tips: Vec<String>,
    },
    /// A rotary axis without the distance of the payload.
    #[error("the distance of the payload from the axis is not given")]
    NoDistance,
    /// A linear axis with such a distance.
    #[error("a distance from a rotary axis is given, but this axis is linear")]
    LinearAxis,
    /// No arm of the output-error method is accepted.
    #[error("no identified arm describes the runs")]
    NoArm,
    /// The arm cannot carry this payload.
    #[error("{to_kg} kg instead of {mass_kg} kg cannot be predicted")]
    Mass {
        /// The payload asked for \[kg\].
        to_kg: f64,
        /// The payload in the runs \[kg\].
        mass_kg: f64,
    },
    /// The standard error of a response cannot be computed.
    #[error("the standard error of the response with {to_kg} kg cannot be computed")]
    Uncertain {
        /// The payload asked for \[kg\].
        to_kg: f64,
    },
}

impl PayloadError {
    /// What the user can do.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::NoTip => "add the tip at which the payload is fixed to the signals",
            Self::UnknownTip { .. } => "give one of these names",
            Self::NoDistance => {
                "give it: the payload's inertia is its mass times the square of this distance"
            }
            Self::LinearAxis => "leave it out",
            Self::NoArm => "read the findings of the identification of this campaign",
            Self::Mass { .. } => {
                "check mass and distance: the identified arm has less inertia at this point than they remove"
            }
            Self::Uncertain { .. } => {
                "add runs that excite the modes: the identified arm is too uncertain"
            }
        }
    }
}

/// Predicts the modes and the response of a tip with other payloads.
///
/// A payload is a point mass m at the distance r from the axis: it changes the inertia of the tip by `Δm·r²` (its mass by
/// `Δm` on a linear axis). The standard errors are those of the identified arm.
///
/// # Errors
/// [`PayloadError`] if the place of the payload is not known, or no arm was identified that can be changed so.
pub fn predict_payload(
    channels: &Channels,
    id: &Identified,
    asked: &Payloads,
) -> Result<PayloadPrediction, PayloadError> {
    let (tip, distance_m) = asked.place(channels)?;
    let stands = |oe: &&OutputError| oe.stands() && channels.tips[tip].calibrated;
    let oe = id.output_error.as_ref().filter(stands).ok_or(PayloadError::NoArm)?;
    // What a mass adds to the inertia of the point, on a linear axis to its mass.
    let added = |mass_kg: f64| distance_m.map_or(mass_kg, |r| mass_kg * r * r);
    let load = |to_kg: &f64| -> Result<LoadedArm, PayloadError> {
        let error = PayloadError::Mass { to_kg: *to_kg, mass_kg: asked.mass_kg };
        oe.with_load(tip, added(to_kg - asked.mass_kg)).ok_or(error)
    };
    let loaded = asked.to_kg.iter().map(load).collect::<Result<Vec<_>, _>>()?;
    let omega = loaded.iter().flat_map(|l| l.modes.iter().map(|m| m.natural_frequency_rad_s.value));
    let (low, high) = omega.fold((f64::INFINITY, 0.0_f64), |(a, b), w| (a.min(w), b.max(w)));
    let (low, high) = (low / PLOTTED_BEYOND, high * PLOTTED_BEYOND);
    let step = |k: i32| low * (high / low).powf(f64::from(k) / f64::from(FREQUENCIES));
    let omega_rad_s: Vec<f64> = (0..=FREQUENCIES).map(step).collect();
    let mut payloads = Vec::new();
    for (mass_kg, loaded) in asked.to_kg.iter().copied().zip(loaded) {
        let at = (tip, loaded.added_kg_m2);
        let response = oe.loaded_tip_response(at, tip, &omega_rad_s);
        let response = response.ok_or(PayloadError::Uncertain { to_kg: mass_kg })?;
        payloads.push(PredictedPayload { mass_kg, loaded, tip: response });
    }
    let caveat = payloads.first().map(|p| p.loaded.caveat());
    Ok(PayloadPrediction {
        tip: channels.tips[tip].name.clone(),
        distance_m,
        mass_kg: asked.mass_kg,
        omega_rad_s,
        payloads,
        findings: caveat.into_iter().chain(id.findings.iter().cloned()).collect(),
    })
}
