//! Gravity of a load in JSON.

use lissom_core::identify::{Estimate, Gravity};
use serde::{Deserialize, Serialize};

use super::estimate_entry::EstimateEntry;
use super::unit_names::UnitNames;

/// The torque g_s*sin(q) + g_c*cos(q) of an unbalanced load, q the motor's angle as logged.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct GravityEntry {
    /// Coefficient g_s.
    pub sine: EstimateEntry,
    /// Coefficient g_c.
    pub cosine: EstimateEntry,
    /// Amplitude m*g*l, the root of the sum of both squares.
    pub amplitude: EstimateEntry,
    /// Phase of the torque m*g*l*sin(q + phase).
    pub phase_rad: EstimateEntry,
    /// Torque constant from m*g*l of the load; null unless the campaign gives m*g*l.
    pub torque_constant: Option<EstimateEntry>,
}

impl GravityEntry {
    /// The entry of a load.
    pub(crate) fn of(names: UnitNames, gravity: &Gravity, constant: Option<Estimate>) -> Self {
        Self {
            sine: EstimateEntry::of(gravity.sine, names.torque_unit()),
            cosine: EstimateEntry::of(gravity.cosine, names.torque_unit()),
            amplitude: EstimateEntry::of(gravity.amplitude(), names.torque_unit()),
            phase_rad: EstimateEntry::of(gravity.phase_rad(), "rad"),
            torque_constant: EstimateEntry::or_null(constant, names.torque_constant_unit()),
        }
    }
}
