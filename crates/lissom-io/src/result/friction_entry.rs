//! Identified friction in JSON.

use lissom_core::identify::{CurvePoint, Estimate, Friction, Identified, LawEstimates};
use serde::{Deserialize, Serialize};

use super::channel_names::DirectionName;
use super::estimate_entry::{EstimateEntry, NumberEntry};
use super::friction_term_entries::FrictionTermsEntry;
use super::unit_names::UnitNames;

/// Coulomb friction by direction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct CoulombEntry {
    /// Coulomb friction, mean of both directions.
    pub coulomb: Option<EstimateEntry>,
    /// Coulomb friction while moving forward.
    pub forward: Option<EstimateEntry>,
    /// Coulomb friction while moving backward.
    pub backward: Option<EstimateEntry>,
    /// (forward - backward)/2.
    pub offset: Option<EstimateEntry>,
}

/// Friction, from the best method that the data allow.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FrictionEntry {
    /// Coulomb friction.
    #[serde(flatten)]
    pub coulomb: CoulombEntry,
    /// Viscous friction, without back-EMF if its constant is given.
    pub viscous: Option<EstimateEntry>,
    /// Slowest and fastest speed at which Coulomb and viscous friction hold: those of the windows that they are estimated in, or,
    /// where they stand for a law, those of the motion; absent if no method knows them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub speed_range: Option<NumberEntry<[f64; 2]>>,
    /// The law of friction, if it has terms beyond Coulomb and viscous friction; these are then the line that is nearest to it at
    /// the speeds and under the mean load of the log, weighted with time.
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
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub speed_range: Option<NumberEntry<[f64; 2]>>,
    /// Its Coulomb friction.
    #[serde(flatten)]
    pub coulomb: CoulombEntry,
    /// Its viscous friction, without back-EMF if its constant is given.
    pub viscous: Option<EstimateEntry>,
    /// Viscous friction forward; absent unless the data reject one value for both directions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub viscous_forward: Option<EstimateEntry>,
    /// Viscous friction backward; absent unless the data reject one value for both directions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub viscous_backward: Option<EstimateEntry>,
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
    pub speed: NumberEntry,
    /// Friction against the motion.
    pub friction: Option<EstimateEntry>,
    /// Number of windows around this speed.
    pub windows: usize,
}

impl CoulombEntry {
    /// The entry of Coulomb friction.
    pub(crate) fn of(names: UnitNames, f: &Friction) -> Self {
        Self {
            coulomb: EstimateEntry::or_null(f.coulomb, names.torque_unit()),
            forward: EstimateEntry::or_null(f.forward, names.torque_unit()),
            backward: EstimateEntry::or_null(f.backward, names.torque_unit()),
            offset: EstimateEntry::or_null(f.offset, names.torque_unit()),
        }
    }
}

impl FrictionEntry {
    /// Friction against the motion at a speed in a direction, without ripples and without a load; positive if it brakes. `None`
    /// if one of its parameters is refused.
    pub fn at(&self, speed: f64, direction: DirectionName) -> Option<f64> {
        if let Some(law) = &self.law {
            return law.at(speed, direction);
        }
        let viscous = self.viscous.as_ref()?.value;
        Some(self.coulomb.one_way(direction)? + viscous * speed)
    }

    /// The entry of a result's friction.
    pub(crate) fn of(names: UnitNames, id: &Identified) -> Self {
        let f = &id.friction;
        let found = id.friction_law.as_ref();
        let curve = found.map_or(&[][..], |law| &law.curve);
        let speeds = found.map(|law| law.speed_range);
        let of_line = id.speeds_of_line();
        Self {
            coulomb: CoulombEntry::of(names, f),
            viscous: EstimateEntry::or_null(f.viscous, names.viscous_unit()),
            speed_range: of_line.map(|v| NumberEntry::of(v, names.speed_unit())),
            law: f.law.as_ref().map(|law| LawEntry::of(names, law, f.offset, speeds)),
            curve: curve
                .iter()
                .filter(|p| p.friction.value.is_finite() && p.friction.std.is_finite())
                .map(|p| CurvePointEntry::of(names, p))
                .collect(),
        }
    }
}

impl CoulombEntry {
    /// Coulomb friction in a direction; `None` if it is refused.
    fn one_way(&self, direction: DirectionName) -> Option<f64> {
        let entry = match direction {
            DirectionName::Forward => &self.forward,
            DirectionName::Backward => &self.backward,
        };
        Some(entry.as_ref()?.value)
    }
}

impl LawEntry {
    fn at(&self, speed: f64, direction: DirectionName) -> Option<f64> {
        let one_way = match direction {
            DirectionName::Forward => &self.viscous_forward,
            DirectionName::Backward => &self.viscous_backward,
        };
        let viscous = one_way.as_ref().or(self.viscous.as_ref())?.value;
        let near = self.terms.near_rest.as_ref().map_or(Some(0.0), |near| {
            let share = near.falloff.share(speed / near.speed.value);
            Some(near.amplitude.as_ref()?.value * share)
        });
        let root = self.terms.root.as_ref().map_or(0.0, |root| root.value * speed.sqrt());
        Some(self.coulomb.one_way(direction)? + viscous * speed + near? + root)
    }

    fn of(
        names: UnitNames,
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
            speed_range: speeds.map(|v| NumberEntry::of(v, names.speed_unit())),
            coulomb: CoulombEntry::of(names, &coulomb),
            viscous: EstimateEntry::or_null(law.viscous, names.viscous_unit()),
            viscous_forward: EstimateEntry::or_null(forward, names.viscous_unit()),
            viscous_backward: EstimateEntry::or_null(backward, names.viscous_unit()),
            terms: FrictionTermsEntry::of(names, law),
        }
    }
}

impl CurvePointEntry {
    fn of(names: UnitNames, p: &CurvePoint) -> Self {
        Self {
            direction: DirectionName::of(p.direction > 0.0),
            speed: NumberEntry::of(p.speed, names.speed_unit()),
            friction: Some(EstimateEntry::of(p.friction, names.torque_unit())),
            windows: p.windows,
        }
    }
}
