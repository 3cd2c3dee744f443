//! The arm of a result in JSON, written and read.

use lissom_core::identify::{ArmSource, FoundArm, LagShape, TorqueUsed};
use lissom_core::load::{GravityLoad, TorqueRipple};
use lissom_core::record::{Channels, Tip, TipQuantity};
use lissom_core::replay::{DryTerms, ModalArm, Oscillator, Parameter};
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::unit_names::UnitNames;

/// Largest plausible number in SI.
const LARGEST: f64 = 1e12;
/// Largest wave number of a ripple, a period of about 1e-6 rad or m, because a simulation follows each wave.
const LARGEST_WAVE_NUMBER: f64 = 6e6;

/// The arm of a result.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ArmEntry {
    /// The method that estimated it.
    pub from: ArmSource,
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
    pub terms: DryTerms,
    /// Gravity on its motor; null if there is none.
    pub gravity: Option<GravityLoad>,
    /// Torque ripples (cogging) of its motor.
    pub torque_ripples: Vec<TorqueRipple>,
    /// Time by which the command acts later than it is logged.
    pub command_lag_s: f64,
    /// Whether that lag is the time constant of a first-order filter, and not a delay.
    pub command_is_filtered: bool,
    /// Modes with the motor clamped, as oscillators on the motor.
    pub modes: Vec<Oscillator>,
    /// Torque on the motor per deflection of each tip, if the logs show it but no mode. The arm then has no modes and
    /// predicts only the torque. Empty otherwise.
    pub coupling_by_tip: Vec<f64>,
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

/// A tip of the arm.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ArmTipEntry {
    /// Its name.
    pub name: String,
    /// What it measures.
    pub quantity: TipQuantity,
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
            quantity: tip.quantity,
            shape: shape.clone(),
            lag_s: Parameter::TipLag(i).of(a),
        };
        Self {
            from: found.source,
            torque_unit: names.torque_unit().to_owned(),
            inertia: a.inertia_kg_m2,
            viscous_forward: a.viscous_nm_s_per_rad[0],
            viscous_backward: a.viscous_nm_s_per_rad[1],
            coulomb: a.coulomb_nm,
            offset: a.offset_nm,
            terms: a.dry_terms.clone(),
            gravity: a.gravity,
            torque_ripples: a.torque_ripples.clone(),
            command_lag_s: a.command_lag_s,
            command_is_filtered: found.lag_shape == LagShape::Filter,
            modes: a.modes.clone(),
            coupling_by_tip: found.coupling_alone_nm_per_rad.clone(),
            tips: channels.tips.iter().zip(&a.shapes).enumerate().map(tip).collect(),
            damping_at_points_per_s: a.at_points_per_s.clone(),
            torque_error: found.torque_used.map(|t| t.relative_error),
            torque_window_s: found.torque_used.map(|t| t.window_s),
        }
    }

    /// The arm of this entry, for logs with the units of `names`.
    pub(crate) fn found(&self, names: UnitNames) -> Result<FoundArm, WrongKey> {
        let shapes = || self.tips.iter().map(|tip| tip.shape.len());
        let coupling = &self.coupling_by_tip;
        if ![0, self.modes.len()].contains(&self.damping_at_points_per_s.len()) {
            return Err(WrongKey::new("damping_at_points_per_s", "one number for each mode"));
        }
        if shapes().any(|modes| modes != self.modes.len()) {
            return Err(WrongKey::new("tips[].shape", "one number for each mode"));
        }
        if self.torque_unit != names.torque_unit() {
            return Err(WrongKey::new("torque_unit", names.torque_unit()));
        }
        if !coupling.is_empty() && (coupling.len() != self.tips.len() || !self.modes.is_empty()) {
            let expected = "one number for each tip, in an arm without modes";
            return Err(WrongKey::new("coupling_by_tip", expected));
        }
        self.check_numbers()?;
        let lags = self.tips.iter().map(|tip| tip.lag_s);
        let window = self.torque_window_s.filter(|window| *window > 0.0);
        let arm = ModalArm {
            inertia_kg_m2: self.inertia,
            viscous_nm_s_per_rad: [self.viscous_forward, self.viscous_backward],
            coulomb_nm: self.coulomb,
            offset_nm: self.offset,
            dry_terms: self.terms.clone(),
            shapes: self.tips.iter().map(|tip| tip.shape.clone()).collect(),
            at_points_per_s: self.damping_at_points_per_s.clone(),
            gravity: self.gravity,
            torque_ripples: self.torque_ripples.clone(),
            command_lag_s: self.command_lag_s,
            // Empty if no tip has a delay.
            tip_lags_s: if lags.clone().all(|lag| lag == 0.0) { vec![] } else { lags.collect() },
            modes: self.modes.clone(),
        };
        Ok(FoundArm {
            arm,
            coupling_alone_nm_per_rad: coupling.clone(),
            source: self.from,
            lag_shape: if self.command_is_filtered { LagShape::Filter } else { LagShape::Delay },
            torque_used: self
                .torque_error
                .zip(window)
                .map(|(relative_error, window_s)| TorqueUsed { relative_error, window_s }),
        })
    }

    /// Checks that no number is implausibly large, and that those which have to be positive are.
    fn check_numbers(&self) -> Result<(), WrongKey> {
        // A number that JSON cannot hold becomes null, and is no number to check.
        check_sizes("", &serde_json::to_value(self).unwrap_or_default())?;
        let (near_rest, modes) = (self.terms.near_rest.iter(), self.modes.iter());
        let positive = std::iter::once(("inertia", self.inertia))
            .chain(near_rest.map(|near| ("near_rest.speed", near.speed_rad_s)))
            .chain(modes.clone().map(|mode| ("modes[].natural_frequency_rad_s", mode.omega_rad_s)));
        for (key, value) in positive {
            if value <= 0.0 {
                return Err(WrongKey::new(key, "greater than zero"));
            }
        }
        // Only tips show a mode without stiffness.
        if modes.clone().any(|mode| mode.stiffness_nm_per_rad < 0.0) {
            return Err(WrongKey::new("modes[].stiffness", "zero or greater"));
        }
        let ripples = self.terms.ripples.iter().map(|wave| ("ripples", wave.per_rad));
        let of_torque = self.torque_ripples.iter().map(|wave| ("torque_ripples", wave.per_rad));
        for (key, wave_number) in ripples.chain(of_torque) {
            if !(wave_number > 0.0 && wave_number <= LARGEST_WAVE_NUMBER) {
                let key = format!("{key}[].wave_number");
                return Err(WrongKey::new(&key, "greater than zero, and 6e6 or less"));
            }
        }
        Ok(())
    }
}

/// A key of an arm that has a wrong value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct WrongKey {
    /// The key, dotted.
    pub(crate) key: String,
    /// What it should be.
    pub(crate) expected: String,
}

impl WrongKey {
    fn new(key: &str, expected: &str) -> Self {
        Self { key: format!("arm.{key}"), expected: expected.to_owned() }
    }
}

fn check_sizes(key: &str, value: &Value) -> Result<(), WrongKey> {
    match value {
        Value::Number(number) if number.as_f64().is_some_and(|value| value.abs() > LARGEST) => {
            Err(WrongKey::new(key, "a number of plausible size"))
        }
        Value::Array(items) => {
            items.iter().try_for_each(|item| check_sizes(&format!("{key}[]"), item))
        }
        Value::Object(table) => table.iter().try_for_each(|(name, item)| {
            let dot = if key.is_empty() { "" } else { "." };
            check_sizes(&format!("{key}{dot}{name}"), item)
        }),
        _ => Ok(()),
    }
}
