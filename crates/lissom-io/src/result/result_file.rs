//! `result.json` as a type: filled from what was identified, written and read.

use lissom_core::identify::{GeometryCheck, Identified, RunAnalysis, RunKind};
use lissom_core::record::Channels;
use serde::{Deserialize, Serialize};

use super::arm_entry::ArmEntry;
use super::channel_names::{AxisName, MethodName};
use super::equivalent_file::EquivalentEntry;
use super::estimate_entry::{BeamModeEntry, EstimateEntry};
use super::estimate_keys::Refusable;
use super::finding_entry::FindingEntry;
use super::friction_entry::FrictionEntry;
use super::geometry_entry::GeometryEntry;
use super::gravity_entry::GravityEntry;
use super::linear_model_entries::{FrequencyResponseEntry, LinearModelEntries};
use super::method_entries::MethodEntries;
use super::separability_entry::SeparabilityEntry;
use super::unit_keys::{CouplingByTipKey, CouplingKey, InertiaKey, WithUnit};
use super::unit_names::UnitNames;

/// SI units and rad/s. The suffix of a key is its unit: a (A), v (V), command (unit of the command, where that is
/// unknown), nm (N*m), n (N). Keys in N*m or N are there where the torque constant is known; otherwise estimates
/// are per unit of command. Linear axes have m, N and kg in place of rad, N*m and kg*m^2. An estimate is null where
/// a finding refuses it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ResultFile {
    /// Version that wrote the file.
    pub lissom: String,
    /// Kind of axis.
    pub axis: AxisName,
    /// Torque constant used, N*m or N per unit of command; null where it is unknown.
    pub torque_per_command: Option<f64>,
    /// The method whose solution friction, inertia and coupling are, all of them together; null where none has one.
    pub from: Option<MethodName>,
    /// Friction of that solution.
    pub friction: FrictionEntry,
    /// The drive.
    pub drive: DriveEntry,
    /// Gravity of an unbalanced load; null unless the campaign asks for it and the data tell it.
    pub gravity: Option<GravityEntry>,
    /// The beam.
    pub beam: BeamEntry,
    /// What the logs separate; null without a covariance.
    pub verdict: Option<SeparabilityEntry>,
    /// The arm that these estimates make, to predict other logs with (lissom validate); null where inertia or Coulomb
    /// friction is refused, or no method gives a whole arm.
    pub arm: Option<ArmEntry>,
    /// What each method found.
    pub methods: MethodEntries,
    /// Frequency responses.
    pub frequency_response: FrequencyResponseEntry,
    /// Linear models of drive and beam.
    pub models: LinearModelEntries,
    /// The arm.toml that the campaign names compared with the arm found; null where it names none with beam and drive,
    /// or the output error is rejected.
    pub geometry: Option<GeometryEntry>,
    /// The equivalent arm of Section 4 where more than one tip's angle is known; null where there is none, and a
    /// finding equivalent-refused may say why.
    pub equivalent: Option<EquivalentEntry>,
    /// What each run is.
    pub runs: Vec<RunEntry>,
    /// What the data do not allow, and what to know about the estimates.
    pub findings: Vec<FindingEntry>,
}

/// The drive.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DriveEntry {
    /// Inertia, or mass of a linear axis.
    #[serde(flatten)]
    pub inertia: Refusable<InertiaKey>,
}

/// The beam.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct BeamEntry {
    /// Poles of tip angle over motor angle, motor clamped, ascending.
    pub modes: Vec<BeamModeEntry>,
    /// Torque per angle between motor and beam.
    #[serde(flatten)]
    pub coupling: Refusable<CouplingKey>,
    /// The same for each tip.
    #[serde(flatten)]
    pub coupling_by_tip: WithUnit<CouplingByTipKey, Vec<Option<EstimateEntry>>>,
}

/// What a run is.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RunEntry {
    /// Its name.
    pub name: String,
    /// Samples that it has.
    pub samples: usize,
    /// Its sample time.
    pub sample_time_s: f64,
    /// Its motion.
    pub kind: RunKindName,
    /// Share of the samples at which the command saturates.
    pub saturated_share: f64,
    /// Whether the regression uses it.
    pub usable: bool,
    /// Further values of a sinusoidal run; absent for other runs.
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    pub sinusoid: Option<SinusoidEntry>,
}

/// Motion of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum RunKindName {
    /// One sinusoid in steady state.
    Sinusoidal,
    /// Constant velocities for most of the time in motion.
    ConstantVelocity,
    /// Any other motion.
    General,
}

/// Values that only a sinusoidal run has.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SinusoidEntry {
    /// Its frequency.
    pub omega_rad_s: f64,
    /// Whether the frequency was given rather than found.
    pub omega_given: bool,
    /// Periods kept.
    pub periods: usize,
    /// Periods left out at its start.
    pub dropped_periods: usize,
    /// Share of the cycle in which the joint sticks.
    pub stuck_share: Option<f64>,
}

impl ResultFile {
    /// What was identified; with what the logs say of an arm's description, where there is one.
    pub fn of(channels: &Channels, id: &Identified, described: Option<&GeometryCheck>) -> Self {
        let names = UnitNames::new(channels);
        let constant = id.torque_per_command.unwrap_or(1.0);
        let separability = id.separability.as_ref();
        let inertia = EstimateEntry::or_null(id.inertia);
        Self {
            lissom: env!("CARGO_PKG_VERSION").to_owned(),
            axis: AxisName::of(channels.axis),
            torque_per_command: id.torque_per_command,
            from: id.method.and_then(MethodName::of),
            friction: FrictionEntry::of(names, constant, id),
            drive: DriveEntry { inertia: WithUnit::new(names, inertia) },
            gravity: id.gravity.as_ref().map(|g| GravityEntry::of(names, g, id.torque_constant)),
            beam: BeamEntry::of(names, id),
            verdict: separability.map(|s| SeparabilityEntry::of(channels.axis, names, s)),
            arm: id.arm.as_ref().map(|found| ArmEntry::of(channels, names, found)),
            methods: MethodEntries::of(names, constant, channels, id),
            frequency_response: FrequencyResponseEntry::of(channels, id),
            models: LinearModelEntries::of(channels, &id.models),
            geometry: described.map(GeometryEntry::of),
            equivalent: id.equivalent.as_ref().map(|e| EquivalentEntry::of(names, e)),
            runs: id.runs.iter().map(RunEntry::of).collect(),
            findings: FindingEntry::list(&id.findings),
        }
    }
}

impl BeamEntry {
    fn of(names: UnitNames, id: &Identified) -> Self {
        let by_tip = id.beam.coupling_by_tip.iter().map(|e| EstimateEntry::or_null(*e));
        Self {
            modes: BeamModeEntry::list(&id.beam.modes),
            coupling: WithUnit::new(names, EstimateEntry::or_null(id.beam.coupling)),
            coupling_by_tip: WithUnit::new(names, by_tip.collect()),
        }
    }
}

impl RunEntry {
    fn of(r: &RunAnalysis) -> Self {
        let (kind, sinusoid) = match &r.kind {
            RunKind::Sinusoidal(s) => (
                RunKindName::Sinusoidal,
                Some(SinusoidEntry {
                    omega_rad_s: s.omega_rad_s,
                    omega_given: s.omega_given,
                    periods: s.steady.periods,
                    dropped_periods: s.steady.dropped,
                    stuck_share: r.stuck_share,
                }),
            ),
            _ if r.is_constant_velocity() => (RunKindName::ConstantVelocity, None),
            _ => (RunKindName::General, None),
        };
        Self {
            name: r.name.clone(),
            samples: r.samples,
            sample_time_s: r.sample_time_s,
            kind,
            saturated_share: r.saturated_share,
            usable: r.usable,
            sinusoid,
        }
    }
}
