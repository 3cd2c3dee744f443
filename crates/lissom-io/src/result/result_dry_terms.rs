//! What an arm's dry friction has beyond Coulomb's, as JSON: written into `arm` and read back.

use std::f64::consts::TAU;

use lissom::drive::Falloff;
use lissom::replay::{Bristles, DryTerms, NearRest, Ripple};
use serde_json::{Map, Value, json};

use super::arm_reader::Reader;
use super::result_error::ResultError;
use super::unit_names::UnitNames;

/// Shortest period of a ripple, in radians or metres: a replay follows each wave.
const SHORTEST: f64 = 1e-6;

/// Puts `near_rest`, `ripples` and `bristles` into the table of an arm.
pub(super) fn write(map: &mut Map<String, Value>, names: UnitNames, terms: &DryTerms) {
    let near = terms.near_rest.map(|n| {
        json!({
            (amplitude(names)): n.torque_nm,
            (speed(names)): n.speed_rad_s,
            "falloff": n.falloff.name(),
        })
    });
    let bristles = terms.bristles.map(|b| {
        json!({
            (stiffness(names)): b.stiffness_nm_per_rad,
            (damping(names)): b.damping_nm_s_per_rad,
        })
    });
    let ripple = |r: &Ripple| {
        json!({
            (period(names)): TAU / r.per_rad,
            (format!("cosine_{}", names.torque())): r.cosine_nm,
            (format!("sine_{}", names.torque())): r.sine_nm,
        })
    };
    map.insert("near_rest".to_owned(), json!(near));
    map.insert("ripples".to_owned(), terms.ripples.iter().map(ripple).collect());
    map.insert("bristles".to_owned(), json!(bristles));
}

/// Reads them.
pub(super) fn read(of: &Reader, table: &Value, names: UnitNames) -> Result<DryTerms, ResultError> {
    let positive = |value: f64, key: String| {
        if value > 0.0 { Ok(value) } else { Err(of.key(key, "greater than zero")) }
    };
    let wide = |value: f64, key: String| {
        if value >= SHORTEST { Ok(value) } else { Err(of.key(key, "1e-6 or more")) }
    };
    let near = &table["near_rest"];
    let near_rest = if near.is_null() {
        None
    } else {
        let at = "arm.near_rest";
        let speed = speed(names);
        let speed_rad_s = positive(of.number(near, at, &speed)?, format!("{at}.{speed}"))?;
        let falloff = [Falloff::Exponential, Falloff::Gaussian];
        let falloff = falloff.into_iter().find(|f| near["falloff"] == f.name());
        let unknown = || of.key(format!("{at}.falloff"), "\"exponential\" or \"gaussian\"");
        Some(NearRest {
            torque_nm: of.number(near, at, &amplitude(names))?,
            speed_rad_s,
            falloff: falloff.ok_or_else(unknown)?,
        })
    };
    let own = &table["bristles"];
    let bristles = if own.is_null() {
        None
    } else {
        let number = |key: String| {
            let at = "arm.bristles";
            positive(of.number(own, at, &key)?, format!("{at}.{key}"))
        };
        Some(Bristles {
            stiffness_nm_per_rad: number(stiffness(names))?,
            damping_nm_s_per_rad: number(damping(names))?,
        })
    };
    let ripple = |r: &Value| {
        let at = "arm.ripples[]";
        let number = |key: &str| of.number(r, at, key);
        let period = period(names);
        Ok(Ripple {
            per_rad: TAU / wide(number(&period)?, format!("{at}.{period}"))?,
            cosine_nm: number(&format!("cosine_{}", names.torque()))?,
            sine_nm: number(&format!("sine_{}", names.torque()))?,
        })
    };
    let ripples = of.list(table, "ripples")?.iter().map(ripple).collect::<Result<_, _>>()?;
    Ok(DryTerms { near_rest, ripples, bristles })
}

fn stiffness(names: UnitNames) -> String {
    names.coupling_key("stiffness")
}

fn damping(names: UnitNames) -> String {
    names.viscous_key("damping")
}

fn amplitude(names: UnitNames) -> String {
    format!("amplitude_{}", names.torque())
}

fn speed(names: UnitNames) -> String {
    format!("speed_{}_per_s", names.angle())
}

fn period(names: UnitNames) -> String {
    format!("period_{}", names.angle())
}
