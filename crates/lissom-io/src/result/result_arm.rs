//! The arm of a result: written into `result.json` and read back from it.

use std::path::Path;

use lissom::identify::{ArmSource, FoundArm, TorqueUsed};
use lissom::record::Channels;
use lissom::replay::{ModalArm, Oscillator, Parameter};
use serde_json::{Map, Value, json};

use super::arm_reader::Reader;
use super::estimate_json::{axis, quantity};
use super::result_dry_terms;
use super::result_error::ResultError;
use super::unit_names::UnitNames;
use crate::io_error::Error;
use crate::read_text::read_text;

/// Relative difference of torque constants beyond which they are two: six digits may be written of one.
const SAME: f64 = 1e-5;

/// Names of the methods an arm can be from.
const SOURCES: [(&str, ArmSource); 2] =
    [("output_error", ArmSource::OutputError), ("regression", ArmSource::Regression)];

/// The table `arm` of `result.json`.
pub(super) fn arm(channels: &Channels, names: UnitNames, found: &FoundArm) -> Value {
    let a = &found.arm;
    let source = SOURCES.iter().find(|s| s.1 == found.source).map(|s| s.0);
    let modes: Vec<Value> = a
        .modes
        .iter()
        .map(|m| {
            json!({
                "natural_frequency_rad_s": m.omega_rad_s,
                (names.coupling_key("stiffness")): m.stiffness_nm_per_rad,
                "damping_within_per_s": m.within_per_s,
                "damping_grounded_per_s": m.grounded_per_s,
            })
        })
        .collect();
    let tips: Vec<Value> = channels
        .tips
        .iter()
        .zip(&a.shapes)
        .enumerate()
        .map(|(i, (tip, shape))| {
            json!({
                "name": tip.name,
                "quantity": quantity(tip.quantity),
                "shape": shape,
                "lag_s": Parameter::TipLag(i).of(a),
            })
        })
        .collect();
    let mut map = Map::new();
    map.insert("from".to_owned(), json!(source));
    map.insert(names.inertia_key(), json!(a.inertia_kg_m2));
    map.insert(names.viscous_key("viscous_forward"), json!(a.viscous_nm_s_per_rad[0]));
    map.insert(names.viscous_key("viscous_backward"), json!(a.viscous_nm_s_per_rad[1]));
    map.insert(format!("coulomb_{}", names.torque()), json!(a.coulomb_nm));
    map.insert(format!("offset_{}", names.torque()), json!(a.offset_nm));
    result_dry_terms::write(&mut map, names, &a.dry_terms);
    map.insert("command_lag_s".to_owned(), json!(a.command_lag_s));
    map.insert("modes".to_owned(), Value::Array(modes));
    map.insert("tips".to_owned(), Value::Array(tips));
    map.insert("damping_at_points_per_s".to_owned(), json!(a.at_points_per_s));
    let used = found.torque_used;
    map.insert("torque_error".to_owned(), json!(used.map(|t| t.relative_error)));
    map.insert("torque_window_s".to_owned(), json!(used.map(|t| t.window_s)));
    Value::Object(map)
}

/// Reads the arm of a result, to predict logs of these channels.
///
/// # Errors
/// [`Error::Result`] where the file is no result, has no arm, or belongs to another drive.
pub fn read_arm(path: &Path, channels: &Channels) -> Result<FoundArm, Error> {
    let file = path.display().to_string();
    let text =
        read_text(path).map_err(|source| ResultError::Read { file: file.clone(), source })?;
    let root: Value = serde_json::from_str(text.trim_start_matches('\u{feff}'))
        .map_err(|source| ResultError::Json { file: file.clone(), source })?;
    Ok(Reader { file, root }.arm(channels)?)
}

fn torque_used(table: &Value) -> Option<TorqueUsed> {
    let relative_error = table["torque_error"].as_f64()?;
    let window_s = table["torque_window_s"].as_f64().filter(|w| *w > 0.0)?;
    Some(TorqueUsed { relative_error, window_s })
}

impl Reader {
    fn arm(&self, channels: &Channels) -> Result<FoundArm, ResultError> {
        for key in ["lissom", "axis", "torque_per_command", "arm"] {
            if self.root.get(key).is_none() {
                return Err(ResultError::NoResult { file: self.file.clone(), key });
            }
        }
        self.same_drive(channels)?;
        let table = &self.root["arm"];
        if table.is_null() {
            return Err(ResultError::NoArm { file: self.file.clone() });
        }
        let names = UnitNames::new(channels);
        let number = |key: &str| self.number(table, "arm", key);
        let modes = self.list(table, "modes")?;
        let modes = modes.iter().map(|m| self.mode(m, names)).collect::<Result<Vec<_>, _>>()?;
        let source = SOURCES.iter().find(|s| table["from"] == s.0).map(|s| s.1);
        let inertia_key = names.inertia_key();
        let inertia_kg_m2 = number(&inertia_key)?;
        if inertia_kg_m2 <= 0.0 {
            return Err(self.key(format!("arm.{inertia_key}"), "greater than zero"));
        }
        let arm = ModalArm {
            inertia_kg_m2,
            viscous_nm_s_per_rad: [
                number(&names.viscous_key("viscous_forward"))?,
                number(&names.viscous_key("viscous_backward"))?,
            ],
            coulomb_nm: number(&format!("coulomb_{}", names.torque()))?,
            offset_nm: number(&format!("offset_{}", names.torque()))?,
            dry_terms: result_dry_terms::read(self, table, names)?,
            shapes: self.shapes(table, channels, modes.len())?,
            at_points_per_s: self
                .numbers(&table["damping_at_points_per_s"], "damping_at_points_per_s")?,
            command_lag_s: number("command_lag_s")?,
            tip_lags_s: self.tip_lags(table)?,
            modes,
        };
        let points = arm.at_points_per_s.len();
        if points != 0 && points != arm.modes.len() {
            return Err(self.key("arm.damping_at_points_per_s".to_owned(), "one for each mode"));
        }
        Ok(FoundArm {
            arm,
            source: source.ok_or_else(|| self.key("arm.from".to_owned(), "a method"))?,
            torque_used: torque_used(table),
        })
    }

    /// A result of another axis, command or torque constant is in other units.
    fn same_drive(&self, channels: &Channels) -> Result<(), ResultError> {
        let axis = axis(channels.axis);
        let constant = channels.command.torque_per_command;
        let said = |constant: Option<f64>| match constant {
            Some(k) => format!("with a torque constant of {k} in SI units"),
            None => "without a torque constant".to_owned(),
        };
        let own_axis = self.root["axis"].as_str().unwrap_or_default();
        let own = self.root["torque_per_command"].as_f64();
        let same = match (own, constant) {
            (Some(a), Some(b)) => (a - b).abs() <= SAME * b.abs(),
            (None, None) => true,
            _ => false,
        };
        if own_axis == axis && same {
            return Ok(());
        }
        Err(ResultError::OtherDrive {
            file: self.file.clone(),
            of_result: format!("a {own_axis} axis {}", said(own)),
            of_log: format!("of a {axis} one {}", said(constant)),
        })
    }

    fn mode(&self, mode: &Value, names: UnitNames) -> Result<Oscillator, ResultError> {
        let number = |key: &str| self.number(mode, "arm.modes[]", key);
        let omega_rad_s = number("natural_frequency_rad_s")?;
        if omega_rad_s <= 0.0 {
            let key = "arm.modes[].natural_frequency_rad_s".to_owned();
            return Err(self.key(key, "greater than zero"));
        }
        let stiffness = names.coupling_key("stiffness");
        let stiffness_nm_per_rad = number(&stiffness)?;
        if stiffness_nm_per_rad <= 0.0 {
            return Err(self.key(format!("arm.modes[].{stiffness}"), "greater than zero"));
        }
        Ok(Oscillator {
            omega_rad_s,
            stiffness_nm_per_rad,
            within_per_s: number("damping_within_per_s")?,
            grounded_per_s: number("damping_grounded_per_s")?,
        })
    }

    /// Empty where all tips are in time.
    fn tip_lags(&self, table: &Value) -> Result<Vec<f64>, ResultError> {
        let of = |tip| self.number(tip, "arm.tips[]", "lag_s");
        let lags = self.list(table, "tips")?.iter().map(of).collect::<Result<Vec<_>, _>>()?;
        Ok(if lags.iter().all(|lag| *lag == 0.0) { Vec::new() } else { lags })
    }

    fn shapes(
        &self,
        table: &Value,
        channels: &Channels,
        modes: usize,
    ) -> Result<Vec<Vec<f64>>, ResultError> {
        let tips = self.list(table, "tips")?;
        let quantities: Vec<&str> =
            tips.iter().map(|t| t["quantity"].as_str().unwrap_or("?")).collect();
        let of = |t: &lissom::record::Tip| quantity(t.quantity);
        let log: Vec<&str> = channels.tips.iter().map(of).collect();
        if quantities != log {
            let told = |list: &[&str]| match list {
                [] => "none".to_owned(),
                list => list.join(", "),
            };
            return Err(ResultError::OtherTips {
                file: self.file.clone(),
                of_result: told(&quantities),
                of_log: told(&log),
            });
        }
        let shape = |t: &Value| {
            let shape = self.numbers(&t["shape"], "tips[].shape")?;
            let fits = shape.len() == modes;
            fits.then_some(shape)
                .ok_or_else(|| self.key("arm.tips[].shape".to_owned(), "one number for each mode"))
        };
        tips.iter().map(shape).collect()
    }
}
