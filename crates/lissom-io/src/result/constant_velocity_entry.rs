//! Friction from constant velocities in JSON.

use lissom_core::identify::{ConstantVelocity, FrictionLine, LineShape, RunAnalysis, SteadyPoint};
use serde::{Deserialize, Serialize};

use super::channel_names::DirectionName;
use super::estimate_entry::EstimateEntry;
use super::estimate_keys::{Estimated, Refusable};
use super::unit_keys::{
    BackEmfKey, BackwardKey, CoulombKey, ForwardKey, MeanCommandKey, OffsetKey, SlowestKey,
    VelocityKey, ViscousKey, WithUnit,
};
use super::unit_names::UnitNames;

/// Friction from constant velocities, extrapolated to zero speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ConstantVelocityEntry {
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
    /// Viscous friction, mean of both directions.
    #[serde(flatten)]
    pub viscous: Refusable<ViscousKey>,
    /// Damping by back-EMF that the campaign gives, which the slopes do not contain.
    #[serde(flatten)]
    pub back_emf: WithUnit<BackEmfKey, f64>,
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
    #[serde(flatten)]
    pub coulomb: Refusable<CoulombKey>,
    /// Its slope, without back-EMF.
    #[serde(flatten)]
    pub viscous: Estimated<ViscousKey>,
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
    #[serde(flatten)]
    pub slowest: Refusable<SlowestKey>,
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
    #[serde(flatten)]
    pub velocity: Estimated<VelocityKey>,
    /// Mean command.
    #[serde(flatten)]
    pub command: Estimated<MeanCommandKey>,
}

impl ConstantVelocityEntry {
    /// The lines and their friction; `constant` is torque per command.
    pub(crate) fn of(
        names: UnitNames,
        constant: f64,
        c: &ConstantVelocity,
        back_emf: f64,
        runs: &[RunAnalysis],
    ) -> Self {
        let (forward, backward) = (c.forward.as_ref().ok(), c.backward.as_ref().ok());
        let both = [(true, forward), (false, backward)];
        let lines = both.into_iter().filter_map(|(direction, line)| {
            Some(FrictionLineEntry::of(names, constant, direction, line?))
        });
        Self {
            coulomb: WithUnit::torque(names, constant, c.coulomb),
            forward: WithUnit::torque(names, constant, forward.map(|l| l.coulomb)),
            backward: WithUnit::torque(names, constant, backward.map(|l| l.coulomb)),
            offset: WithUnit::torque(names, constant, c.offset),
            viscous: WithUnit::new(names, EstimateEntry::or_null(c.viscous)),
            back_emf: WithUnit::new(names, back_emf),
            lines: lines.collect(),
            points: c.points.iter().map(|p| SteadyPointEntry::of(names, p, runs)).collect(),
        }
    }
}

impl FrictionLineEntry {
    fn of(names: UnitNames, constant: f64, forward: bool, l: &FrictionLine) -> Self {
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
            coulomb: WithUnit::torque(names, constant, Some(l.coulomb)),
            viscous: WithUnit::new(names, EstimateEntry::of(l.viscous)),
            correlation: l.correlation,
            points: l.points,
            speeds: l.speeds,
            shape,
            standard_errors,
            slowest: WithUnit::torque(names, constant, l.slowest),
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
            velocity: WithUnit::new(names, EstimateEntry::of(p.velocity)),
            command: WithUnit::new(names, EstimateEntry::of(p.command)),
        }
    }
}
