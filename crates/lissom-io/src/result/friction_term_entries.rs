//! Terms of friction other than Coulomb and viscous friction, in JSON: estimates, terms of a law, and terms of an arm.

use std::f64::consts::TAU;

use lissom_core::identify::{
    LawEstimates, LawTerm, MissingKind, ModelTerm, NearRestEstimate, RippleEstimate,
};
use lissom_core::load::{GravityLoad, TorqueRipple};
use lissom_core::replay::{DryTerms, NearRest, Ripple, Root, WithLoad};
use serde::{Deserialize, Serialize};

use super::arm_numbers::{Numbers, WrongKey};
use super::channel_names::{DirectionName, FalloffName};
use super::estimate_entry::{EstimateEntry, NumberEntry};
use super::unit_names::UnitNames;

/// Shortest period of a ripple, in radians or metres, because a simulation follows each wave.
const SHORTEST: f64 = 1e-6;

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
    pub falloff: FalloffName,
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

/// Terms of an arm's friction in addition to Coulomb and viscous friction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ArmTermsEntry {
    /// Friction near rest.
    pub near_rest: Option<ArmNearRestEntry>,
    /// Ripples of friction over the travel.
    pub ripples: Vec<ArmRippleEntry>,
    /// Friction that grows with the square root of speed; absent if there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub root: Option<ArmRootEntry>,
    /// Friction that grows with the torque of gravity; absent if there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub with_load: Option<ArmWithLoadEntry>,
}

/// Friction that grows with the square root of speed: s*A*(sqrt(|v| + e) - sqrt(e)), s the direction, e = 1e-8 in the unit
/// of v.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ArmRootEntry {
    /// Amplitude A.
    pub amplitude: f64,
}

/// Friction that grows with the torque of gravity: s*mu*sqrt(g^2 + d^2) with g = sine*sin(q) + cosine*cos(q), q the motor's
/// angle, s the direction and d a thousandth of the largest g.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ArmWithLoadEntry {
    /// Coefficient mu.
    pub coefficient: f64,
    /// Coefficient of sin(q).
    pub sine: f64,
    /// Coefficient of cos(q).
    pub cosine: f64,
}

/// Friction near rest: s*A*exp(-|v|/v_s) or s*A*exp(-(v/v_s)^2), s the direction. Friction at rest is Coulomb friction
/// plus A.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ArmNearRestEntry {
    /// Amplitude A.
    pub amplitude: f64,
    /// Speed v_s.
    pub speed: f64,
    /// Which of the two forms.
    pub falloff: FalloffName,
}

/// A ripple of friction: s*(cosine*cos(k*x) + sine*sin(k*x)) over the travel x, k = 2*pi/period, s the direction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ArmRippleEntry {
    /// Its period.
    pub period: f64,
    /// Amplitude of the cosine.
    pub cosine: f64,
    /// Amplitude of the sine.
    pub sine: f64,
}

/// A torque ripple (cogging) of the motor: cosine*cos(k*x) + sine*sin(k*x) over the travel x, k = 2*pi/period, in both
/// directions and at rest.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ArmTorqueRippleEntry {
    /// The same keys as those of a ripple of friction.
    #[serde(flatten)]
    wave: ArmRippleEntry,
}

/// A term of friction, without its amplitude.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LawTermEntry {
    /// Name of the term.
    pub term: LawTermName,
    /// How it changes with speed; only for `near-rest`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub falloff: Option<FalloffName>,
    /// Speed v_s; only for `near-rest`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub speed: Option<NumberEntry>,
    /// Its period; only for `ripple` and `torque-ripple`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub period: Option<NumberEntry>,
}

/// A term of friction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
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
            falloff: FalloffName::of(near.falloff),
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

impl ArmTermsEntry {
    pub(super) fn of(terms: &DryTerms) -> Self {
        Self {
            near_rest: terms.near_rest.map(|n| ArmNearRestEntry::of(&n)),
            ripples: terms.ripples.iter().map(ArmRippleEntry::of).collect(),
            root: terms.root.map(|root| ArmRootEntry { amplitude: root.torque_nm_per_root_rad_s }),
            with_load: terms.with_load.map(|term| ArmWithLoadEntry {
                coefficient: term.coefficient,
                sine: term.load.sine_nm,
                cosine: term.load.cosine_nm,
            }),
        }
    }

    pub(super) fn dry_terms(&self) -> Result<DryTerms, WrongKey> {
        let ripples = self.ripples.iter().map(|r| r.ripple("arm.ripples[]"));
        Ok(DryTerms {
            root: self.root.as_ref().map(ArmRootEntry::root).transpose()?,
            with_load: self.with_load.as_ref().map(ArmWithLoadEntry::with_load).transpose()?,
            near_rest: self.near_rest.as_ref().map(ArmNearRestEntry::near_rest).transpose()?,
            ripples: ripples.collect::<Result<_, _>>()?,
        })
    }
}

impl ArmNearRestEntry {
    fn of(n: &NearRest) -> Self {
        Self { amplitude: n.torque_nm, speed: n.speed_rad_s, falloff: FalloffName::of(n.falloff) }
    }

    fn near_rest(&self) -> Result<NearRest, WrongKey> {
        let number = Numbers { at: "arm.near_rest" };
        Ok(NearRest {
            offset_nm: 0.0,
            torque_nm: number.sane("amplitude", self.amplitude)?,
            speed_rad_s: number.positive("speed", self.speed)?,
            falloff: self.falloff.falloff(),
        })
    }
}

impl ArmRootEntry {
    fn root(&self) -> Result<Root, WrongKey> {
        let number = Numbers { at: "arm.root" };
        let amplitude = number.sane("amplitude", self.amplitude)?;
        Ok(Root { torque_nm_per_root_rad_s: amplitude })
    }
}

impl ArmWithLoadEntry {
    fn with_load(&self) -> Result<WithLoad, WrongKey> {
        let number = Numbers { at: "arm.with_load" };
        let sine_nm = number.sane("sine", self.sine)?;
        let cosine_nm = number.sane("cosine", self.cosine)?;
        let coefficient = number.sane("coefficient", self.coefficient)?;
        Ok(WithLoad { coefficient, load: GravityLoad { sine_nm, cosine_nm } })
    }
}

impl ArmTorqueRippleEntry {
    pub(super) fn of(r: &TorqueRipple) -> Self {
        let TorqueRipple { per_rad, cosine_nm, sine_nm } = *r;
        Self { wave: ArmRippleEntry::of(&Ripple { per_rad, cosine_nm, sine_nm }) }
    }

    pub(super) fn torque_ripple(&self) -> Result<TorqueRipple, WrongKey> {
        let wave = self.wave.ripple("arm.torque_ripples[]")?;
        let Ripple { per_rad, cosine_nm, sine_nm } = wave;
        Ok(TorqueRipple { per_rad, cosine_nm, sine_nm })
    }
}

impl ArmRippleEntry {
    fn of(r: &Ripple) -> Self {
        Self { period: TAU / r.per_rad, cosine: r.cosine_nm, sine: r.sine_nm }
    }

    fn ripple(&self, at: &'static str) -> Result<Ripple, WrongKey> {
        let number = Numbers { at };
        let period = number.sane("period", self.period)?;
        if period < SHORTEST {
            return Err(number.wrong("period", "1e-6 or more"));
        }
        Ok(Ripple {
            per_rad: TAU / period,
            cosine_nm: number.sane("cosine", self.cosine)?,
            sine_nm: number.sane("sine", self.sine)?,
        })
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
                entry.falloff = Some(FalloffName::of(falloff));
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
                both.map_or(0.0, |(fall, of)| of.falloff().share(speed / fall.value))
            }
            LawTermName::Root => speed.sqrt(),
            _ => 0.0,
        }
    }
}

impl LawTermName {
    /// Its name as in JSON.
    pub fn name(self) -> &'static str {
        match self {
            Self::ViscousByDirection => "viscous-by-direction",
            Self::NearRest => "near-rest",
            Self::TorqueRipple => "torque-ripple",
            Self::Root => "root",
            Self::WithLoad => "with-load",
            Self::Ripple => "ripple",
            Self::CommandLag => "command-lag",
            Self::Position => "position",
            Self::Gravity => "gravity",
            Self::BeamDamping => "beam-damping",
            Self::CommandBySign => "command-by-sign",
            Self::WithTorque => "with-torque",
            Self::OverTravel => "over-travel",
            Self::CoulombDrift => "coulomb-drift",
            Self::ViscousDrift => "viscous-drift",
        }
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
