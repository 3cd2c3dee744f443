//! The equivalent arm as JSON, in `result.json` and by itself.
//!
//! Its schema is `docs/equivalent.schema.json`.

use lissom::Matrix;
use lissom::beam::RootClass;
use lissom::identify::{Deviations, Equivalent, EquivalentArm, Estimate, ResponseZero, Spurious};
use serde_json::{Map, Value, json};

use super::estimate_json::{figure, finding};
use super::unit_names::UnitNames;
use crate::model::rows;

/// What `lissom equivalent` writes, SI and rad/s throughout.
pub fn equivalent_json(names: UnitNames, found: &Equivalent) -> Value {
    json!({
        "lissom": env!("CARGO_PKG_VERSION"),
        "equivalent": equivalent(names, found),
        "findings": found.findings.iter().map(finding).collect::<Vec<_>>(),
    })
}

/// The arm alone.
pub(super) fn equivalent(names: UnitNames, found: &Equivalent) -> Value {
    let point = |i: usize| found.names[i].as_str();
    let known = found.deviations != Deviations::FromResidual;
    json!({
        "points": found.points.iter().map(|i| point(*i)).collect::<Vec<_>>(),
        "modes": modes(names, found),
        "spurious_poles": spurious(found),
        "beam": {
            "a_per_s2": figures(&found.beam.a, &found.beam.a_std),
            "b_per_s2": column(found.beam.b.as_slice(), found.beam.b_std.as_slice()),
        },
        "torque": found.arm.as_ref().map(|arm| torque(names, known, arm)),
        "strainless": strainless(names, found),
        "state_space": found.arm.as_ref().filter(|_| found.strainless.is_some()).map(|arm| {
            let names_of: Vec<&str> = found.points.iter().map(|i| point(*i)).collect();
            crate::model::state_space(&arm.state_space(&names_of, names.angle()))
        }),
        "zeros": (0..found.zeros.len())
            .map(|i| json!({
                "point": point(i),
                "zeros": found.zeros[i].iter().map(zero).collect::<Vec<_>>(),
            }))
            .collect::<Vec<_>>(),
        "lowest_rad_s": found.fit.range_rad_s.0,
        "highest_rad_s": found.fit.range_rad_s.1,
        "weighted_rms": known.then_some(found.fit.weighted_rms),
        "relative_residual": found.relative_residual,
        "deviations": match found.deviations {
            Deviations::Measured => "measured",
            Deviations::Floored => "floored",
            Deviations::FromResidual => "from_residual",
        },
    })
}

fn modes(names: UnitNames, found: &Equivalent) -> Vec<Value> {
    let coupling = |k: usize| found.arm.as_ref().map(|arm| arm.coupling[k]);
    let mode = |k: usize| {
        let gains = (0..found.points.len()).map(|i| figure(Some(found.kept.static_gain(i, k))));
        json!({
            "natural_frequency_rad_s": figure(Some(found.kept.natural_frequency_rad_s(k))),
            "damping_ratio": figure(Some(found.kept.damping_ratio(k))),
            "static_gains": gains.collect::<Vec<_>>(),
            (names.coupling_key("coupling")): figure(coupling(k)),
        })
    };
    (0..found.modes.len()).map(mode).collect()
}

fn spurious(found: &Equivalent) -> Vec<Value> {
    let each = found.fit.poles.iter().zip(&found.spurious);
    each.filter_map(|(pole, why)| {
        Some(json!({
            "natural_frequency_rad_s": pole.omega_rad_s,
            "damping_ratio": pole.damping_ratio,
            "why": match (*why)? {
                Spurious::Outside => "outside",
                Spurious::Damped => "damped",
                Spurious::Unfelt => "unfelt",
            },
        }))
    })
    .collect()
}

fn torque(names: UnitNames, deviations_known: bool, arm: &EquivalentArm) -> Value {
    let h: Vec<Value> = arm.h.iter().map(|h| figure(Some(*h))).collect();
    json!({
        (names.coupling_key("h")): h,
        (names.coupling_key("h_motor")): figure(Some(arm.h_motor)),
        (names.inertia_key()): figure(Some(arm.inertia)),
        (names.viscous_key("viscous")): figure(Some(arm.viscous)),
        "delay_s": figure(arm.delay_s),
        "weighted_rms": deviations_known.then_some(arm.weighted_rms),
    })
}

fn strainless(names: UnitNames, found: &Equivalent) -> Value {
    let Some(form) = &found.strainless else { return Value::Null };
    let mut map = Map::new();
    map.insert("a_per_s2".to_owned(), json!(rows(&form.a)));
    map.insert("b_per_s2".to_owned(), json!(form.b.as_slice()));
    let known = found.arm.is_some();
    map.insert(names.coupling_key("h"), json!(known.then(|| form.h.as_slice())));
    map.insert(names.coupling_key("h_motor"), json!(known.then_some(form.h_motor)));
    map.insert("missing".to_owned(), json!(form.missing.as_slice()));
    map.insert("given_to_last_mode".to_owned(), json!(form.given_to_last));
    Value::Object(map)
}

fn zero(zero: &ResponseZero) -> Value {
    let s = zero.square.sqrt();
    json!({
        "class": match zero.class {
            RootClass::Imaginary => "a",
            RootClass::Real => "b",
            RootClass::Quadruple => "c",
        },
        "re_rad_s": s.re,
        "im_rad_s": s.im,
        "magnitude_rad_s": figure(Some(zero.omega_rad_s)),
        "outside": zero.outside,
    })
}

fn figures(value: &Matrix, std: &Matrix) -> Vec<Vec<Value>> {
    let one = |i, j| figure(Some(Estimate { value: value[(i, j)], std: std[(i, j)] }));
    (0..value.nrows()).map(|i| (0..value.ncols()).map(|j| one(i, j)).collect()).collect()
}

fn column(value: &[f64], std: &[f64]) -> Vec<Value> {
    let each = value.iter().zip(std);
    each.map(|(&value, &std)| figure(Some(Estimate { value, std }))).collect()
}
