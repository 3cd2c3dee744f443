//! The verdict in JSON: which parameters the logs identify.

use lissom_core::identify::{ArmSource, Direction, RunShare, RunToAdd, Separability};
use lissom_core::information::ArmParameter;
use lissom_core::plan::PlannedMotion;
use lissom_core::record::Axis;
use serde::{Deserialize, Serialize};

use super::estimate_entry::{NumberEntry, finite};
use super::finding_keys::{COULOMB, COUPLING, INERTIA, OFFSET, VISCOUS};
use super::unit_names::UnitNames;

/// Which parameters the logs identify. Standard errors are relative to the value of the parameter, for the offset to
/// Coulomb friction, and for damping to a damping ratio of at least 0.001.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SeparabilityEntry {
    /// The verdict in words.
    pub words: Vec<String>,
    /// The method that gave the covariance.
    pub source: ArmSource,
    /// Correlation of the estimates: times both standard errors it is their covariance.
    pub correlation: CorrelationEntry,
    /// Condition number of the correlation matrix; null if some parameters cannot be separated.
    pub condition: Option<f64>,
    /// All parameters.
    pub parameters: Vec<ParameterCertaintyEntry>,
    /// Principal directions of the covariance, the least certain first.
    pub directions: Vec<PrincipalDirectionEntry>,
    /// Contribution of each run; only from the output-error method with two or more runs.
    pub runs: Vec<RunShareEntry>,
    /// The additional run that reduces the standard error of the least certain parameter most.
    pub run_to_add: Option<RunToAddEntry>,
    /// Codes of findings that report effects in the runs that the arm does not have. Standard errors do not include
    /// these effects.
    pub doubted_by: Vec<String>,
}

/// Correlation of estimates.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct CorrelationEntry {
    /// Keys of the estimates in this file, in the order of rows and columns.
    pub keys: Vec<String>,
    /// The correlation matrix; null where the logs do not separate an estimate from others.
    pub matrix: Vec<Vec<Option<f64>>>,
}

/// The certainty of a parameter.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ParameterCertaintyEntry {
    /// Name of the parameter.
    pub parameter: String,
    /// Whether the estimate is given; false if a finding refuses it.
    pub given: bool,
    /// Its relative standard error; null if the logs do not separate it from other parameters.
    pub relative_std: Option<f64>,
    /// Its relative standard error if all other parameters were known.
    pub relative_std_if_others_known: Option<f64>,
}

/// A principal direction of the covariance.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PrincipalDirectionEntry {
    /// Relative standard error along this direction; null if the logs do not show it at all.
    pub relative_std: Option<f64>,
    /// Parameters of the direction, those with the largest weight first.
    pub parts: Vec<DirectionPartEntry>,
}

/// A parameter in a principal direction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DirectionPartEntry {
    /// Name of the parameter.
    pub parameter: String,
    /// Its component of the direction, as a vector of length one.
    pub weight: f64,
    /// Share of the parameter's variance along this direction.
    pub share_of_variance: f64,
}

/// Contribution of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RunShareEntry {
    /// Name of the run.
    pub name: String,
    /// Its residual relative to that of the other runs, with the estimates from these other runs.
    pub residual_beside_others: Option<f64>,
    /// Whether it differs most from the other runs, by so much that it is reported.
    pub stands_out: bool,
    /// Effect of the run on each parameter.
    pub parameters: Vec<RunEffectEntry>,
}

/// Effect of a run on a parameter.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RunEffectEntry {
    /// Name of the parameter.
    pub parameter: String,
    /// Standard error without the run divided by that with it; null if the other runs do not show the parameter.
    pub std_growth_without: Option<f64>,
    /// Relative change of the estimate without the run.
    pub relative_change_without: Option<f64>,
    /// The same change in standard errors.
    pub standard_errors: Option<f64>,
}

/// A run to add.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RunToAddEntry {
    /// Its motion.
    pub kind: MotionKindName,
    /// Frequency of a sine, lowest line of a multisine, start of a chirp.
    pub from_rad_s: f64,
    /// Frequency of a sine, highest line of a multisine, end of a chirp.
    pub to_rad_s: f64,
    /// Amplitude of the motor's motion.
    pub amplitude: NumberEntry,
    /// Logged time.
    pub record_s: f64,
    /// The parameter whose standard error it reduces most.
    pub parameter: String,
    /// Relative standard error of this parameter now.
    pub relative_std_now: Option<f64>,
    /// Relative standard error of this parameter with the run.
    pub relative_std_then: Option<f64>,
}

/// Kind of motion of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum MotionKindName {
    /// One sine.
    Sine,
    /// Several sines.
    Multisine,
    /// A sweep.
    Chirp,
}

impl SeparabilityEntry {
    /// The entry of a verdict.
    pub(crate) fn of(axis: Axis, names: UnitNames, found: &Separability) -> Self {
        let known = found.parameters.iter().map(|known| ParameterCertaintyEntry {
            parameter: known.parameter.name(),
            given: known.given,
            relative_std: finite(known.std),
            relative_std_if_others_known: finite(known.alone),
        });
        Self {
            words: found.words(axis),
            source: found.source,
            correlation: CorrelationEntry::of(found),
            condition: finite(found.condition),
            parameters: known.collect(),
            directions: found.directions.iter().map(PrincipalDirectionEntry::of).collect(),
            runs: found.runs.iter().map(|run| RunShareEntry::of(found, run)).collect(),
            run_to_add: found.run_to_add.as_ref().map(|run| RunToAddEntry::of(names, run)),
            doubted_by: found.doubted_by.iter().map(ToString::to_string).collect(),
        }
    }
}

impl CorrelationEntry {
    fn of(found: &Separability) -> Self {
        let key = |parameter: ArmParameter| match parameter {
            ArmParameter::Coulomb => COULOMB.to_owned(),
            ArmParameter::Viscous => VISCOUS.to_owned(),
            ArmParameter::Offset => OFFSET.to_owned(),
            ArmParameter::Inertia => INERTIA.to_owned(),
            ArmParameter::Coupling => COUPLING.to_owned(),
            ArmParameter::Frequency(k) => format!("beam.modes[{k}].natural_frequency_rad_s"),
            ArmParameter::Damping(k) => format!("beam.modes[{k}].damping_ratio"),
        };
        let rows = found.correlation.row_iter();
        Self {
            keys: found.parameters.iter().map(|known| key(known.parameter)).collect(),
            matrix: rows.map(|row| row.iter().map(|value| finite(*value)).collect()).collect(),
        }
    }
}

impl PrincipalDirectionEntry {
    fn of(direction: &Direction) -> Self {
        let parts = direction.parts.iter().map(|p| DirectionPartEntry {
            parameter: p.parameter.name(),
            weight: p.weight,
            share_of_variance: p.of_variance,
        });
        Self { relative_std: finite(direction.std), parts: parts.collect() }
    }
}

impl RunShareEntry {
    fn of(found: &Separability, run: &RunShare) -> Self {
        let carried = run.parameters.iter().map(|c| RunEffectEntry {
            parameter: c.parameter.name(),
            std_growth_without: finite(c.growth),
            relative_change_without: finite(c.change),
            standard_errors: finite(c.standard_errors),
        });
        Self {
            name: run.run.clone(),
            residual_beside_others: finite(run.residual),
            stands_out: found.stands_out() == Some(run),
            parameters: carried.collect(),
        }
    }
}

impl RunToAddEntry {
    fn of(names: UnitNames, run: &RunToAdd) -> Self {
        let (kind, from_rad_s, to_rad_s) = match run.motion {
            PlannedMotion::Sine { omega_rad_s } => (MotionKindName::Sine, omega_rad_s, omega_rad_s),
            PlannedMotion::Multisine { omega_rad_s, to_rad_s, .. } => {
                (MotionKindName::Multisine, omega_rad_s, to_rad_s)
            }
            PlannedMotion::Chirp { from_rad_s, to_rad_s, .. } => {
                (MotionKindName::Chirp, from_rad_s, to_rad_s)
            }
        };
        Self {
            kind,
            from_rad_s,
            to_rad_s,
            amplitude: NumberEntry::of(run.amplitude_rad, names.angle()),
            record_s: run.record_s,
            parameter: run.parameter.name(),
            relative_std_now: finite(run.std_now),
            relative_std_then: finite(run.std_then),
        }
    }
}
