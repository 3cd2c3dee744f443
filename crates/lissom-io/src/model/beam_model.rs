//! What `lissom model` finds out about a beam.

use lissom_core::beam::{BeamMatrices, Mode, Payload, Property, TruncatedBeam, Zeros};
use lissom_core::lti::{StateSpace, ZeroPoleGain};

use super::model_responses::Responses;
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
