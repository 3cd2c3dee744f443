//! The arm of a result, in JSON: written from the arm found, and read back to it.

use std::f64::consts::TAU;

use lissom::identify::{FoundArm, TorqueUsed};
use lissom::record::{Channels, Tip};
use lissom::replay::{DryTerms, ModalArm, NearRest, Oscillator, Parameter, Ripple};
use serde::{Deserialize, Serialize};

use super::channel_names::{ArmSourceName, FalloffName, TipQuantityName};
use super::unit_keys::{
    AmplitudeKey, CosineKey, CoulombKey, InertiaKey, OffsetKey, PeriodKey, Quantity, SineKey,
    SpeedKey, StiffnessKey, ViscousBackwardKey, ViscousForwardKey, WithUnit,
};
use super::unit_names::UnitNames;

/// No machine has a larger number in SI.
const LARGEST: f64 = 1e12;

/// Shortest period of a ripple, in radians or metres: a replay follows each wave.
const SHORTEST: f64 = 1e-6;

/// A number under a key with its unit.
type Number<Q> = WithUnit<Q, f64>;

/// The arm of a result. Torques are in N*m or N where the torque constant is known, else in the command's unit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ArmEntry {
    /// Method that it is from.
    pub from: ArmSourceName,
    /// Inertia or mass.
    #[serde(flatten)]
    pub inertia: Number<InertiaKey>,
    /// Viscous friction forward, the back-EMF's damping in it.
    #[serde(flatten)]
    pub viscous_forward: Number<ViscousForwardKey>,
    /// Viscous friction backward, the back-EMF's damping in it.
    #[serde(flatten)]
    pub viscous_backward: Number<ViscousBackwardKey>,
    /// Mean of both directions.
    #[serde(flatten)]
    pub coulomb: Number<CoulombKey>,
    /// (forward - backward)/2.
    #[serde(flatten)]
    pub offset: Number<OffsetKey>,
    /// Friction near rest.
    pub near_rest: Option<ArmNearRestEntry>,
    /// Friction over the travel.
    pub ripples: Vec<ArmRippleEntry>,
    /// The command acts this much later than it is logged.
    pub command_lag_s: f64,
    /// Modes with the motor clamped, as oscillators on the motor.
    pub modes: Vec<OscillatorEntry>,
    /// The tips.
    pub tips: Vec<ArmTipEntry>,
    /// Damping of each tip's point against the fixed frame; empty unless there are as many tips as modes.
    pub damping_at_points_per_s: Vec<f64>,
    /// |logged - predicted|/|logged| of the torque of the logs used, as lissom validate gives it; null where the tips
    /// do not give the coupling torque.
    pub torque_error: Option<f64>,
    /// Length of the window that both sides were averaged with.
    pub torque_window_s: Option<f64>,
}

/// s*A*exp(-|v|/v_s) or s*A*exp(-(v/v_s)^2), s the direction: friction at rest is A more than Coulomb friction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ArmNearRestEntry {
    /// A.
    #[serde(flatten)]
    pub amplitude: Number<AmplitudeKey>,
    /// v_s.
    #[serde(flatten)]
    pub speed: Number<SpeedKey>,
    /// Which of the two.
    pub falloff: FalloffName,
}

/// s*(cosine*cos(k*x) + sine*sin(k*x)) over the travel x, k = 2*pi/period.
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

/// A mode as an oscillator on the motor.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct OscillatorEntry {
    /// Its natural frequency.
    pub natural_frequency_rad_s: f64,
    /// Torque on the motor per deflection of the mode.
    #[serde(flatten)]
    pub stiffness: Number<StiffnessKey>,
    /// 2*zeta*omega of damping within the beam.
    pub damping_within_per_s: f64,
    /// 2*zeta*omega of damping against the fixed frame.
    pub damping_grounded_per_s: f64,
}

/// A tip of the arm.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ArmTipEntry {
    /// Its name.
    pub name: String,
    /// What it measures.
    pub quantity: TipQuantityName,
    /// Share of each mode's deflection that the tip sees.
    pub shape: Vec<f64>,
    /// The tip shows what its point did this much before the motor shows what it did then.
    pub lag_s: f64,
}

/// A key of an arm that is missing, or not what it should be.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct WrongKey {
    /// The key, dotted.
    pub(crate) key: String,
    /// What it should be.
    pub(crate) expected: &'static str,
}

impl ArmEntry {
    /// The entry of an arm found.
    pub fn of(channels: &Channels, names: UnitNames, found: &FoundArm) -> Self {
        let a = &found.arm;
        let tip = |(i, (tip, shape)): (usize, (&Tip, &Vec<f64>))| ArmTipEntry {
            name: tip.name.clone(),
            quantity: TipQuantityName::of(tip.quantity),
            shape: shape.clone(),
            lag_s: Parameter::TipLag(i).of(a),
        };
        let terms = &a.dry_terms;
        Self {
            from: ArmSourceName::of(found.source),
            inertia: WithUnit::new(names, a.inertia_kg_m2),
            viscous_forward: WithUnit::new(names, a.viscous_nm_s_per_rad[0]),
            viscous_backward: WithUnit::new(names, a.viscous_nm_s_per_rad[1]),
            coulomb: WithUnit::new(names, a.coulomb_nm),
            offset: WithUnit::new(names, a.offset_nm),
            near_rest: terms.near_rest.map(|n| ArmNearRestEntry {
                amplitude: WithUnit::new(names, n.torque_nm),
                speed: WithUnit::new(names, n.speed_rad_s),
                falloff: FalloffName::of(n.falloff),
            }),
            ripples: terms.ripples.iter().map(|r| ArmRippleEntry::of(names, r)).collect(),
            command_lag_s: a.command_lag_s,
            modes: a.modes.iter().map(|m| OscillatorEntry::of(names, m)).collect(),
            tips: channels.tips.iter().zip(&a.shapes).enumerate().map(tip).collect(),
            damping_at_points_per_s: a.at_points_per_s.clone(),
            torque_error: found.torque_used.map(|t| t.relative_error),
            torque_window_s: found.torque_used.map(|t| t.window_s),
        }
    }

    /// The arm that the entry says; keys have the units of `names`.
    pub(crate) fn found(&self, names: UnitNames) -> Result<FoundArm, WrongKey> {
        let number = Numbers { names, at: "arm" };
        let modes = self.modes.iter().map(|m| m.oscillator(names));
        let modes = modes.collect::<Result<Vec<_>, _>>()?;
        let points = self.damping_at_points_per_s.len();
        if points != 0 && points != modes.len() {
            return Err(number.wrong("damping_at_points_per_s", "one number for each mode"));
        }
        if self.tips.iter().any(|tip| tip.shape.len() != modes.len()) {
            return Err(number.wrong("tips[].shape", "one number for each mode"));
        }
        let lag = |tip: &ArmTipEntry| Numbers { names, at: "arm.tips[]" }.sane("lag_s", tip.lag_s);
        let lags = self.tips.iter().map(lag).collect::<Result<Vec<_>, _>>()?;
        let ripples = self.ripples.iter().map(|r| r.ripple(names));
        let window = self.torque_window_s.filter(|window| *window > 0.0);
        let arm = ModalArm {
            inertia_kg_m2: number.positive(&self.inertia)?,
            viscous_nm_s_per_rad: [
                number.of(&self.viscous_forward)?,
                number.of(&self.viscous_backward)?,
            ],
            coulomb_nm: number.of(&self.coulomb)?,
            offset_nm: number.of(&self.offset)?,
            dry_terms: DryTerms {
                near_rest: self.near_rest.as_ref().map(|n| n.near_rest(names)).transpose()?,
                ripples: ripples.collect::<Result<_, _>>()?,
            },
            shapes: self.tips.iter().map(|tip| tip.shape.clone()).collect(),
            at_points_per_s: self.damping_at_points_per_s.clone(),
            command_lag_s: number.sane("command_lag_s", self.command_lag_s)?,
            // Empty where all tips are in time.
            tip_lags_s: if lags.iter().all(|lag| *lag == 0.0) { Vec::new() } else { lags },
            modes,
        };
        Ok(FoundArm {
            arm,
            source: self.from.source(),
            torque_used: self
                .torque_error
                .zip(window)
                .map(|(relative_error, window_s)| TorqueUsed { relative_error, window_s }),
        })
    }
}

impl ArmNearRestEntry {
    fn near_rest(&self, names: UnitNames) -> Result<NearRest, WrongKey> {
        let number = Numbers { names, at: "arm.near_rest" };
        Ok(NearRest {
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

impl OscillatorEntry {
    fn of(names: UnitNames, m: &Oscillator) -> Self {
        Self {
            natural_frequency_rad_s: m.omega_rad_s,
            stiffness: WithUnit::new(names, m.stiffness_nm_per_rad),
            damping_within_per_s: m.within_per_s,
            damping_grounded_per_s: m.grounded_per_s,
        }
    }

    fn oscillator(&self, names: UnitNames) -> Result<Oscillator, WrongKey> {
        let number = Numbers { names, at: "arm.modes[]" };
        let frequency = "natural_frequency_rad_s";
        let omega_rad_s = number.sane(frequency, self.natural_frequency_rad_s)?;
        if omega_rad_s <= 0.0 {
            return Err(number.wrong(frequency, "greater than zero"));
        }
        Ok(Oscillator {
            omega_rad_s,
            stiffness_nm_per_rad: number.positive(&self.stiffness)?,
            within_per_s: number.sane("damping_within_per_s", self.damping_within_per_s)?,
            grounded_per_s: number.sane("damping_grounded_per_s", self.damping_grounded_per_s)?,
        })
    }
}

/// Takes numbers out of a table of an arm.
struct Numbers {
    names: UnitNames,
    at: &'static str,
}

impl Numbers {
    fn wrong(&self, key: &str, expected: &'static str) -> WrongKey {
        WrongKey { key: format!("{}.{key}", self.at), expected }
    }

    fn key<Q: Quantity>(&self) -> String {
        Q::keys(self.names).pop().unwrap_or_default()
    }

    fn sane(&self, key: &str, value: f64) -> Result<f64, WrongKey> {
        if value.abs() > LARGEST {
            return Err(self.wrong(key, "a number that a machine may have"));
        }
        Ok(value)
    }

    fn of<Q: Quantity>(&self, number: &Number<Q>) -> Result<f64, WrongKey> {
        let key = self.key::<Q>();
        let value = number.get(self.names).ok_or_else(|| self.wrong(&key, "a number"))?;
        self.sane(&key, *value)
    }

    fn positive<Q: Quantity>(&self, number: &Number<Q>) -> Result<f64, WrongKey> {
        let value = self.of(number)?;
        if value > 0.0 { Ok(value) } else { Err(self.wrong(&self.key::<Q>(), "greater than zero")) }
    }
}
