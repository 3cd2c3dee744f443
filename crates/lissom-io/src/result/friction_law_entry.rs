//! The choice of the friction law, in JSON.

use lissom::identify::{Estimate, FrictionLaw, LawCandidate, LawFit, LawTerm};
use serde::{Deserialize, Serialize};

use super::channel_names::FalloffName;
use super::estimate_entry::EstimateEntry;
use super::friction_entry::{Estimated, Refusable};
use super::unit_keys::{
    AtRestKey, CoulombKey, CouplingKey, InertiaKey, LawAmplitudeKey, OffsetKey, PeriodKey,
    SpeedKey, TravelKey, ViscousKey, WithUnit,
};
use super::unit_names::UnitNames;

/// Friction's law by evidence, on short windows in slip phases.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FrictionLawEntry {
    /// Length of the windows.
    pub window_s: f64,
    /// Part of the windowed torque that is left.
    pub relative_residual: LawResidualEntry,
    /// Estimates under the law chosen.
    pub chosen: ChosenLawEntry,
    /// Every term tried, in the order of trying.
    pub candidates: Vec<LawCandidateEntry>,
}

/// Part of the windowed torque that laws leave.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LawResidualEntry {
    /// By Coulomb and one viscous constant.
    pub simplest: f64,
    /// By the law chosen.
    pub chosen: f64,
    /// By the friction curve.
    pub curve: f64,
}

/// Estimates under the law chosen.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ChosenLawEntry {
    /// Coulomb friction.
    #[serde(flatten)]
    pub coulomb: Refusable<CoulombKey>,
    /// Its offset.
    #[serde(flatten)]
    pub offset: Refusable<OffsetKey>,
    /// Viscous friction.
    #[serde(flatten)]
    pub viscous: Refusable<ViscousKey>,
    /// Inertia or mass.
    #[serde(flatten)]
    pub inertia: Refusable<InertiaKey>,
    /// Coupling.
    #[serde(flatten)]
    pub coupling: Refusable<CouplingKey>,
    /// Its further terms.
    pub terms: Vec<ChosenTermEntry>,
}

/// A term of friction, without its amplitude.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LawTermEntry {
    /// Which.
    pub term: LawTermName,
    /// How it falls off with speed; of `near-rest` alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub falloff: Option<FalloffName>,
    /// v_s; of `near-rest` alone.
    #[serde(flatten)]
    pub speed: WithUnit<SpeedKey, f64>,
    /// Its period; of `ripple` alone.
    #[serde(flatten)]
    pub period: WithUnit<PeriodKey, f64>,
    /// Travel after a reversal that is left out; of `after-travel` alone.
    #[serde(flatten)]
    pub travel: WithUnit<TravelKey, f64>,
}

/// A term of the law chosen.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ChosenTermEntry {
    /// Which.
    #[serde(flatten)]
    pub term: LawTermEntry,
    /// Its amplitude, of a ripple cosine and sine; empty where it has none.
    #[serde(flatten)]
    pub amplitude: WithUnit<LawAmplitudeKey, Vec<EstimateEntry>>,
}

/// A term that was tried.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LawCandidateEntry {
    /// Which.
    #[serde(flatten)]
    pub term: LawTermEntry,
    /// Terms that the law had before.
    pub beside_terms: usize,
    /// Its amplitude, of a ripple that of cosine and sine together.
    #[serde(flatten)]
    pub amplitude: Estimated<LawAmplitudeKey>,
    /// Residual with it relative to the residual without it.
    pub residual_ratio: f64,
    /// Standard errors by which slip phases left out are described better.
    pub paired_deviations: f64,
    /// The residual on kinds of stretches (direction, speed, side of the travel) left out, as a ratio.
    pub stretch_ratio: f64,
    /// Friction at rest with it, in the direction where it is less.
    #[serde(flatten)]
    pub at_rest: Estimated<AtRestKey>,
    /// Whether it was taken.
    pub taken: bool,
}

/// A term of friction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum LawTermName {
    /// s*D*v, s the direction.
    ViscousByDirection,
    /// s*A*exp(-|v|/v_s) or s*A*exp(-(v/v_s)^2), by falloff.
    NearRest,
    /// No amplitude: the first travel after reversals is left out.
    AfterTravel,
    /// s*A*sqrt|v|.
    Root,
    /// s*(A1*cos(k*x) + A2*sin(k*x)) over the travel x.
    Ripple,
    /// Time by which the command acts later.
    CommandLag,
}

impl FrictionLawEntry {
    /// The choice of a law; `constant` is torque per command.
    pub(crate) fn of(names: UnitNames, constant: f64, law: &FrictionLaw) -> Self {
        let [simplest, chosen, curve] = law.relative_residual;
        Self {
            window_s: law.window_s,
            relative_residual: LawResidualEntry { simplest, chosen, curve },
            chosen: ChosenLawEntry::of(names, constant, &law.chosen),
            candidates: law.candidates.iter().map(|c| LawCandidateEntry::of(names, c)).collect(),
        }
    }
}

impl ChosenLawEntry {
    fn of(names: UnitNames, constant: f64, fit: &LawFit) -> Self {
        let term = |(term, amplitudes): &(LawTerm, Vec<Estimate>)| ChosenTermEntry {
            term: LawTermEntry::of(names, *term),
            // A ripple's period stands beside it.
            amplitude: WithUnit::under(
                amplitude_key(names, *term),
                EstimateEntry::list(amplitudes.iter().take(2)),
            ),
        };
        Self {
            coulomb: WithUnit::torque(names, constant, fit.coulomb),
            offset: WithUnit::torque(names, constant, fit.offset),
            viscous: WithUnit::new(names, EstimateEntry::or_null(fit.viscous)),
            inertia: WithUnit::new(names, EstimateEntry::or_null(fit.inertia)),
            coupling: WithUnit::new(names, EstimateEntry::or_null(fit.total_coupling)),
            terms: fit.terms.iter().map(term).collect(),
        }
    }
}

impl LawCandidateEntry {
    fn of(names: UnitNames, c: &LawCandidate) -> Self {
        let at_rest = Estimate { value: c.at_rest, std: c.at_rest_std };
        Self {
            term: LawTermEntry::of(names, c.term),
            beside_terms: c.beside,
            amplitude: WithUnit::under(
                amplitude_key(names, c.term),
                EstimateEntry::of(c.amplitude),
            ),
            residual_ratio: c.residual_ratio,
            paired_deviations: c.paired,
            stretch_ratio: c.stretch_ratio,
            at_rest: WithUnit::new(names, EstimateEntry::of(at_rest)),
            taken: c.taken,
        }
    }
}

impl LawTermEntry {
    fn of(names: UnitNames, term: LawTerm) -> Self {
        let mut entry = Self {
            term: LawTermName::of(term),
            falloff: None,
            speed: WithUnit::absent(),
            period: WithUnit::absent(),
            travel: WithUnit::absent(),
        };
        match term {
            LawTerm::NearRest { speed, falloff } => {
                entry.falloff = Some(FalloffName::of(falloff));
                entry.speed = WithUnit::new(names, speed);
            }
            LawTerm::Ripple { per_angle } => {
                entry.period = WithUnit::new(names, std::f64::consts::TAU / per_angle);
            }
            LawTerm::AfterTravel { travel } => {
                entry.travel = WithUnit::new(names, travel);
            }
            LawTerm::ViscousByDirection | LawTerm::Root | LawTerm::CommandLag => {}
        }
        entry
    }
}

impl LawTermName {
    fn of(term: LawTerm) -> Self {
        match term {
            LawTerm::ViscousByDirection => Self::ViscousByDirection,
            LawTerm::NearRest { .. } => Self::NearRest,
            LawTerm::AfterTravel { .. } => Self::AfterTravel,
            LawTerm::Root => Self::Root,
            LawTerm::Ripple { .. } => Self::Ripple,
            LawTerm::CommandLag => Self::CommandLag,
        }
    }
}

/// `amplitude` with the unit of the term.
fn amplitude_key(names: UnitNames, term: LawTerm) -> String {
    match term {
        LawTerm::ViscousByDirection => names.viscous_key("amplitude"),
        LawTerm::NearRest { .. } | LawTerm::AfterTravel { .. } | LawTerm::Ripple { .. } => {
            format!("amplitude_{}", names.torque())
        }
        LawTerm::Root => names.root_key("amplitude"),
        LawTerm::CommandLag => "amplitude_s".to_owned(),
    }
}
