//! Gravity of a load in JSON.

use lissom_core::identify::{Estimate, Gravity};
use serde::{Deserialize, Serialize};

use super::estimate_entry::EstimateEntry;
use super::estimate_keys::Refusable;
use super::unit_keys::{AmplitudeKey, CosineKey, SineKey, TorqueConstantKey, WithUnit};
use super::unit_names::UnitNames;

/// The torque g_s*sin(q) + g_c*cos(q) of an unbalanced load, q the motor's angle as logged.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct GravityEntry {
    /// Coefficient g_s.
    #[serde(flatten)]
    pub sine: WithUnit<SineKey, EstimateEntry>,
    /// Coefficient g_c.
    #[serde(flatten)]
    pub cosine: WithUnit<CosineKey, EstimateEntry>,
    /// Amplitude m*g*l, the root of the sum of both squares.
    #[serde(flatten)]
    pub amplitude: WithUnit<AmplitudeKey, EstimateEntry>,
    /// Phase of the torque m*g*l*sin(q + phase).
    pub phase_rad: EstimateEntry,
    /// Torque constant from m*g*l of the load; null unless the campaign gives m*g*l.
    #[serde(flatten)]
    pub torque_constant: Refusable<TorqueConstantKey>,
}

impl GravityEntry {
    /// The entry of a load.
    pub(crate) fn of(names: UnitNames, gravity: &Gravity, constant: Option<Estimate>) -> Self {
        Self {
            sine: WithUnit::new(names, EstimateEntry::of(gravity.sine)),
            cosine: WithUnit::new(names, EstimateEntry::of(gravity.cosine)),
            amplitude: WithUnit::new(names, EstimateEntry::of(gravity.amplitude())),
            phase_rad: EstimateEntry::of(gravity.phase_rad()),
            torque_constant: WithUnit::new(names, EstimateEntry::or_null(constant)),
        }
    }
}
