//! The choice of the friction law, in JSON.

use lissom_core::identify::{Estimate, FrictionLaw, LawCandidate, LawFit, LawTerm, ModelTerm};
use serde::{Deserialize, Serialize};

use super::channel_names::DirectionName;
use super::estimate_entry::{EstimateEntry, finite};
use super::estimate_keys::{Estimated, Refusable};
use super::friction_term_entries::{LawTermEntry, amplitude_key};
use super::gravity_entry::GravityEntry;
use super::unit_keys::{
    CoulombKey, CouplingKey, InertiaKey, LawAmplitudeKey, OffsetKey, SpeedRangeKey, ViscousKey,
    WithUnit,
};
use super::unit_names::UnitNames;

/// The friction law that the data support, on short windows in slip phases.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FrictionLawEntry {
    /// Length of the windows.
    pub window_s: f64,
    /// Slowest and fastest speed of the windows; law and curve hold between these.
    #[serde(flatten)]
    pub speed_range: WithUnit<SpeedRangeKey, [f64; 2]>,
    /// Residuals of the windowed torque, as shares.
    pub relative_residual: LawResidualEntry,
    /// Estimates with the chosen law.
    pub chosen: ChosenLawEntry,
    /// All terms that were tried, in this order.
    pub candidates: Vec<LawCandidateEntry>,
}

/// Residual of the windowed torque as a share, for several laws.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LawResidualEntry {
    /// With Coulomb friction and one viscous coefficient.
    pub simplest: f64,
    /// With the chosen law.
    pub chosen: f64,
    /// With the friction curve.
    pub curve: f64,
}

/// Estimates with the chosen law.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ChosenLawEntry {
    /// Coulomb friction.
    #[serde(flatten)]
    pub coulomb: Refusable<CoulombKey>,
    /// Offset.
    #[serde(flatten)]
    pub offset: Refusable<OffsetKey>,
    /// Viscous friction.
    #[serde(flatten)]
    pub viscous: Refusable<ViscousKey>,
    /// Inertia or mass.
    #[serde(flatten)]
    pub inertia: Refusable<InertiaKey>,
    /// Coupling between motor and beam.
    #[serde(flatten)]
    pub coupling: Refusable<CouplingKey>,
    /// Gravity; null unless the campaign asks for it.
    pub gravity: Option<GravityEntry>,
    /// Further terms of friction.
    pub terms: Vec<ChosenTermEntry>,
}

/// A term of the chosen law.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ChosenTermEntry {
    /// The term.
    #[serde(flatten)]
    pub term: LawTermEntry,
    /// Its amplitude, for a ripple of cosine and sine; empty if it has none.
    #[serde(flatten)]
    pub amplitude: WithUnit<LawAmplitudeKey, Vec<EstimateEntry>>,
}

/// A term that was tried.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LawCandidateEntry {
    /// The term.
    #[serde(flatten)]
    pub term: LawTermEntry,
    /// Number of terms that the model had before.
    pub beside_terms: usize,
    /// Its amplitude; for a term with several numbers, their length.
    #[serde(flatten)]
    pub amplitude: Estimated<LawAmplitudeKey>,
    /// Squared residual that it saves in blocks that were left out of the fit, as a share of that without it.
    pub saved: f64,
    /// The same in standard errors; null if there are too few blocks.
    pub standard_errors: Option<f64>,
    /// Whether whole kinds of motion that were left out (by direction, speed, side of the travel, run) are predicted better.
    pub across_kinds: bool,
    /// Whether the term was adopted.
    pub taken: bool,
}

impl FrictionLawEntry {
    /// The entry of the choice of a law; `constant` is torque per command.
    pub(crate) fn of(names: UnitNames, constant: f64, law: &FrictionLaw) -> Self {
        let [simplest, chosen, curve] = law.relative_residual;
        Self {
            window_s: law.window_s,
            speed_range: WithUnit::new(names, law.speed_range),
            relative_residual: LawResidualEntry { simplest, chosen, curve },
            chosen: ChosenLawEntry::of(names, constant, &law.chosen),
            candidates: law.candidates.iter().map(|c| LawCandidateEntry::of(names, c)).collect(),
        }
    }
}

impl ChosenLawEntry {
    /// Friction against the motion at a speed in a direction, without ripples; positive if it brakes. `None` if Coulomb or
    /// viscous friction is refused.
    pub fn at(&self, names: UnitNames, speed: f64, direction: DirectionName) -> Option<f64> {
        let value = |entry: Option<&Option<EstimateEntry>>| Some(entry?.as_ref()?.value);
        let mut sum = value(self.coulomb.get(names))? + value(self.viscous.get(names))? * speed;
        sum += direction.sign() * value(self.offset.get(names)).unwrap_or(0.0);
        for ChosenTermEntry { term, amplitude } in &self.terms {
            let amplitude = amplitude.any().and_then(|all| all.first()).map_or(0.0, |e| e.value);
            sum += amplitude * term.share(names, speed, direction);
        }
        Some(sum)
    }

    fn of(names: UnitNames, constant: f64, fit: &LawFit) -> Self {
        let term = |(term, amplitudes): &(LawTerm, Vec<Estimate>)| ChosenTermEntry {
            term: LawTermEntry::of(names, *term),
            // The period of a ripple has a key of its own.
            amplitude: WithUnit::under(
                amplitude_key(names, *term),
                EstimateEntry::list(amplitudes.iter().take(numbers_of(*term))),
            ),
        };
        Self {
            coulomb: WithUnit::torque(names, constant, fit.coulomb),
            offset: WithUnit::torque(names, constant, fit.offset),
            viscous: WithUnit::new(names, EstimateEntry::or_null(fit.viscous)),
            inertia: WithUnit::new(names, EstimateEntry::or_null(fit.inertia)),
            coupling: WithUnit::new(names, EstimateEntry::or_null(fit.total_coupling)),
            gravity: fit.gravity.as_ref().map(|g| GravityEntry::of(names, g, None)),
            terms: fit.terms.iter().map(term).collect(),
        }
    }
}

/// Numbers of a term that are amplitudes: cosine and sine of a ripple.
fn numbers_of(term: LawTerm) -> usize {
    if matches!(term, LawTerm::Ripple { .. } | LawTerm::TorqueRipple { .. }) { 2 } else { 1 }
}

impl LawCandidateEntry {
    fn of(names: UnitNames, c: &LawCandidate) -> Self {
        let key = match c.term {
            ModelTerm::Law(term) => amplitude_key(names, term),
            ModelTerm::Missing(_) => "amplitude".to_owned(),
        };
        Self {
            term: LawTermEntry::of_model(names, c.term),
            beside_terms: c.beside,
            amplitude: WithUnit::under(key, EstimateEntry::of(c.amplitude)),
            saved: c.saved,
            standard_errors: finite(c.standard_errors),
            across_kinds: c.across_kinds,
            taken: c.taken,
        }
    }
}
