//! The table of units.

use std::f64::consts::{PI, TAU};

use super::dimension::Dimension;

/// Standard gravity, exact \[m/s²\].
const GRAVITY_M_S2: f64 = 9.806_65;
/// Pound-force, exact \[N\].
const LBF_N: f64 = 4.448_221_615_260_5;
/// Pound, exact \[kg\].
const LB_KG: f64 = 0.453_592_37;
/// Inch, exact \[m\].
const INCH_M: f64 = 0.0254;

/// Size in SI and dimension of a unit.
#[derive(Debug, Clone, Copy)]
pub(super) struct Unit {
    pub(super) factor: f64,
    pub(super) dimension: Dimension,
}

/// Units without prefixes: name, size in SI, dimension.
const PLAIN: &[(&str, f64, Dimension)] = &[
    ("1", 1.0, Dimension::NUMBER),
    ("%", 0.01, Dimension::NUMBER),
    ("deg", PI / 180.0, Dimension::NUMBER),
    ("°", PI / 180.0, Dimension::NUMBER),
    ("mdeg", PI / 180e3, Dimension::NUMBER),
    ("arcmin", PI / 10_800.0, Dimension::NUMBER),
    ("arcsec", PI / 648_000.0, Dimension::NUMBER),
    ("gon", PI / 200.0, Dimension::NUMBER),
    ("rev", TAU, Dimension::NUMBER),
    ("turn", TAU, Dimension::NUMBER),
    ("rpm", TAU / 60.0, Dimension::RATE),
    ("min", 60.0, Dimension::TIME),
    ("h", 3600.0, Dimension::TIME),
    ("in", INCH_M, Dimension::LENGTH),
    ("ft", 12.0 * INCH_M, Dimension::LENGTH),
    ("lb", LB_KG, Dimension::MASS),
    ("oz", LB_KG / 16.0, Dimension::MASS),
    ("slug", LBF_N / (12.0 * INCH_M), Dimension::MASS),
    ("lbf", LBF_N, Dimension::FORCE),
    ("ozf", LBF_N / 16.0, Dimension::FORCE),
    ("kgf", GRAVITY_M_S2, Dimension::FORCE),
    ("gn", GRAVITY_M_S2, Dimension::ACCELERATION),
    ("psi", LBF_N / (INCH_M * INCH_M), Dimension::PRESSURE),
    ("ksi", 1e3 * LBF_N / (INCH_M * INCH_M), Dimension::PRESSURE),
    ("bar", 1e5, Dimension::PRESSURE),
];

/// Units that take prefixes.
const PREFIXED: &[(&str, f64, Dimension)] = &[
    ("m", 1.0, Dimension::LENGTH),
    ("g", 1e-3, Dimension::MASS),
    ("s", 1.0, Dimension::TIME),
    ("A", 1.0, Dimension::CURRENT),
    ("rad", 1.0, Dimension::NUMBER),
    ("Hz", TAU, Dimension::RATE),
    ("N", 1.0, Dimension::FORCE),
    ("Pa", 1.0, Dimension::PRESSURE),
    ("J", 1.0, Dimension::TORQUE),
    ("Nm", 1.0, Dimension::TORQUE),
    ("W", 1.0, Dimension::new(1, 2, -3, 0)),
    ("V", 1.0, Dimension::VOLTAGE),
    ("ohm", 1.0, Dimension::RESISTANCE),
    ("Ohm", 1.0, Dimension::RESISTANCE),
    ("Ω", 1.0, Dimension::RESISTANCE),
    ("Ω", 1.0, Dimension::RESISTANCE),
];

/// SI prefixes.
const PREFIXES: &[(&str, f64)] = &[
    ("p", 1e-12),
    ("n", 1e-9),
    ("u", 1e-6),
    ("µ", 1e-6),
    ("μ", 1e-6),
    ("m", 1e-3),
    ("c", 1e-2),
    ("d", 1e-1),
    ("k", 1e3),
    ("M", 1e6),
    ("G", 1e9),
];

/// Finds the unit of this name.
pub(super) fn find(name: &str) -> Option<Unit> {
    let in_list = |list: &[(&str, f64, Dimension)], wanted: &str| {
        list.iter()
            .find(|(unit, ..)| *unit == wanted)
            .map(|&(_, factor, dimension)| Unit { factor, dimension })
    };
    in_list(PLAIN, name).or_else(|| in_list(PREFIXED, name)).or_else(|| {
        PREFIXES.iter().find_map(|(prefix, size)| {
            let unit = in_list(PREFIXED, name.strip_prefix(prefix)?)?;
            Some(Unit { factor: unit.factor * size, ..unit })
        })
    })
}

/// Names of all units, without prefixes.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    PLAIN.iter().chain(PREFIXED).map(|(name, ..)| *name)
}

/// The unit with its prefix that equals `wanted` except for upper and lower case: `mA` for "ma". If there are several,
/// the one with the fewest changed letters; the prefix `M` counts as two changes more, because it may be confused with
/// `m`.
pub(super) fn of_other_case(wanted: &str) -> Option<String> {
    let prefixed = PREFIXED.iter().flat_map(|(name, ..)| {
        PREFIXES.iter().map(move |(prefix, _)| (*prefix, format!("{prefix}{name}")))
    });
    let cost = |(prefix, name): &(&str, String)| {
        let changed = name.chars().zip(wanted.chars()).filter(|(a, b)| a != b).count();
        changed + if *prefix == "M" { 2 } else { 0 }
    };
    names()
        .map(|name| ("", name.to_owned()))
        .chain(prefixed)
        .filter(|(_, name)| name.eq_ignore_ascii_case(wanted))
        .min_by_key(cost)
        .map(|(_, name)| name)
}
