//! The type of `result.json`: filled from an identification, written and read.

use std::path::Path;

use lissom_core::identify::{
    GeometryCheck, Identified, Method, RunAnalysis, RunKind, UnusedTorque,
};
use lissom_core::record::{Axis, Channels};
use lissom_core::spectrum::Harmonics;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::arm_entry::ArmEntry;
use super::channel_names::CommandUnitName;
use super::equivalent_file::EquivalentEntry;
use super::estimate_entry::{BeamModeEntry, EstimateEntry, NumberEntry};
use super::finding_entry::FindingEntry;
use super::friction_entry::FrictionEntry;
use super::geometry_entry::GeometryEntry;
use super::gravity_entry::GravityEntry;
use super::linear_model_entries::{FrequencyResponseEntry, LinearModelEntries};
use super::method_entries::MethodEntries;
use super::result_error::ResultError;
use super::separability_entry::SeparabilityEntry;
use super::unit_names::UnitNames;
use crate::io_error::Error;
use crate::read_text::read_text;

/// SI units and rad/s. An estimate has its unit next to it, and is null if a finding refuses it. Torques are in N·m (linear
/// axes: N, with m and kg) if the torque constant is known, otherwise in the unit of the command.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ResultFile {
    /// Version of lissom that wrote the file.
    pub lissom: String,
    /// Kind of axis.
    pub axis: Axis,
    /// Torque constant used, N*m or N per unit of command; null if it is unknown.
    pub torque_per_command: Option<f64>,
    /// Unit of the command.
    pub command_unit: CommandUnitName,
    /// The method that gave friction, inertia and coupling, all of them together; null if none has a solution.
    pub from: Option<Method>,
    /// Friction from this method.
    pub friction: FrictionEntry,
    /// What remains of the torque in slip phases that were left out of the fit; null if the solution is not from slip phases or
    /// of a rigid arm.
    pub unused_torque: Option<UnusedTorque>,
    /// The drive.
    pub drive: DriveEntry,
    /// Gravity of an unbalanced load; null unless the campaign asks for it and the data determine it.
    pub gravity: Option<GravityEntry>,
    /// The beam.
    pub beam: BeamEntry,
    /// Which parameters the logs identify; null without a covariance.
    pub verdict: Option<SeparabilityEntry>,
    /// The arm with these estimates, with which lissom validate predicts other logs; null if inertia or Coulomb
    /// friction is refused, or no method gives a whole arm.
    pub arm: Option<ArmEntry>,
    /// Estimates of each method.
    pub methods: MethodEntries,
    /// Frequency responses.
    pub frequency_response: FrequencyResponseEntry,
    /// Linear models of drive and beam.
    pub models: LinearModelEntries,
    /// Comparison of the identified arm with the arm.toml that the campaign gives; null if it gives none with beam and
    /// drive, or the solution of the output-error method is rejected.
    pub geometry: Option<GeometryEntry>,
    /// The equivalent arm of Section 4 of the 1989 report, if the angles of two or more tips are known; null if there
    /// is none, and a finding equivalent-refused may give the reason.
    pub equivalent: Option<EquivalentEntry>,
    /// Motion and use of each run.
    pub runs: Vec<RunEntry>,
    /// What the data do not determine, and what to know about the estimates.
    pub findings: Vec<FindingEntry>,
}

/// The drive.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DriveEntry {
    /// Inertia, or mass of a linear axis.
    pub inertia: Option<EstimateEntry>,
}

/// The beam.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct BeamEntry {
    /// Modes with the motor clamped (poles of tip angle per motor angle), ascending.
    pub modes: Vec<BeamModeEntry>,
    /// Torque per angle between motor and beam.
    pub coupling: Option<EstimateEntry>,
    /// Coupling for each tip.
    pub coupling_by_tip: Vec<Option<EstimateEntry>>,
}

/// A run of the campaign.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RunEntry {
    /// Its name.
    pub name: String,
    /// Number of its samples.
    pub samples: usize,
    /// Its sample time.
    pub sample_time_s: f64,
    /// Its motion.
    pub kind: RunKindName,
    /// Share of the samples with a saturated command.
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
    /// Constant velocities for most of the time of motion.
    ConstantVelocity,
    /// Any other motion.
    General,
}

/// Values of a sinusoidal run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SinusoidEntry {
    /// Its frequency.
    pub omega_rad_s: f64,
    /// Whether the frequency was given and not found.
    pub omega_given: bool,
    /// Number of periods used.
    pub periods: usize,
    /// Number of periods left out at the start.
    pub dropped_periods: usize,
    /// Share of the cycle in which the joint sticks.
    pub stuck_share: Option<f64>,
    /// Amplitude of the motor's motion, that of its first harmonic.
    pub amplitude: NumberEntry,
    /// Harmonics of the command.
    pub command_harmonics: HarmonicsEntry,
    /// Harmonics of the motor's motion.
    pub motor_harmonics: HarmonicsEntry,
}

/// Harmonics of a signal, from the first one.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct HarmonicsEntry {
    /// Amplitude of each harmonic relative to that of the first one.
    pub relative_amplitude: Vec<f64>,
    /// Its standard error.
    pub relative_std: Vec<f64>,
}

impl ResultFile {
    /// Reads a `result.json`.
    ///
    /// # Errors
    /// [`Error::Result`] if the file cannot be read, or is not the result of this version of lissom.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let file = path.display().to_string();
        let text =
            read_text(path).map_err(|source| ResultError::Read { file: file.clone(), source })?;
        Ok(Self::of_text(&file, &text)?)
    }

    /// Reads the text of a `result.json`, which errors call `file`.
    ///
    /// # Errors
    /// [`ResultError`] if the text is not the result of this version of lissom.
    pub fn of_text(file: &str, text: &str) -> Result<Self, ResultError> {
        let file = || file.to_owned();
        let root: Value = serde_json::from_str(text.trim_start_matches('\u{feff}'))
            .map_err(|source| ResultError::Json { file: file(), source })?;
        for key in [
            "lissom",
            "axis",
            "torque_per_command",
            "command_unit",
            "friction",
            "drive",
            "beam",
            "arm",
            "runs",
            "findings",
        ] {
            if root.get(key).is_none() {
                return Err(ResultError::NoResult { file: file(), key });
            }
        }
        serde_path_to_error::deserialize(&root).map_err(|error| {
            let key = error.path().to_string();
            ResultError::Value { file: file(), key, source: error.into_inner() }
        })
    }

    /// Its units.
    pub fn names(&self) -> UnitNames {
        self.command_unit.names(self.axis, self.torque_per_command)
    }

    /// The content for an identification, with the comparison with an arm.toml if there is one.
    pub fn of(channels: &Channels, id: &Identified, described: Option<&GeometryCheck>) -> Self {
        let names = UnitNames::new(channels);
        let separability = id.separability.as_ref();
        Self {
            lissom: env!("CARGO_PKG_VERSION").to_owned(),
            axis: channels.axis,
            torque_per_command: id.torque_per_command,
            command_unit: CommandUnitName::of(channels.command.quantity, channels.axis),
            from: id.method,
            friction: FrictionEntry::of(names, id),
            unused_torque: id.unused_torque,
            drive: DriveEntry { inertia: EstimateEntry::or_null(id.inertia, names.inertia_unit()) },
            gravity: id.gravity.as_ref().map(|g| GravityEntry::of(names, g, id.torque_constant)),
            beam: BeamEntry::of(names, id),
            verdict: separability.map(|s| SeparabilityEntry::of(channels.axis, names, s)),
            arm: id.arm.as_ref().map(|found| ArmEntry::of(channels, names, found)),
            methods: MethodEntries::of(names, channels, id),
            frequency_response: FrequencyResponseEntry::of(channels, id),
            models: LinearModelEntries::of(channels, &id.models),
            geometry: described.map(GeometryEntry::of),
            equivalent: id.equivalent.as_ref().map(|e| EquivalentEntry::of(names, e)),
            runs: id.runs.iter().map(|run| RunEntry::of(names, run)).collect(),
            findings: FindingEntry::list(&id.findings),
        }
    }
}

impl BeamEntry {
    fn of(names: UnitNames, id: &Identified) -> Self {
        let by_tip = id
            .beam
            .coupling_by_tip
            .iter()
            .map(|e| EstimateEntry::or_null(*e, names.coupling_unit()));
        Self {
            modes: BeamModeEntry::list(&id.beam.modes),
            coupling: EstimateEntry::or_null(id.beam.coupling, names.coupling_unit()),
            coupling_by_tip: by_tip.collect(),
        }
    }
}

/// Amplitude of the first harmonic; zero if there is none.
fn first_harmonic(harmonics: &Harmonics) -> f64 {
    harmonics.get(1).map_or(0.0, |phasor| phasor.value.norm())
}

impl HarmonicsEntry {
    /// Empty if the first harmonic has no amplitude.
    fn of(harmonics: &Harmonics) -> Self {
        let first = first_harmonic(harmonics);
        if first <= 0.0 {
            return Self::default();
        }
        let all = harmonics.phasors.iter();
        Self {
            relative_amplitude: all.clone().map(|phasor| phasor.value.norm() / first).collect(),
            relative_std: all.map(|phasor| phasor.std / first).collect(),
        }
    }
}

impl RunEntry {
    fn of(names: UnitNames, r: &RunAnalysis) -> Self {
        let (kind, sinusoid) = match &r.kind {
            RunKind::Sinusoidal(s) => (
                RunKindName::Sinusoidal,
                Some(SinusoidEntry {
                    omega_rad_s: s.omega_rad_s,
                    omega_given: s.omega_given,
                    periods: s.steady.periods,
                    dropped_periods: s.steady.dropped,
                    stuck_share: r.stuck_share,
                    amplitude: NumberEntry::of(first_harmonic(&s.motor), names.angle()),
                    command_harmonics: HarmonicsEntry::of(&s.command),
                    motor_harmonics: HarmonicsEntry::of(&s.motor),
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
