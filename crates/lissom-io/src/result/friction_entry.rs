//! Identified friction in JSON.

use lissom_core::identify::{CurvePoint, Estimate, Friction, Identified, LawEstimates};
use serde::{Deserialize, Serialize};

use super::channel_names::{AxisName, DirectionName};
use super::estimate_entry::EstimateEntry;
use super::estimate_keys::{Estimated, Refusable};
use super::friction_term_entries::FrictionTermsEntry;
use super::unit_keys::{
    BackwardKey, CoulombKey, ForwardKey, FrictionKey, OffsetKey, SpeedKey, SpeedRangeKey,
    ViscousBackwardKey, ViscousForwardKey, ViscousKey, WithUnit,
};
use super::unit_names::UnitNames;

/// Coulomb friction by direction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct CoulombEntry {
    /// Coulomb friction, mean of both directions.
    #[serde(flatten)]
    pub coulomb: Refusable<CoulombKey>,
    /// Coulomb friction while moving forward.
    #[serde(flatten)]
    pub forward: Refusable<ForwardKey>,
    /// Coulomb friction while moving backward.
    #[serde(flatten)]
    pub backward: Refusable<BackwardKey>,
    /// (forward - backward)/2.
    #[serde(flatten)]
    pub offset: Refusable<OffsetKey>,
}

/// Friction, from the best method that the data allow.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FrictionEntry {
    /// Coulomb friction.
    #[serde(flatten)]
    pub coulomb: CoulombEntry,
    /// Viscous friction, without back-EMF if its constant is given.
    #[serde(flatten)]
    pub viscous: Refusable<ViscousKey>,
    /// The law of friction, if it has terms beyond Coulomb and viscous friction; these are then the line that is nearest to it at
    /// the speeds of the log, without a load, weighted with time.
    pub law: Option<LawEntry>,
    /// Friction against speed without a law, ascending in speed, forward then backward; only speeds at which slip
    /// phases have data.
    pub curve: Vec<CurvePointEntry>,
}

/// A law of friction with its own values, which predict friction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LawEntry {
    /// Smallest and largest speed for which it was found; absent if they are unknown.
    #[serde(flatten)]
    pub speed_range: WithUnit<SpeedRangeKey, [f64; 2]>,
    /// Its Coulomb friction.
    #[serde(flatten)]
    pub coulomb: CoulombEntry,
    /// Its viscous friction, without back-EMF if its constant is given.
    #[serde(flatten)]
    pub viscous: Refusable<ViscousKey>,
    /// Viscous friction forward; absent unless the data reject one value for both directions.
    #[serde(flatten)]
    pub viscous_forward: Estimated<ViscousForwardKey>,
    /// Viscous friction backward; absent unless the data reject one value for both directions.
    #[serde(flatten)]
    pub viscous_backward: Estimated<ViscousBackwardKey>,
    /// Its further terms.
    #[serde(flatten)]
    pub terms: FrictionTermsEntry,
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
    /// Number of windows around this speed.
    pub windows: usize,
}

impl CoulombEntry {
    /// The entry of Coulomb friction; `constant` is torque per command.
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
    /// The units of an axis of this kind, by the keys of Coulomb friction.
    pub(super) fn names(&self, axis: AxisName) -> Option<UnitNames> {
        let of_axis = |names: &&UnitNames| AxisName::of(names.axis) == axis;
        let all = UnitNames::ALL.iter().filter(of_axis);
        all.copied().find(|names| self.coulomb.coulomb.has_keys_of(*names))
    }

    /// Friction against the motion at a speed in a direction, without ripples and without a load; positive if it brakes. `None`
    /// if one of its parameters is refused.
    pub fn at(&self, names: UnitNames, speed: f64, direction: DirectionName) -> Option<f64> {
        if let Some(law) = &self.law {
            return law.at(names, speed, direction);
        }
        let viscous = value(self.viscous.get(names))?;
        Some(self.coulomb.one_way(names, direction)? + viscous * speed)
    }

    /// The entry of a result's friction; `constant` is torque per command.
    pub(crate) fn of(names: UnitNames, constant: f64, id: &Identified) -> Self {
        let f = &id.friction;
        let found = id.friction_law.as_ref();
        let curve = found.map_or(&[][..], |law| &law.curve);
        let speeds = found.map(|law| law.speed_range);
        Self {
            coulomb: CoulombEntry::of(names, constant, f),
            viscous: WithUnit::new(names, EstimateEntry::or_null(f.viscous)),
            law: f.law.as_ref().map(|law| LawEntry::of(names, constant, law, f.offset, speeds)),
            curve: curve
                .iter()
                .filter(|p| p.friction.value.is_finite() && p.friction.std.is_finite())
                .map(|p| CurvePointEntry::of(names, constant, p))
                .collect(),
        }
    }
}

impl CoulombEntry {
    /// Coulomb friction in a direction; `None` if it is refused.
    fn one_way(&self, names: UnitNames, direction: DirectionName) -> Option<f64> {
        match direction {
            DirectionName::Forward => value(self.forward.get(names)),
            DirectionName::Backward => value(self.backward.get(names)),
        }
    }
}

/// The value of an estimate that is not refused.
fn value(entry: Option<&Option<EstimateEntry>>) -> Option<f64> {
    Some(entry?.as_ref()?.value)
}

impl LawEntry {
    fn at(&self, names: UnitNames, speed: f64, direction: DirectionName) -> Option<f64> {
        let one_way = match direction {
            DirectionName::Forward => self.viscous_forward.get(names),
            DirectionName::Backward => self.viscous_backward.get(names),
        };
        let viscous = match one_way {
            Some(viscous) => viscous.value,
            None => value(self.viscous.get(names))?,
        };
        let near = self.terms.near_rest.as_ref().map_or(Some(0.0), |near| {
            let share = near.falloff.falloff().share(speed / near.speed.get(names)?.value);
            Some(value(near.amplitude.get(names))? * share)
        });
        let root = self.terms.root.get(names).map_or(0.0, |root| root.value * speed.sqrt());
        Some(self.coulomb.one_way(names, direction)? + viscous * speed + near? + root)
    }

    fn of(
        names: UnitNames,
        constant: f64,
        law: &LawEstimates,
        offset: Option<Estimate>,
        speeds: Option<[f64; 2]>,
    ) -> Self {
        let (forward, backward) = law.viscous_by_direction.unzip();
        let coulomb = Friction {
            coulomb: law.coulomb,
            forward: law.forward,
            backward: law.backward,
            offset,
            ..Friction::default()
        };
        Self {
            speed_range: WithUnit::where_some(names, speeds),
            coulomb: CoulombEntry::of(names, constant, &coulomb),
            viscous: WithUnit::new(names, EstimateEntry::or_null(law.viscous)),
            viscous_forward: WithUnit::where_some(names, EstimateEntry::or_null(forward)),
            viscous_backward: WithUnit::where_some(names, EstimateEntry::or_null(backward)),
            terms: FrictionTermsEntry::of(names, constant, law),
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
