//! Estimates of the output-error method in JSON.

use lissom_core::identify::{Extension, OutputError, StageReport, Stop};
use lissom_core::record::Channels;
use lissom_core::replay::Parameter;
use serde::{Deserialize, Serialize};

use super::estimate_entry::{BeamModeEntry, EstimateEntry};
use super::friction_entry::CoulombEntry;
use super::unit_names::UnitNames;

/// Estimates of the output-error method.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct OutputErrorEntry {
    /// Coulomb friction.
    #[serde(flatten)]
    pub coulomb: CoulombEntry,
    /// Viscous friction.
    pub viscous: Option<EstimateEntry>,
    /// Inertia or mass.
    pub inertia: Option<EstimateEntry>,
    /// Coupling between motor and beam.
    pub coupling: Option<EstimateEntry>,
    /// Modes with the motor clamped.
    pub modes: Vec<BeamModeEntry>,
    /// Time by which the command acts later than it is logged; null if the residual shows no lag.
    pub command_lag_s: Option<EstimateEntry>,
    /// Time by which each tip is read later than the motor; null if the residual shows no lag.
    pub tip_lags_s: Vec<Option<EstimateEntry>>,
    /// Whether the arm describes whole runs, or windows over which neighbouring motions stay together.
    pub whole_runs: bool,
    /// Number of simulated samples and of their derivatives with respect to a parameter.
    pub evaluations: u64,
    /// The search on each window length, in order.
    pub stages: Vec<StageEntry>,
    /// Further parameters that were tried, each with the expected effect of one step.
    pub tried: Vec<ExtensionEntry>,
}

/// A search on windows of one length.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct StageEntry {
    /// Length of the longest window.
    pub window_s: f64,
    /// Number of windows.
    pub windows: usize,
    /// Sum of squared residuals, in units of the noise's standard deviation, after each step tried.
    pub cost: Vec<f64>,
    /// Number of accepted steps.
    pub steps_taken: usize,
    /// Why the search ended.
    pub stop: Stop,
    /// Assumed standard deviation of the noise of each channel, motor first, then tips.
    pub noise_sigma: Vec<f64>,
    /// Assumed step of each sensor; 0 if the step is treated as noise.
    pub noise_step: Vec<f64>,
    /// Standard deviation of the residual of each channel.
    pub residual_std: Vec<f64>,
}

/// A further parameter that was tried.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ExtensionEntry {
    /// Its name.
    pub parameter: String,
    /// Its value after one step.
    pub value: f64,
    /// Standard error of the value.
    pub std: f64,
    /// Share by which it reduces the cost.
    pub share_of_cost: f64,
    /// Whether the parameter was added.
    pub added: bool,
}

impl OutputErrorEntry {
    /// The entry of the output-error method.
    pub(crate) fn of(names: UnitNames, channels: &Channels, oe: &OutputError) -> Self {
        let friction = oe.friction(channels.command.back_emf_viscous);
        let coupling = oe.estimates(channels).coupling;
        let lag = |tip| EstimateEntry::or_null(oe.estimate(Parameter::TipLag(tip)), "s");
        Self {
            coulomb: CoulombEntry::of(names, &friction),
            viscous: EstimateEntry::or_null(friction.viscous, names.viscous_unit()),
            inertia: EstimateEntry::or_null(oe.inertia(), names.inertia_unit()),
            coupling: EstimateEntry::or_null(coupling, names.coupling_unit()),
            modes: BeamModeEntry::list(&oe.mode_estimates()),
            command_lag_s: EstimateEntry::or_null(oe.estimate(Parameter::CommandLag), "s"),
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
            stop: s.stop,
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
