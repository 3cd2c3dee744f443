//! Terms that a model of the torque may have beyond the line, and their regressors.

use strum::IntoStaticStr;

use crate::drive::Falloff;
use crate::identify::methods::friction_law::blocks::{Acts, Regressor};
use crate::identify::methods::friction_law::law_term::{Column, LawTerm};
use crate::identify::methods::friction_law::rows::Sampled;
use crate::identify::methods::friction_law::thresholds::{NEAR_REST_MOST, TRAVEL_OF_GRAVITY_RAD};
use crate::identify::methods::regression::{MotorColumns, PLACE_COULOMB, PLACE_VISCOUS};
use crate::record::Axis;

/// Speeds over which friction near rest may change, as shares of the fastest.
const NEAR_REST: [f64; 8] = [0.02, 0.03, 0.05, 0.08, 0.12, 0.2, 0.3, NEAR_REST_MOST];

/// An effect that a model of the torque does not contain: it is reported, with what it does to the estimates.
#[derive(Debug, Clone, Copy, PartialEq, Eq, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum MissingKind {
    /// A torque in proportion to position: gravity, a spring, coarse cogging, or a tip sensor with a wrong scale.
    Position,
    /// An unbalanced load: `g_s·sin θ + g_c·cos θ`.
    Gravity,
    /// Damping within the beam in proportion to its stiffness: a torque by the rate of bending.
    BeamDamping,
    /// A torque constant that differs by the sign of the command, for example of an amplifier.
    CommandBySign,
    /// Friction that grows with the torque of the motor, as in gears.
    WithTorque,
    /// Friction that varies over the travel.
    OverTravel,
    /// Coulomb friction that changes from the first sample of the campaign to the last.
    CoulombDrift,
    /// Viscous friction that changes over the campaign, for example of a joint that warms up.
    ViscousDrift,
}

/// A term beyond the line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ModelTerm {
    /// A term of the friction law, which the model may have.
    Law(LawTerm),
    /// An effect that is only reported.
    Missing(MissingKind),
}

impl ModelTerm {
    /// Name in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Law(term) => term.name(),
            Self::Missing(kind) => kind.name(),
        }
    }

    /// The term, if a model may have it.
    pub(super) fn law(self) -> Option<LawTerm> {
        match self {
            Self::Law(term) => Some(term),
            Self::Missing(_) => None,
        }
    }
}

impl MissingKind {
    /// Name in results.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// A term with the columns of its regressors.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Candidate {
    pub(super) term: ModelTerm,
    pub(super) columns: Vec<usize>,
}

/// Terms of one kind, of which a model may have one: they differ in a speed that is not linear in the torque.
pub(super) type Family = Vec<Candidate>;

/// All families but the ripples, and their regressors, whose columns begin at `first`.
pub(super) fn families(
    sampled: &Sampled<'_>,
    fastest: f64,
    first: usize,
) -> (Vec<Family>, Vec<Regressor>) {
    let mut regressors: Vec<Regressor> = Vec::new();
    let mut with = |term: ModelTerm, own: &[Regressor]| {
        let from = first + regressors.len();
        regressors.extend(own);
        Candidate { term, columns: (from..from + own.len()).collect() }
    };
    let mut families = Vec::new();
    for term in laws(sampled) {
        families.push(vec![with(ModelTerm::Law(term), &law_regressors(term))]);
    }
    let near_rest = NEAR_REST.map(|share| {
        let term = LawTerm::NearRest { speed: share * fastest, falloff: Falloff::Exponential };
        with(ModelTerm::Law(term), &law_regressors(term))
    });
    families.push(near_rest.to_vec());
    for kind in missing(sampled) {
        families.push(vec![with(ModelTerm::Missing(kind), &missing_regressors(kind, sampled))]);
    }
    (families, regressors)
}

fn laws(sampled: &Sampled<'_>) -> Vec<LawTerm> {
    let load = sampled.load.map(|load| LawTerm::WithLoad { load });
    [LawTerm::ViscousByDirection, LawTerm::CommandLag, LawTerm::Root]
        .into_iter()
        .chain(load)
        .collect()
}

/// The regressors of a term of the law.
pub(super) fn law_regressors(term: LawTerm) -> Vec<Regressor> {
    let against = |column: Column| Regressor::Function(column, Acts::Against);
    let alike = |column: Column| Regressor::Function(column, Acts::Alike);
    match term {
        LawTerm::ViscousByDirection => vec![Regressor::Own(PLACE_VISCOUS, Acts::Against)],
        LawTerm::CommandLag => vec![alike(Column::Lag)],
        LawTerm::Root => vec![against(Column::Root)],
        LawTerm::WithLoad { load } => vec![against(Column::Load(load))],
        LawTerm::NearRest { speed, falloff } => vec![against(Column::NearRest(speed, falloff))],
        LawTerm::Ripple { per_angle } => {
            vec![against(Column::Cosine(per_angle)), against(Column::Sine(per_angle))]
        }
        LawTerm::TorqueRipple { per_angle } => {
            vec![alike(Column::Cosine(per_angle)), alike(Column::Sine(per_angle))]
        }
    }
}

fn missing(sampled: &Sampled<'_>) -> Vec<MissingKind> {
    let campaign = sampled.campaign;
    let own = MotorColumns::of(campaign);
    let [low, high] = sampled.travel();
    let hangs = campaign.channels.axis == Axis::Rotary
        && campaign.channels.tips.is_empty()
        && high - low > TRAVEL_OF_GRAVITY_RAD;
    let mut kinds = vec![
        MissingKind::CommandBySign,
        MissingKind::WithTorque,
        MissingKind::OverTravel,
        MissingKind::CoulombDrift,
        MissingKind::ViscousDrift,
    ];
    // A spring, or an unbalanced load, would be a part of declared gravity.
    if !own.gravity {
        kinds.push(if hangs { MissingKind::Gravity } else { MissingKind::Position });
    }
    if !own.tips.is_empty() {
        kinds.push(MissingKind::BeamDamping);
    }
    kinds
}

fn missing_regressors(kind: MissingKind, sampled: &Sampled<'_>) -> Vec<Regressor> {
    let [low, high] = sampled.travel();
    let (middle, half) = (f64::midpoint(low, high), 0.5 * (high - low).max(f64::MIN_POSITIVE));
    let of = |power: i32, acts: Acts| {
        Regressor::Function(Column::Position { middle, half, power }, acts)
    };
    match kind {
        MissingKind::Position => vec![of(1, Acts::Alike)],
        MissingKind::Gravity => [Column::Cosine(1.0), Column::Sine(1.0)]
            .map(|column| Regressor::Function(column, Acts::Alike))
            .to_vec(),
        MissingKind::BeamDamping => (0..MotorColumns::of(sampled.campaign).tips.len())
            .map(|tip| Regressor::Function(Column::Rate(tip), Acts::Alike))
            .collect(),
        MissingKind::CommandBySign => vec![Regressor::Size(Acts::Alike)],
        MissingKind::WithTorque => vec![Regressor::Size(Acts::Against)],
        MissingKind::OverTravel => vec![of(1, Acts::Against), of(2, Acts::Against)],
        MissingKind::CoulombDrift => vec![Regressor::Drift(PLACE_COULOMB, Acts::Against)],
        MissingKind::ViscousDrift => vec![Regressor::Drift(PLACE_VISCOUS, Acts::Alike)],
    }
}
