//! The arm of a result in JSON, written and read.

use lissom_core::identify::{FoundArm, LagShape, TorqueUsed};
use lissom_core::load::GravityLoad;
use lissom_core::record::{Channels, Tip};
use lissom_core::replay::{ModalArm, Oscillator, Parameter};
use serde::{Deserialize, Serialize};

use super::arm_numbers::{Numbers, WrongKey};
use super::channel_names::{ArmSourceName, TipQuantityName};
use super::estimate_entry::NumberEntry;
use super::friction_term_entries::{ArmTermsEntry, ArmTorqueRippleEntry};
use super::unit_names::UnitNames;

/// The arm of a result. Torques are in N*m or N if the torque constant is known, otherwise in the unit of the command.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ArmEntry {
    /// The method that estimated it.
    pub from: ArmSourceName,
    /// Inertia or mass.
    pub inertia: NumberEntry,
    /// Viscous friction forward, including the damping by back-EMF.
    pub viscous_forward: NumberEntry,
    /// Viscous friction backward, including the damping by back-EMF.
    pub viscous_backward: NumberEntry,
    /// Coulomb friction, mean of both directions.
    pub coulomb: NumberEntry,
    /// (forward - backward)/2.
    pub offset: NumberEntry,
    /// Further terms of friction.
    #[serde(flatten)]
    pub terms: ArmTermsEntry,
    /// Gravity on its motor; null if there is none.
    #[serde(default)]
    pub gravity: Option<ArmGravityEntry>,
    /// Torque ripples (cogging) of its motor; absent if there are none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub torque_ripples: Vec<ArmTorqueRippleEntry>,
    /// Time by which the command acts later than it is logged.
    pub command_lag_s: f64,
    /// Whether that lag is the time constant of a first-order filter, and not a delay.
    #[serde(default)]
    pub command_is_filtered: bool,
    /// Modes with the motor clamped, as oscillators on the motor.
    pub modes: Vec<OscillatorEntry>,
    /// Torque on the motor per deflection of each tip, if the logs show it but no mode. The arm then has no modes and
    /// predicts only the torque. Absent otherwise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub coupling_by_tip: Option<NumberEntry<Vec<f64>>>,
    /// The tips.
    pub tips: Vec<ArmTipEntry>,
    /// Damping of the point of each tip against the fixed frame; empty unless there are as many tips as modes.
    pub damping_at_points_per_s: Vec<f64>,
    /// |logged - predicted|/|logged| of the torque in the logs used, as in lissom validate; null if the tips do not give
    /// the coupling torque.
    pub torque_error: Option<f64>,
    /// Length of the window with which both torques were averaged.
    pub torque_window_s: Option<f64>,
}

/// The torque g_s*sin(q) + g_c*cos(q) on the arm's motor, q its angle as logged.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ArmGravityEntry {
    /// Coefficient g_s.
    pub sine: NumberEntry,
    /// Coefficient g_c.
    pub cosine: NumberEntry,
}

/// A mode as an oscillator on the motor.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct OscillatorEntry {
    /// Its natural frequency.
    pub natural_frequency_rad_s: f64,
    /// Torque on the motor per deflection of the mode.
    pub stiffness: NumberEntry,
    /// Damping within the beam, 2*zeta*omega.
    pub damping_within_per_s: f64,
    /// Damping against the fixed frame, 2*zeta*omega.
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
    /// Share of the deflection of each mode at the tip.
    pub shape: Vec<f64>,
    /// Time by which the tip is read later than the motor.
    pub lag_s: f64,
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
        Self {
            from: ArmSourceName::of(found.source),
            inertia: NumberEntry::of(a.inertia_kg_m2, names.inertia_unit()),
            viscous_forward: NumberEntry::of(a.viscous_nm_s_per_rad[0], names.viscous_unit()),
            viscous_backward: NumberEntry::of(a.viscous_nm_s_per_rad[1], names.viscous_unit()),
            coulomb: NumberEntry::of(a.coulomb_nm, names.torque_unit()),
            offset: NumberEntry::of(a.offset_nm, names.torque_unit()),
            terms: ArmTermsEntry::of(names, &a.dry_terms),
            gravity: a.gravity.map(|g| ArmGravityEntry {
                sine: NumberEntry::of(g.sine_nm, names.torque_unit()),
                cosine: NumberEntry::of(g.cosine_nm, names.torque_unit()),
            }),
            torque_ripples: a
                .torque_ripples
                .iter()
                .map(|r| ArmTorqueRippleEntry::of(names, r))
                .collect(),
            command_lag_s: a.command_lag_s,
            command_is_filtered: found.lag_shape == LagShape::Filter,
            modes: a.modes.iter().map(|m| OscillatorEntry::of(names, m)).collect(),
            coupling_by_tip: Some(found.coupling_alone_nm_per_rad.clone())
                .filter(|c| !c.is_empty())
                .map(|c| NumberEntry::of(c, names.coupling_unit())),
            tips: channels.tips.iter().zip(&a.shapes).enumerate().map(tip).collect(),
            damping_at_points_per_s: a.at_points_per_s.clone(),
            torque_error: found.torque_used.map(|t| t.relative_error),
            torque_window_s: found.torque_used.map(|t| t.window_s),
        }
    }

    /// The arm of this entry; its keys have the units of `names`.
    pub(crate) fn found(&self, names: UnitNames) -> Result<FoundArm, WrongKey> {
        let number = Numbers { at: "arm" };
        let modes = self.modes.iter().map(|m| m.oscillator(names));
        let modes = modes.collect::<Result<Vec<_>, _>>()?;
        let points = self.damping_at_points_per_s.len();
        if points != 0 && points != modes.len() {
            return Err(number.wrong("damping_at_points_per_s", "one number for each mode"));
        }
        if self.tips.iter().any(|tip| tip.shape.len() != modes.len()) {
            return Err(number.wrong("tips[].shape", "one number for each mode"));
        }
        let by_tip = "coupling_by_tip";
        let coupling = match &self.coupling_by_tip {
            Some(coupling) if coupling.unit != names.coupling_unit() => {
                return Err(number.wrong(by_tip, format!("in {}", names.coupling_unit())));
            }
            Some(coupling) => coupling.value.clone(),
            None => Vec::new(),
        };
        if !coupling.is_empty() && (coupling.len() != self.tips.len() || !modes.is_empty()) {
            let expected = "one number for each tip, in an arm without modes";
            return Err(number.wrong(by_tip, expected));
        }
        for value in &coupling {
            number.sane(by_tip, *value)?;
        }
        let lag = |tip: &ArmTipEntry| Numbers { at: "arm.tips[]" }.sane("lag_s", tip.lag_s);
        let lags = self.tips.iter().map(lag).collect::<Result<Vec<_>, _>>()?;
        let window = self.torque_window_s.filter(|window| *window > 0.0);
        let torque = names.torque_unit();
        let viscous = |key: &str, value| number.of(key, value, names.viscous_unit());
        let gravity = self.gravity.as_ref().map(|g| {
            let number = Numbers { at: "arm.gravity" };
            let sine_nm = number.of("sine", &g.sine, torque)?;
            let cosine_nm = number.of("cosine", &g.cosine, torque)?;
            Ok(GravityLoad { sine_nm, cosine_nm })
        });
        let ripples = self.torque_ripples.iter().map(|r| r.torque_ripple(names));
        let arm = ModalArm {
            inertia_kg_m2: number.positive("inertia", &self.inertia, names.inertia_unit())?,
            viscous_nm_s_per_rad: [
                viscous("viscous_forward", &self.viscous_forward)?,
                viscous("viscous_backward", &self.viscous_backward)?,
            ],
            coulomb_nm: number.of("coulomb", &self.coulomb, torque)?,
            offset_nm: number.of("offset", &self.offset, torque)?,
            dry_terms: self.terms.dry_terms(names)?,
            shapes: self.tips.iter().map(|tip| tip.shape.clone()).collect(),
            at_points_per_s: self.damping_at_points_per_s.clone(),
            gravity: gravity.transpose()?,
            torque_ripples: ripples.collect::<Result<_, _>>()?,
            command_lag_s: number.sane("command_lag_s", self.command_lag_s)?,
            // Empty if no tip has a delay.
            tip_lags_s: if lags.iter().all(|lag| *lag == 0.0) { Vec::new() } else { lags },
            modes,
        };
        Ok(FoundArm {
            arm,
            coupling_alone_nm_per_rad: coupling,
            source: self.from.source(),
            lag_shape: if self.command_is_filtered { LagShape::Filter } else { LagShape::Delay },
            torque_used: self
                .torque_error
                .zip(window)
                .map(|(relative_error, window_s)| TorqueUsed { relative_error, window_s }),
        })
    }
}

impl OscillatorEntry {
    fn of(names: UnitNames, m: &Oscillator) -> Self {
        Self {
            natural_frequency_rad_s: m.omega_rad_s,
            stiffness: NumberEntry::of(m.stiffness_nm_per_rad, names.coupling_unit()),
            damping_within_per_s: m.within_per_s,
            damping_grounded_per_s: m.grounded_per_s,
        }
    }

    fn oscillator(&self, names: UnitNames) -> Result<Oscillator, WrongKey> {
        let number = Numbers { at: "arm.modes[]" };
        let frequency = "natural_frequency_rad_s";
        let omega_rad_s = number.sane(frequency, self.natural_frequency_rad_s)?;
        if omega_rad_s <= 0.0 {
            return Err(number.wrong(frequency, "greater than zero"));
        }
        Ok(Oscillator {
            omega_rad_s,
            stiffness_nm_per_rad: number.positive(
                "stiffness",
                &self.stiffness,
                names.coupling_unit(),
            )?,
            within_per_s: number.sane("damping_within_per_s", self.damping_within_per_s)?,
            grounded_per_s: number.sane("damping_grounded_per_s", self.damping_grounded_per_s)?,
        })
    }
}
