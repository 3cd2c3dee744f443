//! The choice of the friction law, in JSON.

use lissom_core::identify::{Estimate, FrictionLaw, LawCandidate, LawFit, LawTerm, ModelTerm};
use serde::{Deserialize, Serialize};

use super::channel_names::DirectionName;
use super::estimate_entry::{EstimateEntry, NumberEntry, finite};
use super::friction_term_entries::{LawTermEntry, amplitude_unit};
use super::gravity_entry::GravityEntry;
use super::unit_names::UnitNames;

/// The friction law that the data support, on short windows in slip phases.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FrictionLawEntry {
    /// Length of the windows.
    pub window_s: f64,
    /// Slowest and fastest speed of the windows; law and curve hold between these.
    pub speed_range: NumberEntry<[f64; 2]>,
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
    pub coulomb: Option<EstimateEntry>,
    /// Offset.
    pub offset: Option<EstimateEntry>,
    /// Viscous friction.
    pub viscous: Option<EstimateEntry>,
    /// Inertia or mass.
    pub inertia: Option<EstimateEntry>,
    /// Coupling between motor and beam.
    pub coupling: Option<EstimateEntry>,
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
    pub amplitude: Vec<EstimateEntry>,
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
    pub amplitude: EstimateEntry,
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
    /// The entry of the choice of a law.
    pub(crate) fn of(names: UnitNames, law: &FrictionLaw) -> Self {
        let [simplest, chosen, curve] = law.relative_residual;
        Self {
            window_s: law.window_s,
            speed_range: NumberEntry::of(law.speed_range, names.speed_unit()),
            relative_residual: LawResidualEntry { simplest, chosen, curve },
            chosen: ChosenLawEntry::of(names, &law.chosen),
            candidates: law.candidates.iter().map(|c| LawCandidateEntry::of(names, c)).collect(),
        }
    }
}

impl ChosenLawEntry {
    /// Friction against the motion at a speed in a direction, without ripples; positive if it brakes. `None` if Coulomb or
    /// viscous friction is refused.
    pub fn at(&self, speed: f64, direction: DirectionName) -> Option<f64> {
        let mut sum = self.coulomb.as_ref()?.value + self.viscous.as_ref()?.value * speed;
        sum += direction.sign() * self.offset.as_ref().map_or(0.0, |e| e.value);
        for ChosenTermEntry { term, amplitude } in &self.terms {
            let amplitude = amplitude.first().map_or(0.0, |e| e.value);
            sum += amplitude * term.share(speed, direction);
        }
        Some(sum)
    }

    fn of(names: UnitNames, fit: &LawFit) -> Self {
        let term = |(term, amplitudes): &(LawTerm, Vec<Estimate>)| ChosenTermEntry {
            term: LawTermEntry::of(names, *term),
            // The period of a ripple has a key of its own.
            amplitude: EstimateEntry::list(
                amplitudes.iter().take(numbers_of(*term)),
                amplitude_unit(names, ModelTerm::Law(*term)),
            ),
        };
        Self {
            coulomb: EstimateEntry::or_null(fit.coulomb, names.torque_unit()),
            offset: EstimateEntry::or_null(fit.offset, names.torque_unit()),
            viscous: EstimateEntry::or_null(fit.viscous, names.viscous_unit()),
            inertia: EstimateEntry::or_null(fit.inertia, names.inertia_unit()),
            coupling: EstimateEntry::or_null(fit.total_coupling, names.coupling_unit()),
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
        Self {
            term: LawTermEntry::of_model(names, c.term),
            beside_terms: c.beside,
            amplitude: EstimateEntry::of(c.amplitude, amplitude_unit(names, c.term)),
            saved: c.saved,
            standard_errors: finite(c.standard_errors),
            across_kinds: c.across_kinds,
            taken: c.taken,
        }
    }
}
