//! What the output-error method found, in JSON.

use lissom_core::identify::{Extension, OutputError, StageReport, Stop};
use lissom_core::record::Channels;
use lissom_core::replay::Parameter;
use serde::{Deserialize, Serialize};

use super::estimate_entry::{BeamModeEntry, EstimateEntry};
use super::estimate_keys::Refusable;
use super::friction_entry::CoulombEntry;
use super::unit_keys::{CouplingKey, InertiaKey, ViscousKey, WithUnit};
use super::unit_names::UnitNames;

/// Estimates of the output-error method.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct OutputErrorEntry {
    /// Coulomb friction.
    #[serde(flatten)]
    pub coulomb: CoulombEntry,
    /// Viscous friction.
    #[serde(flatten)]
    pub viscous: Refusable<ViscousKey>,
    /// Inertia or mass.
    #[serde(flatten)]
    pub inertia: Refusable<InertiaKey>,
    /// Coupling.
    #[serde(flatten)]
    pub coupling: Refusable<CouplingKey>,
    /// Modes with the motor clamped.
    pub modes: Vec<BeamModeEntry>,
    /// By how much the command acts later than it is logged; null where the residual does not call for a lag.
    pub command_lag_s: Option<EstimateEntry>,
    /// By how much later each tip is read than the motor; null where the residual does not call for a lag.
    pub tip_lags_s: Vec<Option<EstimateEntry>>,
    /// Whether the arm describes whole runs, or windows of them as long as neighbouring motions stay together.
    pub whole_runs: bool,
    /// Samples replayed, and derivatives of these by a parameter.
    pub evaluations: u64,
    /// Every length of windows, in order.
    pub stages: Vec<StageEntry>,
    /// Further parameters that were tried: what one step with each promises.
    pub tried: Vec<ExtensionEntry>,
}

/// A search on windows of one length.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct StageEntry {
    /// Longest window.
    pub window_s: f64,
    /// Number of windows.
    pub windows: usize,
    /// Sum of squared residuals in standard deviations after each step tried.
    pub cost: Vec<f64>,
    /// Steps that were taken.
    pub steps_taken: usize,
    /// Why it ended.
    pub stop: StopName,
    /// Noise that each channel was taken to have, motor first, then tips.
    pub noise_sigma: Vec<f64>,
    /// Step that each sensor was taken to read in; 0 where it counts as noise.
    pub noise_step: Vec<f64>,
    /// Standard deviation of the residual of each channel.
    pub residual_std: Vec<f64>,
}

/// Why a search ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum StopName {
    /// It converged.
    Converged,
    /// No step lowers the cost.
    NoStepHelps,
    /// All steps allowed were used.
    StepsUsedUp,
    /// All evaluations allowed were used.
    BudgetSpent,
}

/// A parameter that was tried.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ExtensionEntry {
    /// Its name.
    pub parameter: String,
    /// Its value after one step.
    pub value: f64,
    /// Standard error of the value.
    pub std: f64,
    /// Share of the cost that it takes away.
    pub share_of_cost: f64,
    /// Whether it was added.
    pub added: bool,
}

impl OutputErrorEntry {
    /// What the output-error method found; `constant` is torque per command.
    pub(crate) fn of(
        names: UnitNames,
        constant: f64,
        channels: &Channels,
        oe: &OutputError,
    ) -> Self {
        let friction = oe.friction(channels.command.back_emf_viscous);
        let coupling = oe.estimates(channels).coupling;
        let lag = |tip| EstimateEntry::or_null(oe.estimate(Parameter::TipLag(tip)));
        Self {
            coulomb: CoulombEntry::of(names, constant, &friction),
            viscous: WithUnit::new(names, EstimateEntry::or_null(friction.viscous)),
            inertia: WithUnit::new(names, EstimateEntry::or_null(oe.inertia())),
            coupling: WithUnit::new(names, EstimateEntry::or_null(coupling)),
            modes: BeamModeEntry::list(&oe.mode_estimates()),
            command_lag_s: EstimateEntry::or_null(oe.estimate(Parameter::CommandLag)),
            tip_lags_s: (0..channels.tips.len()).map(lag).collect(),
            whole_runs: oe.whole_runs,
            evaluations: oe.evaluations,
            stages: oe.stages.iter().map(StageEntry::of).collect(),
            tried: oe.extensions.iter().map(ExtensionEntry::of).collect(),
        }
    }
}

impl StageEntry {
    fn of(s: &StageReport) -> Self {
        Self {
            window_s: s.window_s,
            windows: s.windows,
            cost: s.iterations.iter().map(|i| i.cost).collect(),
            steps_taken: s.iterations.iter().filter(|i| i.taken).count(),
            stop: match s.stop {
                Stop::Converged => StopName::Converged,
                Stop::NoStepHelps => StopName::NoStepHelps,
                Stop::StepsUsedUp => StopName::StepsUsedUp,
                Stop::BudgetSpent => StopName::BudgetSpent,
            },
            noise_sigma: s.noise.iter().map(|n| n.sigma).collect(),
            noise_step: s.noise.iter().map(|n| n.step).collect(),
            residual_std: s.residual.clone(),
        }
    }
}

impl ExtensionEntry {
    fn of(e: &Extension) -> Self {
        Self {
            parameter: e.parameter.name(),
            value: e.value,
            std: e.std,
            share_of_cost: e.share,
            added: e.added,
        }
    }
}
