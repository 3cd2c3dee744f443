//! Friction from constant velocities in JSON.

use lissom_core::identify::{ConstantVelocity, FrictionLine, LineShape, RunAnalysis, SteadyPoint};
use serde::{Deserialize, Serialize};

use super::channel_names::DirectionName;
use super::estimate_entry::{EstimateEntry, NumberEntry};
use super::unit_names::UnitNames;

/// Friction from constant velocities, extrapolated to zero speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ConstantVelocityEntry {
    /// Coulomb friction, mean of both directions.
    pub coulomb: Option<EstimateEntry>,
    /// Coulomb friction while moving forward.
    pub forward: Option<EstimateEntry>,
    /// Coulomb friction while moving backward.
    pub backward: Option<EstimateEntry>,
    /// (forward - backward)/2.
    pub offset: Option<EstimateEntry>,
    /// Viscous friction, mean of both directions.
    pub viscous: Option<EstimateEntry>,
    /// Damping by back-EMF that the campaign gives, which the slopes do not contain.
    pub back_emf: NumberEntry,
    /// The straight line for each direction that has one.
    pub lines: Vec<FrictionLineEntry>,
    /// Stretches at a constant velocity.
    pub points: Vec<SteadyPointEntry>,
}

/// A straight line of friction over speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FrictionLineEntry {
    /// Direction of motion.
    pub direction: DirectionName,
    /// The line extrapolated to zero speed.
    pub coulomb: Option<EstimateEntry>,
    /// Its slope, without back-EMF.
    pub viscous: EstimateEntry,
    /// Correlation of both estimates.
    pub correlation: f64,
    /// Number of stretches.
    pub points: usize,
    /// Number of different speeds.
    pub speeds: usize,
    /// Whether a straight line describes them.
    pub shape: LineShapeName,
    /// Size of the quadratic term, or of the scatter (rms), in standard errors; null if a straight line describes them.
    pub standard_errors: Option<f64>,
    /// The value extrapolated from the slowest third of the speeds.
    pub slowest: Option<EstimateEntry>,
}

/// Whether a straight line describes friction over speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum LineShapeName {
    /// There are too few speeds for a test.
    Unchecked,
    /// A straight line describes it.
    Straight,
    /// Friction grows less than in proportion at high speeds.
    Concave,
    /// Friction grows more than in proportion at high speeds.
    Convex,
    /// The points scatter beyond their standard errors.
    Scattered,
}

/// A stretch at a constant velocity.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SteadyPointEntry {
    /// Its run.
    pub run: String,
    /// Direction of motion.
    pub direction: DirectionName,
    /// Its start, from the first sample of the run.
    pub start_s: f64,
    /// Its end.
    pub end_s: f64,
    /// Velocity with its sign.
    pub velocity: EstimateEntry,
    /// Mean command.
    pub command: EstimateEntry,
}

impl ConstantVelocityEntry {
    /// The lines and their friction.
    pub(crate) fn of(
        names: UnitNames,
        c: &ConstantVelocity,
        back_emf: f64,
        runs: &[RunAnalysis],
    ) -> Self {
        let (forward, backward) = (c.forward.as_ref().ok(), c.backward.as_ref().ok());
        let both = [(true, forward), (false, backward)];
        let lines = both
            .into_iter()
            .filter_map(|(direction, line)| Some(FrictionLineEntry::of(names, direction, line?)));
        Self {
            coulomb: EstimateEntry::or_null(c.coulomb, names.torque_unit()),
            forward: EstimateEntry::or_null(forward.map(|l| l.coulomb), names.torque_unit()),
            backward: EstimateEntry::or_null(backward.map(|l| l.coulomb), names.torque_unit()),
            offset: EstimateEntry::or_null(c.offset, names.torque_unit()),
            viscous: EstimateEntry::or_null(c.viscous, names.viscous_unit()),
            back_emf: NumberEntry::of(back_emf, names.viscous_unit()),
            lines: lines.collect(),
            points: c.points.iter().map(|p| SteadyPointEntry::of(names, p, runs)).collect(),
        }
    }
}

impl FrictionLineEntry {
    fn of(names: UnitNames, forward: bool, l: &FrictionLine) -> Self {
        let (shape, standard_errors) = match l.shape {
            LineShape::Unchecked => (LineShapeName::Unchecked, None),
            LineShape::Straight => (LineShapeName::Straight, None),
            LineShape::Concave { standard_errors } => {
                (LineShapeName::Concave, Some(standard_errors))
            }
            LineShape::Convex { standard_errors } => (LineShapeName::Convex, Some(standard_errors)),
            LineShape::Scattered { rms } => (LineShapeName::Scattered, Some(rms)),
        };
        Self {
            direction: DirectionName::of(forward),
            coulomb: Some(EstimateEntry::of(l.coulomb, names.torque_unit())),
            viscous: EstimateEntry::of(l.viscous, names.viscous_unit()),
            correlation: l.correlation,
            points: l.points,
            speeds: l.speeds,
            shape,
            standard_errors,
            slowest: EstimateEntry::or_null(l.slowest, names.torque_unit()),
        }
    }
}

impl SteadyPointEntry {
    fn of(names: UnitNames, p: &SteadyPoint, runs: &[RunAnalysis]) -> Self {
        Self {
            run: runs[p.run].name.clone(),
            direction: DirectionName::of(p.velocity.value > 0.0),
            start_s: p.start_s,
            end_s: p.end_s,
            velocity: EstimateEntry::of(p.velocity, names.speed_unit()),
            command: EstimateEntry::of(p.command, names.command_unit()),
        }
    }
}
