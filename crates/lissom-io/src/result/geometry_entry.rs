//! An arm as described compared with the one that logs show, in JSON.

use lissom_core::identify::{ArmQuantity, Explanation, GeometryCheck};
use serde::{Deserialize, Serialize};

use super::estimate_entry::EstimateEntry;

/// The arm.toml that the campaign names compared with the arm found.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct GeometryEntry {
    /// Whether nothing is to be explained.
    pub agrees: bool,
    /// Root mean square of the relative differences of inertia, and frequency and coupling of each mode.
    pub difference_rms: f64,
    /// One number of the description at a time, the one that explains most first.
    pub explanations: Vec<ExplanationEntry>,
}

/// A number of the description that may be wrong.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ExplanationEntry {
    /// Which.
    pub quantity: ArmQuantityName,
    /// Its span, from 1; null where all spans together, or no span, are meant.
    pub span: Option<usize>,
    /// What it is relative to the description, if all else is right.
    pub factor: EstimateEntry,
    /// The root mean square of the differences then.
    pub left_rms: f64,
}

/// A number of an arm's description.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum ArmQuantityName {
    /// Length of a span.
    Length,
    /// Flexural rigidity of a span.
    FlexuralRigidity,
    /// Mass of a span.
    Mass,
    /// The payload.
    Payload,
    /// Inertia of the motor.
    MotorInertia,
}

impl GeometryEntry {
    /// The check, and every number that was let go.
    pub(crate) fn of(check: &GeometryCheck) -> Self {
        Self {
            agrees: check.agrees(),
            difference_rms: check.before,
            explanations: check.explanations.iter().map(ExplanationEntry::of).collect(),
        }
    }
}

impl ExplanationEntry {
    fn of(e: &Explanation) -> Self {
        let (quantity, span) = match e.quantity {
            ArmQuantity::Length(span) => (ArmQuantityName::Length, span),
            ArmQuantity::Stiffness(span) => (ArmQuantityName::FlexuralRigidity, span),
            ArmQuantity::Mass(span) => (ArmQuantityName::Mass, span),
            ArmQuantity::Payload => (ArmQuantityName::Payload, None),
            ArmQuantity::MotorInertia => (ArmQuantityName::MotorInertia, None),
        };
        Self {
            quantity,
            span: span.map(|i| i + 1),
            factor: EstimateEntry::of(e.factor),
            left_rms: e.left,
        }
    }
}
