//! Comparison of the identified arm with an arm.toml, in JSON.

use lissom_core::identify::{ArmQuantity, Explanation, GeometryCheck};
use serde::{Deserialize, Serialize};

use super::estimate_entry::EstimateEntry;

/// Comparison of the identified arm with the arm.toml that the campaign gives.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct GeometryEntry {
    /// Whether both arms agree, so that nothing has to be explained.
    pub agrees: bool,
    /// Root mean square of the relative differences of inertia, and frequency and coupling of each mode.
    pub difference_rms: f64,
    /// Numbers of the arm.toml, each changed alone; the one that explains most is first.
    pub explanations: Vec<ExplanationEntry>,
}

/// A number of the arm.toml that may be wrong.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ExplanationEntry {
    /// The quantity.
    pub quantity: ArmQuantityName,
    /// Its span, from 1; null for all spans together, or for a quantity that belongs to no span.
    pub span: Option<usize>,
    /// Its value relative to the arm.toml, if all other numbers are correct.
    pub factor: EstimateEntry,
    /// Root mean square of the differences with this value.
    pub left_rms: f64,
    /// Whether it explains the differences as well as the first number, or nearly as well.
    pub as_good_as_first: bool,
}

/// A quantity of an arm.toml.
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
    /// The entry of a comparison, with every number that was changed.
    pub fn of(check: &GeometryCheck) -> Self {
        let as_good = check.as_good().count();
        let explanations = check.explanations.iter().enumerate();
        let explanations = explanations.map(|(k, e)| ExplanationEntry::of(e, k < as_good));
        Self {
            agrees: check.agrees(),
            difference_rms: check.before,
            explanations: explanations.collect(),
        }
    }
}

impl ExplanationEntry {
    fn of(e: &Explanation, as_good_as_first: bool) -> Self {
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
            factor: EstimateEntry::of(e.factor, "1"),
            left_rms: e.left,
            as_good_as_first,
        }
    }
}
