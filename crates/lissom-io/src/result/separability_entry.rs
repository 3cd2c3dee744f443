//! What the logs separate, in JSON.

use lissom_core::identify::{Direction, RunShare, RunToAdd, Separability};
use lissom_core::plan::PlannedMotion;
use lissom_core::record::Axis;
use serde::{Deserialize, Serialize};

use super::channel_names::ArmSourceName;
use super::estimate_entry::finite;
use super::unit_keys::{MotionKey, WithUnit};
use super::unit_names::UnitNames;

/// What the logs separate. Standard errors are relative: to the parameter's value, to Coulomb friction for the
/// offset, to a damping ratio of 0.001 at least for damping.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SeparabilityEntry {
    /// The same in plain words.
    pub words: Vec<String>,
    /// The method whose covariance it is.
    pub source: ArmSourceName,
    /// Condition of the correlation matrix; null where some parameters cannot be told apart.
    pub condition: Option<f64>,
    /// Every parameter.
    pub figures: Vec<KnownFigureEntry>,
    /// Principal directions of the covariance, least known first.
    pub directions: Vec<PrincipalDirectionEntry>,
    /// What each run carries; of an output error on two runs or more.
    pub runs: Vec<RunShareEntry>,
    /// The further run that says most about the parameter that is known least.
    pub run_to_add: Option<RunToAddEntry>,
    /// Codes of the findings that say that there is more in the runs than the arm has: standard errors do not count
    /// it.
    pub doubted_by: Vec<String>,
}

/// How well a parameter is known.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct KnownFigureEntry {
    /// Its name.
    pub figure: String,
    /// Its relative standard error; null where the logs do not tell it from others.
    pub relative_std: Option<f64>,
    /// The same if all others were known.
    pub relative_std_if_others_known: Option<f64>,
}

/// A principal direction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PrincipalDirectionEntry {
    /// Relative standard error along it; null where the logs do not show it at all.
    pub relative_std: Option<f64>,
    /// Parameters that take part, those that move most first.
    pub parts: Vec<DirectionPartEntry>,
}

/// A parameter's part in a principal direction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DirectionPartEntry {
    /// Its name.
    pub figure: String,
    /// Its share of a change of length one.
    pub weight: f64,
    /// Share of the parameter's variance along this direction.
    pub share_of_variance: f64,
}

/// What a run carries.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RunShareEntry {
    /// Name of the run.
    pub name: String,
    /// Its residual over that of the others, with the estimates that these give without it.
    pub residual_beside_others: Option<f64>,
    /// Whether it is the one that fits the others least, and does not fit.
    pub stands_out: bool,
    /// What it does for each parameter.
    pub figures: Vec<CarriedFigureEntry>,
}

/// What a run does for a parameter.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct CarriedFigureEntry {
    /// Name of the parameter.
    pub figure: String,
    /// Standard error without the run over that with it; null where the others do not show it.
    pub std_growth_without: Option<f64>,
    /// By how much the estimate would move without the run.
    pub relative_change_without: Option<f64>,
    /// The same in standard errors.
    pub deviations: Option<f64>,
}

/// A run worth adding.
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
    #[serde(flatten)]
    pub amplitude: WithUnit<MotionKey, f64>,
    /// Time logged.
    pub record_s: f64,
    /// The parameter that it says most about.
    pub figure: String,
    /// Relative standard error of this parameter now.
    pub relative_std_now: Option<f64>,
    /// Relative standard error of this parameter then.
    pub relative_std_then: Option<f64>,
}

/// A motion that a run asks for.
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
    /// What the logs of an axis separate.
    pub(crate) fn of(axis: Axis, names: UnitNames, found: &Separability) -> Self {
        let known = found.figures.iter().map(|known| KnownFigureEntry {
            figure: known.figure.name(),
            relative_std: finite(known.std),
            relative_std_if_others_known: finite(known.alone),
        });
        Self {
            words: found.words(axis),
            source: ArmSourceName::of(found.source),
            condition: finite(found.condition),
            figures: known.collect(),
            directions: found.directions.iter().map(PrincipalDirectionEntry::of).collect(),
            runs: found.runs.iter().map(|run| RunShareEntry::of(found, run)).collect(),
            run_to_add: found.run_to_add.as_ref().map(|run| RunToAddEntry::of(names, run)),
            doubted_by: found.doubted_by.iter().map(ToString::to_string).collect(),
        }
    }
}

impl PrincipalDirectionEntry {
    fn of(direction: &Direction) -> Self {
        let parts = direction.parts.iter().map(|p| DirectionPartEntry {
            figure: p.figure.name(),
            weight: p.weight,
            share_of_variance: p.of_variance,
        });
        Self { relative_std: finite(direction.std), parts: parts.collect() }
    }
}

impl RunShareEntry {
    fn of(found: &Separability, run: &RunShare) -> Self {
        let carried = run.figures.iter().map(|c| CarriedFigureEntry {
            figure: c.figure.name(),
            std_growth_without: finite(c.growth),
            relative_change_without: finite(c.change),
            deviations: finite(c.deviations),
        });
        Self {
            name: run.run.clone(),
            residual_beside_others: finite(run.residual),
            stands_out: found.stands_out() == Some(run),
            figures: carried.collect(),
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
            amplitude: WithUnit::new(names, run.amplitude_rad),
            record_s: run.record_s,
            figure: run.figure.name(),
            relative_std_now: finite(run.std_now),
            relative_std_then: finite(run.std_then),
        }
    }
}
