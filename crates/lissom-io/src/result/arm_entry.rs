//! The arm of a result in JSON, written and read.

use lissom_core::identify::{FoundArm, LagShape, TorqueUsed};
use lissom_core::load::GravityLoad;
use lissom_core::record::{Channels, Tip};
use lissom_core::replay::{ModalArm, Oscillator, Parameter};
use serde::{Deserialize, Serialize};

use super::arm_numbers::{Numbers, WrongKey};
use super::channel_names::{ArmSourceName, TipQuantityName};
use super::friction_term_entries::{ArmTermsEntry, ArmTorqueRippleEntry};
use super::unit_names::UnitNames;

/// The arm of a result.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ArmEntry {
    /// The method that estimated it.
    pub from: ArmSourceName,
    /// Unit of its torques; its other numbers are in this unit with rad (linear axes: m) and s.
    pub torque_unit: String,
    /// Inertia or mass.
    pub inertia: f64,
    /// Viscous friction forward, including the damping by back-EMF.
    pub viscous_forward: f64,
    /// Viscous friction backward, including the damping by back-EMF.
    pub viscous_backward: f64,
    /// Coulomb friction, mean of both directions.
    pub coulomb: f64,
    /// (forward - backward)/2.
    pub offset: f64,
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
    pub coupling_by_tip: Option<Vec<f64>>,
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
    pub sine: f64,
    /// Coefficient g_c.
    pub cosine: f64,
}

/// A mode as an oscillator on the motor.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct OscillatorEntry {
    /// Its natural frequency.
    pub natural_frequency_rad_s: f64,
    /// Torque on the motor per deflection of the mode.
    pub stiffness: f64,
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
            torque_unit: names.torque_unit().to_owned(),
            inertia: a.inertia_kg_m2,
            viscous_forward: a.viscous_nm_s_per_rad[0],
            viscous_backward: a.viscous_nm_s_per_rad[1],
            coulomb: a.coulomb_nm,
            offset: a.offset_nm,
            terms: ArmTermsEntry::of(&a.dry_terms),
            gravity: a.gravity.map(|g| ArmGravityEntry { sine: g.sine_nm, cosine: g.cosine_nm }),
            torque_ripples: a.torque_ripples.iter().map(ArmTorqueRippleEntry::of).collect(),
            command_lag_s: a.command_lag_s,
            command_is_filtered: found.lag_shape == LagShape::Filter,
            modes: a.modes.iter().map(OscillatorEntry::of).collect(),
            coupling_by_tip: Some(found.coupling_alone_nm_per_rad.clone())
                .filter(|c| !c.is_empty()),
            tips: channels.tips.iter().zip(&a.shapes).enumerate().map(tip).collect(),
            damping_at_points_per_s: a.at_points_per_s.clone(),
            torque_error: found.torque_used.map(|t| t.relative_error),
            torque_window_s: found.torque_used.map(|t| t.window_s),
        }
    }

    /// The arm of this entry, for logs with the units of `names`.
    pub(crate) fn found(&self, names: UnitNames) -> Result<FoundArm, WrongKey> {
        let number = Numbers { at: "arm" };
        let modes = self.modes.iter().map(OscillatorEntry::oscillator);
        let modes = modes.collect::<Result<Vec<_>, _>>()?;
        let points = self.damping_at_points_per_s.len();
        if points != 0 && points != modes.len() {
            return Err(number.wrong("damping_at_points_per_s", "one number for each mode"));
        }
        if self.tips.iter().any(|tip| tip.shape.len() != modes.len()) {
            return Err(number.wrong("tips[].shape", "one number for each mode"));
        }
        let torque = names.torque_unit();
        if self.torque_unit != torque {
            return Err(number.wrong("torque_unit", torque));
        }
        let by_tip = "coupling_by_tip";
        let coupling = self.coupling_by_tip.clone().unwrap_or_default();
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
        let gravity = self.gravity.as_ref().map(|g| {
            let number = Numbers { at: "arm.gravity" };
            let sine_nm = number.sane("sine", g.sine)?;
            let cosine_nm = number.sane("cosine", g.cosine)?;
            Ok(GravityLoad { sine_nm, cosine_nm })
        });
        let ripples = self.torque_ripples.iter().map(ArmTorqueRippleEntry::torque_ripple);
        let arm = ModalArm {
            inertia_kg_m2: number.positive("inertia", self.inertia)?,
            viscous_nm_s_per_rad: [
                number.sane("viscous_forward", self.viscous_forward)?,
                number.sane("viscous_backward", self.viscous_backward)?,
            ],
            coulomb_nm: number.sane("coulomb", self.coulomb)?,
            offset_nm: number.sane("offset", self.offset)?,
            dry_terms: self.terms.dry_terms()?,
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
    fn of(m: &Oscillator) -> Self {
        Self {
            natural_frequency_rad_s: m.omega_rad_s,
            stiffness: m.stiffness_nm_per_rad,
            damping_within_per_s: m.within_per_s,
            damping_grounded_per_s: m.grounded_per_s,
        }
    }

    fn oscillator(&self) -> Result<Oscillator, WrongKey> {
        let number = Numbers { at: "arm.modes[]" };
        let frequency = "natural_frequency_rad_s";
        let omega_rad_s = number.sane(frequency, self.natural_frequency_rad_s)?;
        if omega_rad_s <= 0.0 {
            return Err(number.wrong(frequency, "greater than zero"));
        }
        // Only tips show a mode without stiffness.
        let stiffness_nm_per_rad = number.sane("stiffness", self.stiffness)?;
        if stiffness_nm_per_rad < 0.0 {
            return Err(number.wrong("stiffness", "zero or greater"));
        }
        Ok(Oscillator {
            omega_rad_s,
            stiffness_nm_per_rad,
            within_per_s: number.sane("damping_within_per_s", self.damping_within_per_s)?,
            grounded_per_s: number.sane("damping_grounded_per_s", self.damping_grounded_per_s)?,
        })
    }
}
