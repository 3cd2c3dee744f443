//! Terms of friction other than Coulomb and viscous friction, in JSON: estimates, and terms of a law.

use std::f64::consts::TAU;

use lissom_core::drive::Falloff;
use lissom_core::identify::{
    LawEstimates, LawTerm, MissingKind, ModelTerm, NearRestEstimate, RippleEstimate,
};
use serde::{Deserialize, Serialize};
use strum::IntoStaticStr;

use super::channel_names::DirectionName;
use super::estimate_entry::{EstimateEntry, NumberEntry};
use super::unit_names::UnitNames;

/// Terms of friction in addition to Coulomb and viscous friction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FrictionTermsEntry {
    /// Friction near rest in addition to Coulomb friction; absent unless the data show it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub near_rest: Option<NearRestEntry>,
    /// mu of the term s*mu*|gravity torque|: friction that grows with the load; absent unless the data show it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub with_load: Option<EstimateEntry>,
    /// Growth with the square root of speed, s*A*sqrt|v|; absent unless the data show it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub root: Option<EstimateEntry>,
    /// Ripples of friction over the travel x, s*A*cos(2*pi*x/period + phase), s the direction; absent unless the data
    /// show them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ripples: Vec<RippleEntry>,
    /// Ripples of torque (cogging), A*cos(2*pi*x/period + phase) in both directions alike; absent unless the data show them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub torque_ripples: Vec<RippleEntry>,
}

/// Friction near rest: s*A*exp(-|v|/v_s) or s*A*exp(-(v/v_s)^2), s the direction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct NearRestEntry {
    /// Amplitude A.
    pub amplitude: Option<EstimateEntry>,
    /// Static friction, the sum of Coulomb friction and A; null unless A is significantly above zero.
    pub static_friction: Option<EstimateEntry>,
    /// Speed v_s.
    pub speed: EstimateEntry,
    /// Which of the two forms.
    pub falloff: Falloff,
}

/// A ripple of friction over the travel.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RippleEntry {
    /// Amplitude A.
    pub amplitude: Option<EstimateEntry>,
    /// Its period.
    pub period: EstimateEntry,
    /// Its phase.
    pub phase: NumberEntry,
}

/// A term of friction, without its amplitude.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LawTermEntry {
    /// Name of the term.
    pub term: LawTermName,
    /// How it changes with speed; only for `near-rest`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub falloff: Option<Falloff>,
    /// Speed v_s; only for `near-rest`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub speed: Option<NumberEntry>,
    /// Its period; only for `ripple` and `torque-ripple`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub period: Option<NumberEntry>,
}

/// A term of friction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, IntoStaticStr)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum LawTermName {
    /// Viscous friction by direction: s*D*v, s the direction.
    ViscousByDirection,
    /// Friction near rest: s*A*exp(-|v|/v_s) or s*A*exp(-(v/v_s)^2), by falloff.
    NearRest,
    /// Square root of the speed: s*A*sqrt|v|.
    Root,
    /// Growth with the load: s*A*|gravity torque|.
    WithLoad,
    /// A ripple: s*(A1*cos(k*x) + A2*sin(k*x)) over the travel x.
    Ripple,
    /// A torque that acts in both directions alike (cogging): A1*cos(k*x) + A2*sin(k*x) over the travel x.
    TorqueRipple,
    /// A lag of the command: time by which the command acts later than it is logged.
    CommandLag,
    /// A torque in proportion to position; only reported.
    Position,
    /// An unbalanced load; only reported.
    Gravity,
    /// Damping within the beam; only reported.
    BeamDamping,
    /// A torque constant that differs by the sign of the command; only reported.
    CommandBySign,
    /// Friction that grows with the torque of the motor; only reported.
    WithTorque,
    /// Friction that varies over the travel; only reported.
    OverTravel,
    /// Coulomb friction that changes over the campaign; only reported.
    CoulombDrift,
    /// Viscous friction that changes over the campaign; only reported.
    ViscousDrift,
}

impl FrictionTermsEntry {
    /// The entry of the estimated terms.
    pub(super) fn of(names: UnitNames, f: &LawEstimates) -> Self {
        Self {
            near_rest: f.near_rest.map(|near| NearRestEntry::of(names, near)),
            with_load: EstimateEntry::or_null(f.with_load, "1"),
            root: EstimateEntry::or_null(f.root, names.root_unit()),
            ripples: f.ripples.iter().map(|r| RippleEntry::of(names, *r)).collect(),
            torque_ripples: f.torque_ripples.iter().map(|r| RippleEntry::of(names, *r)).collect(),
        }
    }
}

impl NearRestEntry {
    fn of(names: UnitNames, near: NearRestEstimate) -> Self {
        Self {
            amplitude: Some(EstimateEntry::of(near.torque, names.torque_unit())),
            static_friction: EstimateEntry::or_null(near.static_friction(), names.torque_unit()),
            speed: EstimateEntry::of(near.speed, names.speed_unit()),
            falloff: near.falloff,
        }
    }
}

impl RippleEntry {
    fn of(names: UnitNames, ripple: RippleEstimate) -> Self {
        Self {
            amplitude: Some(EstimateEntry::of(ripple.torque, names.torque_unit())),
            period: EstimateEntry::of(ripple.period(), names.angle()),
            phase: NumberEntry::of(ripple.phase_rad, "rad"),
        }
    }
}

impl LawTermEntry {
    pub(super) fn of_model(names: UnitNames, term: ModelTerm) -> Self {
        match term {
            ModelTerm::Law(term) => Self::of(names, term),
            ModelTerm::Missing(kind) => Self {
                term: LawTermName::of_missing(kind),
                falloff: None,
                speed: None,
                period: None,
            },
        }
    }

    pub(super) fn of(names: UnitNames, term: LawTerm) -> Self {
        let mut entry =
            Self { term: LawTermName::of(term), falloff: None, speed: None, period: None };
        match term {
            LawTerm::NearRest { speed, falloff } => {
                entry.falloff = Some(falloff);
                entry.speed = Some(NumberEntry::of(speed, names.speed_unit()));
            }
            LawTerm::Ripple { per_angle } | LawTerm::TorqueRipple { per_angle } => {
                entry.period = Some(NumberEntry::of(TAU / per_angle, names.angle()));
            }
            LawTerm::ViscousByDirection
            | LawTerm::Root
            | LawTerm::WithLoad { .. }
            | LawTerm::CommandLag => {}
        }
        entry
    }
}

impl LawTermEntry {
    /// Friction against the motion at a speed in a direction, for an amplitude of one; zero for what is no function of speed.
    pub(super) fn share(&self, speed: f64, direction: DirectionName) -> f64 {
        match self.term {
            LawTermName::ViscousByDirection => direction.sign() * speed,
            LawTermName::NearRest => {
                let both = self.speed.as_ref().zip(self.falloff);
                both.map_or(0.0, |(fall, of)| of.share(speed / fall.value))
            }
            LawTermName::Root => speed.sqrt(),
            _ => 0.0,
        }
    }
}

impl LawTermName {
    /// Its name as in JSON.
    pub fn name(self) -> &'static str {
        self.into()
    }

    fn of_missing(kind: MissingKind) -> Self {
        match kind {
            MissingKind::Position => Self::Position,
            MissingKind::Gravity => Self::Gravity,
            MissingKind::BeamDamping => Self::BeamDamping,
            MissingKind::CommandBySign => Self::CommandBySign,
            MissingKind::WithTorque => Self::WithTorque,
            MissingKind::OverTravel => Self::OverTravel,
            MissingKind::CoulombDrift => Self::CoulombDrift,
            MissingKind::ViscousDrift => Self::ViscousDrift,
        }
    }

    fn of(term: LawTerm) -> Self {
        match term {
            LawTerm::ViscousByDirection => Self::ViscousByDirection,
            LawTerm::NearRest { .. } => Self::NearRest,
            LawTerm::TorqueRipple { .. } => Self::TorqueRipple,
            LawTerm::Root => Self::Root,
            LawTerm::WithLoad { .. } => Self::WithLoad,
            LawTerm::Ripple { .. } => Self::Ripple,
            LawTerm::CommandLag => Self::CommandLag,
        }
    }
}

/// The unit of the amplitude of a term.
pub(super) fn amplitude_unit(names: UnitNames, term: ModelTerm) -> String {
    match term {
        ModelTerm::Law(LawTerm::ViscousByDirection) => names.viscous_unit(),
        ModelTerm::Law(
            LawTerm::NearRest { .. } | LawTerm::Ripple { .. } | LawTerm::TorqueRipple { .. },
        ) => names.torque_unit().to_owned(),
        ModelTerm::Law(LawTerm::Root) => names.root_unit(),
        ModelTerm::Law(LawTerm::CommandLag) => "s".to_owned(),
        ModelTerm::Law(LawTerm::WithLoad { .. }) | ModelTerm::Missing(_) => "1".to_owned(),
    }
}
