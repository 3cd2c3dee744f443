//! Terms of friction other than Coulomb and viscous friction, in JSON: estimates, terms of a law, and terms of an arm.

use std::f64::consts::TAU;

use lissom_core::identify::{Friction, LawTerm, NearRestEstimate, RippleEstimate};
use lissom_core::replay::{DryTerms, NearRest, Ripple};
use serde::{Deserialize, Serialize};

use super::arm_numbers::{Number, Numbers, WrongKey};
use super::channel_names::{DirectionName, FalloffName};
use super::estimate_entry::EstimateEntry;
use super::estimate_keys::{Estimated, Refusable};
use super::unit_keys::{
    AmplitudeKey, CosineKey, PeriodKey, SineKey, SpeedKey, StaticKey, TravelKey, WithUnit,
};
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
    /// Ripples of friction over the travel x, s*A*cos(2*pi*x/period + phase), s the direction; absent unless the data
    /// show them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ripples: Vec<RippleEntry>,
}

/// Friction near rest: s*A*exp(-|v|/v_s) or s*A*exp(-(v/v_s)^2), s the direction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct NearRestEntry {
    /// Amplitude A.
    #[serde(flatten)]
    pub amplitude: Refusable<AmplitudeKey>,
    /// Static friction, the sum of Coulomb friction and A; null unless A is significantly above zero.
    #[serde(flatten)]
    pub static_friction: Refusable<StaticKey>,
    /// Speed v_s.
    #[serde(flatten)]
    pub speed: Estimated<SpeedKey>,
    /// Which of the two forms.
    pub falloff: FalloffName,
}

/// A ripple of friction over the travel.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RippleEntry {
    /// Amplitude A.
    #[serde(flatten)]
    pub amplitude: Refusable<AmplitudeKey>,
    /// Its period.
    #[serde(flatten)]
    pub period: Estimated<PeriodKey>,
}

/// Terms of an arm's friction in addition to Coulomb and viscous friction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ArmTermsEntry {
    /// Friction near rest.
    pub near_rest: Option<ArmNearRestEntry>,
    /// Ripples of friction over the travel.
    pub ripples: Vec<ArmRippleEntry>,
}

/// Friction near rest: s*A*exp(-|v|/v_s) or s*A*exp(-(v/v_s)^2), s the direction. Friction at rest is Coulomb friction
/// plus A.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ArmNearRestEntry {
    /// Amplitude A.
    #[serde(flatten)]
    pub amplitude: Number<AmplitudeKey>,
    /// Speed v_s.
    #[serde(flatten)]
    pub speed: Number<SpeedKey>,
    /// Which of the two forms.
    pub falloff: FalloffName,
}

/// A ripple of friction: s*(cosine*cos(k*x) + sine*sin(k*x)) over the travel x, k = 2*pi/period, s the direction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ArmRippleEntry {
    /// Its period.
    #[serde(flatten)]
    pub period: Number<PeriodKey>,
    /// Amplitude of the cosine.
    #[serde(flatten)]
    pub cosine: Number<CosineKey>,
    /// Amplitude of the sine.
    #[serde(flatten)]
    pub sine: Number<SineKey>,
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
    #[serde(flatten)]
    pub speed: WithUnit<SpeedKey, f64>,
    /// Its period; only for `ripple`.
    #[serde(flatten)]
    pub period: WithUnit<PeriodKey, f64>,
    /// Travel after a reversal that is left out; only for `after-travel`.
    #[serde(flatten)]
    pub travel: WithUnit<TravelKey, f64>,
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
    /// Friction grows after reversals: the first travel after each reversal is left out; no amplitude.
    AfterTravel,
    /// Square root of the speed: s*A*sqrt|v|.
    Root,
    /// Growth with the load: s*A*|gravity torque|.
    WithLoad,
    /// A ripple: s*(A1*cos(k*x) + A2*sin(k*x)) over the travel x.
    Ripple,
    /// A lag of the command: time by which the command acts later than it is logged.
    CommandLag,
}

impl FrictionTermsEntry {
    /// The entry of the estimated terms; `constant` is torque per command.
    pub(super) fn of(names: UnitNames, constant: f64, f: &Friction) -> Self {
        Self {
            near_rest: f.near_rest.map(|near| NearRestEntry::of(names, constant, near)),
            with_load: f.with_load.map(EstimateEntry::of),
            ripples: f.ripples.iter().map(|r| RippleEntry::of(names, constant, *r)).collect(),
        }
    }
}

impl NearRestEntry {
    fn of(names: UnitNames, constant: f64, near: NearRestEstimate) -> Self {
        Self {
            amplitude: WithUnit::torque(names, constant, Some(near.torque)),
            static_friction: WithUnit::torque(names, constant, near.static_friction()),
            speed: WithUnit::new(names, EstimateEntry::of(near.speed)),
            falloff: FalloffName::of(near.falloff),
        }
    }
}

impl RippleEntry {
    fn of(names: UnitNames, constant: f64, ripple: RippleEstimate) -> Self {
        Self {
            amplitude: WithUnit::torque(names, constant, Some(ripple.torque)),
            period: WithUnit::new(names, EstimateEntry::of(ripple.period())),
        }
    }
}

impl ArmTermsEntry {
    pub(super) fn of(names: UnitNames, terms: &DryTerms) -> Self {
        Self {
            near_rest: terms.near_rest.map(|n| ArmNearRestEntry::of(names, &n)),
            ripples: terms.ripples.iter().map(|r| ArmRippleEntry::of(names, r)).collect(),
        }
    }

    pub(super) fn dry_terms(&self, names: UnitNames) -> Result<DryTerms, WrongKey> {
        let ripples = self.ripples.iter().map(|r| r.ripple(names));
        Ok(DryTerms {
            near_rest: self.near_rest.as_ref().map(|n| n.near_rest(names)).transpose()?,
            ripples: ripples.collect::<Result<_, _>>()?,
        })
    }
}

impl ArmNearRestEntry {
    fn of(names: UnitNames, n: &NearRest) -> Self {
        Self {
            amplitude: WithUnit::new(names, n.torque_nm),
            speed: WithUnit::new(names, n.speed_rad_s),
            falloff: FalloffName::of(n.falloff),
        }
    }

    fn near_rest(&self, names: UnitNames) -> Result<NearRest, WrongKey> {
        let number = Numbers { names, at: "arm.near_rest" };
        Ok(NearRest {
            offset_nm: 0.0,
            torque_nm: number.of(&self.amplitude)?,
            speed_rad_s: number.positive(&self.speed)?,
            falloff: self.falloff.falloff(),
        })
    }
}

impl ArmRippleEntry {
    fn of(names: UnitNames, r: &Ripple) -> Self {
        Self {
            period: WithUnit::new(names, TAU / r.per_rad),
            cosine: WithUnit::new(names, r.cosine_nm),
            sine: WithUnit::new(names, r.sine_nm),
        }
    }

    fn ripple(&self, names: UnitNames) -> Result<Ripple, WrongKey> {
        let number = Numbers { names, at: "arm.ripples[]" };
        let period = number.of(&self.period)?;
        if period < SHORTEST {
            return Err(number.wrong(&number.key::<PeriodKey>(), "1e-6 or more"));
        }
        Ok(Ripple {
            per_rad: TAU / period,
            cosine_nm: number.of(&self.cosine)?,
            sine_nm: number.of(&self.sine)?,
        })
    }
}

impl LawTermEntry {
    pub(super) fn of(names: UnitNames, term: LawTerm) -> Self {
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
                entry.period = WithUnit::new(names, TAU / per_angle);
            }
            LawTerm::AfterTravel { travel } => {
                entry.travel = WithUnit::new(names, travel);
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
    pub(super) fn share(&self, names: UnitNames, speed: f64, direction: DirectionName) -> f64 {
        match self.term {
            LawTermName::ViscousByDirection => direction.sign() * speed,
            LawTermName::NearRest => {
                let (fall, falloff) = (self.speed.get(names), self.falloff);
                fall.zip(falloff).map_or(0.0, |(fall, of)| of.falloff().share(speed / fall))
            }
            LawTermName::Root => speed.sqrt(),
            LawTermName::CommandLag
            | LawTermName::Ripple
            | LawTermName::WithLoad
            | LawTermName::AfterTravel => 0.0,
        }
    }
}

impl LawTermName {
    /// Its name as in JSON.
    pub fn name(self) -> &'static str {
        match self {
            Self::ViscousByDirection => "viscous-by-direction",
            Self::NearRest => "near-rest",
            Self::AfterTravel => "after-travel",
            Self::Root => "root",
            Self::WithLoad => "with-load",
            Self::Ripple => "ripple",
            Self::CommandLag => "command-lag",
        }
    }

    fn of(term: LawTerm) -> Self {
        match term {
            LawTerm::ViscousByDirection => Self::ViscousByDirection,
            LawTerm::NearRest { .. } => Self::NearRest,
            LawTerm::AfterTravel { .. } => Self::AfterTravel,
            LawTerm::Root => Self::Root,
            LawTerm::WithLoad { .. } => Self::WithLoad,
            LawTerm::Ripple { .. } => Self::Ripple,
            LawTerm::CommandLag => Self::CommandLag,
        }
    }
}

/// The key `amplitude` with the unit of the term.
pub(super) fn amplitude_key(names: UnitNames, term: LawTerm) -> String {
    match term {
        LawTerm::ViscousByDirection => names.viscous_key("amplitude"),
        LawTerm::NearRest { .. } | LawTerm::AfterTravel { .. } | LawTerm::Ripple { .. } => {
            format!("amplitude_{}", names.torque())
        }
        LawTerm::Root => names.root_key("amplitude"),
        LawTerm::WithLoad { .. } => "amplitude".to_owned(),
        LawTerm::CommandLag => "amplitude_s".to_owned(),
    }
}
