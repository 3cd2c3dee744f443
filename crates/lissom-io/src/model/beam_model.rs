//! The model of a beam, as computed by `lissom model`.

use lissom_core::beam::{BeamMatrices, Mode, Payload, Property, TruncatedBeam, Zeros};
use lissom_core::lti::{StateSpace, ZeroPoleGain};

use super::model_responses::Responses;
use crate::arm_file::BeamKind;

/// The model of a beam, as computed by `lissom model`.
#[derive(Debug, Clone)]
pub struct Model {
    /// Where the mass of the beam is.
    pub kind: BeamKind,
    /// Point masses, base to tip \[kg\]; without the payload.
    pub mass_kg: Vec<f64>,
    /// Distance of each from the motor's axis \[m\].
    pub position_m: Vec<f64>,
    /// Mass along the spans \[kg\].
    pub mass_along_kg: f64,
    /// Distance of the clamp from the motor's axis \[m\].
    pub hub_radius_m: f64,
    /// Payload at the tip, in addition to the last mass.
    pub payload: Payload,
    /// Inertia of the whole beam about the motor's axis, as a rigid body \[kg·m²\].
    pub inertia_kg_m2: f64,
    /// The matrices of (10), (13) and (15).
    pub matrices: Option<BeamMatrices>,
    /// Natural frequencies with the motor clamped, ascending, without damping \[rad/s\].
    pub natural_frequencies_rad_s: Vec<f64>,
    /// The same with the rotor free to turn; `None` without a drive.
    pub coupled_frequencies_rad_s: Option<Vec<f64>>,
    /// Modes with the motor clamped.
    pub modes: Option<Vec<Mode>>,
    /// Zeros of the tip's response, without damping.
    pub tip_zeros: Option<Zeros>,
    /// Transfer functions.
    pub functions: Vec<Function>,
    /// State space of the arm with its drive.
    pub state_space: Option<StateSpace>,
    /// A model of the first modes of a distributed beam.
    pub truncated: Option<TruncatedBeam>,
    /// Responses at the frequencies asked for.
    pub response: Option<Responses>,
    /// The same beam with other loads.
    pub payload_study: Option<Vec<PayloadCase>>,
    /// Properties of Section 3 of the 1989 report, checked.
    pub properties: Option<Vec<Property>>,
    /// What is not given, and why.
    pub notes: Vec<String>,
    /// What is not reliable.
    pub warnings: Vec<String>,
}

/// A transfer function, with its input and output.
#[derive(Debug, Clone, PartialEq)]
pub struct Function {
    /// Input: `motor` or `current`.
    pub from: &'static str,
    /// Output: `theta_1` …, `motor` or `coupling_torque`.
    pub to: String,
    /// Its zeros, poles and gain.
    pub roots: ZeroPoleGain,
    /// Whether it has infinitely many roots, of which these are the lowest; then it has no gain and no polynomials.
    pub lowest: bool,
}

/// A beam with another load at its tip.
#[derive(Debug, Clone, PartialEq)]
pub struct PayloadCase {
    /// The load \[kg\]: the payload's mass if there is one, otherwise the last mass.
    pub tip_mass_kg: f64,
    /// Rotary inertia of the payload \[kg·m²\].
    pub inertia_kg_m2: f64,
    /// Load relative to the load in the file; `None` if the file has none.
    pub factor: Option<f64>,
    /// Natural frequencies, motor clamped \[rad/s\].
    pub natural_frequencies_rad_s: Vec<f64>,
    /// Zeros of the tip's response.
    pub zeros: Zeros,
    /// Largest relative distance of a zero z = s² from that with the load in the file; `None` if the numbers of zeros
    /// differ.
    pub zero_shift: Option<f64>,
}

impl Model {
    /// Number of masses, of spans of a distributed beam, or of points of a beam given by its modes.
    pub fn len(&self) -> usize {
        match self.kind {
            BeamKind::Modal => self.natural_frequencies_rad_s.len(),
            _ => self.position_m.len(),
        }
    }

    /// Always false: a beam has at least one mass or point.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Length from clamp to tip \[m\].
    pub fn length_m(&self) -> f64 {
        self.position_m.last().map_or(0.0, |tip| tip - self.hub_radius_m)
    }
}
