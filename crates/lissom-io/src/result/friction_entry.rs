//! Friction as it was identified, in JSON.

use lissom::identify::{CurvePoint, Friction, Identified, NearRestEstimate, RippleEstimate};
use serde::{Deserialize, Serialize};

use super::channel_names::{DirectionName, FalloffName};
use super::estimate_entry::EstimateEntry;
use super::unit_keys::{
    AmplitudeKey, BackwardKey, CoulombKey, ForwardKey, FrictionKey, OffsetKey, PeriodKey, SpeedKey,
    ViscousBackwardKey, ViscousForwardKey, ViscousKey, WithUnit,
};
use super::unit_names::UnitNames;

/// An estimate that may be refused, under a key with its unit.
pub type Refusable<Q> = WithUnit<Q, Option<EstimateEntry>>;

/// An estimate under a key with its unit.
pub type Estimated<Q> = WithUnit<Q, EstimateEntry>;

/// Coulomb friction by direction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct CoulombEntry {
    /// Mean of both directions.
    #[serde(flatten)]
    pub coulomb: Refusable<CoulombKey>,
    /// While moving forward.
    #[serde(flatten)]
    pub forward: Refusable<ForwardKey>,
    /// While moving backward.
    #[serde(flatten)]
    pub backward: Refusable<BackwardKey>,
    /// (forward - backward)/2.
    #[serde(flatten)]
    pub offset: Refusable<OffsetKey>,
}

/// Friction by the best method that the data allow.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FrictionEntry {
    /// Coulomb friction.
    #[serde(flatten)]
    pub coulomb: CoulombEntry,
    /// Viscous friction, back-EMF taken out where its constant is given.
    #[serde(flatten)]
    pub viscous: Refusable<ViscousKey>,
    /// Viscous friction forward; absent unless the data reject one constant.
    #[serde(flatten)]
    pub viscous_forward: Estimated<ViscousForwardKey>,
    /// Viscous friction backward; absent unless the data reject one constant.
    #[serde(flatten)]
    pub viscous_backward: Estimated<ViscousBackwardKey>,
    /// What friction has near rest beyond Coulomb friction; absent unless the data call for it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub near_rest: Option<NearRestEntry>,
    /// Waves of friction over the travel, s*A*cos(2*pi*x/period + phase); absent unless the data show them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ripples: Vec<RippleEntry>,
    /// Friction against speed without a law, ascending in speed, forward then backward; speeds that no slip phase
    /// holds are not there.
    pub curve: Vec<CurvePointEntry>,
}

/// s*A*exp(-|v|/v_s) or s*A*exp(-(v/v_s)^2), s the direction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct NearRestEntry {
    /// A: friction at rest is Coulomb friction and this.
    #[serde(flatten)]
    pub amplitude: Refusable<AmplitudeKey>,
    /// v_s.
    #[serde(flatten)]
    pub speed: Estimated<SpeedKey>,
    /// Which of the two.
    pub falloff: FalloffName,
}

/// A wave of friction over the travel.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RippleEntry {
    /// A.
    #[serde(flatten)]
    pub amplitude: Refusable<AmplitudeKey>,
    /// Its period.
    #[serde(flatten)]
    pub period: Estimated<PeriodKey>,
}

/// A point of the friction curve.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct CurvePointEntry {
    /// Direction of motion.
    pub direction: DirectionName,
    /// Magnitude of the velocity.
    #[serde(flatten)]
    pub speed: WithUnit<SpeedKey, f64>,
    /// Friction against the motion.
    #[serde(flatten)]
    pub friction: Refusable<FrictionKey>,
    /// Windows about this speed.
    pub windows: usize,
}

impl CoulombEntry {
    /// The Coulomb part of friction; `constant` is torque per command.
    pub(crate) fn of(names: UnitNames, constant: f64, f: &Friction) -> Self {
        Self {
            coulomb: WithUnit::torque(names, constant, f.coulomb),
            forward: WithUnit::torque(names, constant, f.forward),
            backward: WithUnit::torque(names, constant, f.backward),
            offset: WithUnit::torque(names, constant, f.offset),
        }
    }
}

impl FrictionEntry {
    /// Friction of a result; `constant` is torque per command.
    pub(crate) fn of(names: UnitNames, constant: f64, id: &Identified) -> Self {
        let f = &id.friction;
        let (forward, backward) = f.viscous_by_direction.unzip();
        let curve = id.friction_law.as_ref().map_or(&[][..], |law| &law.curve);
        Self {
            coulomb: CoulombEntry::of(names, constant, f),
            viscous: WithUnit::new(names, EstimateEntry::or_null(f.viscous)),
            viscous_forward: WithUnit::where_some(names, EstimateEntry::or_null(forward)),
            viscous_backward: WithUnit::where_some(names, EstimateEntry::or_null(backward)),
            near_rest: f.near_rest.map(|near| NearRestEntry::of(names, constant, near)),
            ripples: f.ripples.iter().map(|r| RippleEntry::of(names, constant, *r)).collect(),
            curve: curve.iter().map(|p| CurvePointEntry::of(names, constant, p)).collect(),
        }
    }
}

impl NearRestEntry {
    fn of(names: UnitNames, constant: f64, near: NearRestEstimate) -> Self {
        Self {
            amplitude: WithUnit::torque(names, constant, Some(near.torque)),
            speed: WithUnit::new(names, EstimateEntry::of(near.speed)),
            falloff: FalloffName::of(near.falloff),
        }
    }
}

impl RippleEntry {
    fn of(names: UnitNames, constant: f64, ripple: RippleEstimate) -> Self {
        Self {
            amplitude: WithUnit::torque(names, constant, Some(ripple.torque)),
            period: WithUnit::new(names, EstimateEntry::of(ripple.period())),
        }
    }
}

impl CurvePointEntry {
    fn of(names: UnitNames, constant: f64, p: &CurvePoint) -> Self {
        Self {
            direction: DirectionName::of(p.direction > 0.0),
            speed: WithUnit::new(names, p.speed),
            friction: WithUnit::torque(names, constant, Some(p.friction)),
            windows: p.windows,
        }
    }
}
