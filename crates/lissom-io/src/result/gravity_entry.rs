//! A load of gravity, in JSON.

use lissom::identify::Gravity;
use serde::{Deserialize, Serialize};

use super::estimate_entry::EstimateEntry;
use super::unit_keys::{AmplitudeKey, CosineKey, SineKey, WithUnit};
use super::unit_names::UnitNames;

/// The torque g_s*sin(q) + g_c*cos(q) of an unbalanced load, q the motor's angle as logged.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct GravityEntry {
    /// g_s.
    #[serde(flatten)]
    pub sine: WithUnit<SineKey, EstimateEntry>,
    /// g_c.
    #[serde(flatten)]
    pub cosine: WithUnit<CosineKey, EstimateEntry>,
    /// m*g*l, the root of the sum of both squares.
    #[serde(flatten)]
    pub amplitude: WithUnit<AmplitudeKey, EstimateEntry>,
    /// The torque is m*g*l*sin(q + phase).
    pub phase_rad: EstimateEntry,
}

impl GravityEntry {
    /// The entry of a load.
    pub(crate) fn of(names: UnitNames, gravity: &Gravity) -> Self {
        Self {
            sine: WithUnit::new(names, EstimateEntry::of(gravity.sine)),
            cosine: WithUnit::new(names, EstimateEntry::of(gravity.cosine)),
            amplitude: WithUnit::new(names, EstimateEntry::of(gravity.amplitude())),
            phase_rad: EstimateEntry::of(gravity.phase_rad()),
        }
    }
}
