use std::f64::consts::{PI, TAU};

use proptest::prelude::*;

use super::{Dimension, UnitError, parse_any_unit, parse_quantity, parse_unit};

/// Relative: a few roundings of products of exact constants.
const ROUNDING: f64 = 1e-14;

fn near(found: f64, expected: f64) {
    assert!((found / expected - 1.0).abs() < ROUNDING, "{found} is not {expected}");
}

#[test]
fn reads_the_units_of_the_field() {
    let inch = 0.0254;
    let lbf = 4.448_221_615_260_5;
    for (text, dimension, expected) in [
        ("30e6 psi", Dimension::PRESSURE, 30e6 * lbf / (inch * inch)),
        ("0.00443 N*m^2", Dimension::FLEXURAL_RIGIDITY, 0.00443),
        ("0.00443 N·m²", Dimension::FLEXURAL_RIGIDITY, 0.00443),
        ("0.005529 lbf*in*s^2", Dimension::INERTIA, 0.005_529 * lbf * inch),
        ("0.01216 lbf*in*s/rad", Dimension::VISCOUS_ROTARY, 0.01216 * lbf * inch),
        ("2.184 lbf*in/A", Dimension::TORQUE_PER_CURRENT, 2.184 * lbf * inch),
        ("7 in", Dimension::LENGTH, 0.1778),
        ("7in", Dimension::LENGTH, 0.1778),
        ("0.121 lb", Dimension::MASS, 0.121 * 0.453_592_37),
        ("360 deg", Dimension::NUMBER, TAU),
        ("-0.5 turn", Dimension::NUMBER, -PI),
        ("3 ms", Dimension::TIME, 3e-3),
        ("0.0107 V*s/rad", Dimension::TORQUE_PER_CURRENT, 0.0107),
        ("60 rpm", Dimension::RATE, TAU),
        ("5 Hz", Dimension::RATE, 10.0 * PI),
        ("2 kg*m^2", Dimension::INERTIA, 2.0),
        ("7.7 g", Dimension::MASS, 7.7e-3),
        ("25.4 mm", Dimension::LENGTH, inch),
        ("16 oz", Dimension::MASS, 0.453_592_37),
        ("16 ozf*in", Dimension::TORQUE, lbf * inch),
        ("1 mN*m", Dimension::TORQUE, 1e-3),
        ("200 GPa", Dimension::PRESSURE, 200e9),
        ("3.29 ohm", Dimension::RESISTANCE, 3.29),
        ("3.29 Ω", Dimension::RESISTANCE, 3.29),
        ("120 mA", Dimension::CURRENT, 0.12),
        ("1.5 µm", Dimension::LENGTH, 1.5e-6),
        ("2 gn", Dimension::ACCELERATION, 19.6133),
        ("1 kg*m/(s^2*A)", Dimension::FORCE_PER_CURRENT, 1.0),
        ("4 1/s^2", Dimension::ANGULAR_ACCELERATION, 4.0),
        ("2 s^-1", Dimension::RATE, 2.0),
        ("0.25", Dimension::NUMBER, 0.25),
        ("1.5e-3 m", Dimension::LENGTH, 1.5e-3),
        ("7850 kg/m^3", Dimension::DENSITY, 7850.0),
        ("0.284 lb/in^3", Dimension::DENSITY, 0.284 * 0.453_592_37 / (inch * inch * inch)),
        ("30 g/m", Dimension::LINEAR_DENSITY, 0.03),
        ("0.1 1/s", Dimension::RATE, 0.1),
        ("1 slug", Dimension::MASS, 14.593_902_937_206_4),
    ] {
        near(parse_quantity(text, dimension).unwrap(), expected);
    }
}

#[test]
fn a_unit_alone_gives_its_size() {
    near(parse_unit("deg", Dimension::NUMBER).unwrap(), PI / 180.0);
    near(parse_unit(" 1 ", Dimension::NUMBER).unwrap(), 1.0);
    assert_eq!(parse_any_unit("mm").unwrap(), (1e-3, Dimension::LENGTH));
}

#[track_caller]
fn fails(text: &str, expected: Dimension, message: &str, hint: Option<&str>) {
    let error = parse_quantity(text, expected).unwrap_err();
    assert_eq!(error.to_string(), message);
    assert_eq!(error.hint().as_deref(), hint);
}

#[test]
fn errors_say_what_was_found_and_wanted() {
    fails(
        "long",
        Dimension::LENGTH,
        "\"long\" does not begin with a number",
        Some("write a number and a unit, such as \"7 in\""),
    );
    fails(
        "7",
        Dimension::LENGTH,
        "\"7\" has no unit; a length [m] is expected",
        Some("write it as in \"7 in\"; in a file, a number without quotes is SI"),
    );
    fails(
        "7 furlong",
        Dimension::LENGTH,
        "\"7 furlong\": there is no unit `furlong`",
        Some(
            "write units as in \"mA\", \"deg\" or \"lbf*in/A\", with * for products and / for quotients",
        ),
    );
    fails(
        "70 Gpa",
        Dimension::PRESSURE,
        "\"70 Gpa\": there is no unit `Gpa`",
        Some("did you mean `GPa`?"),
    );
    for (wanted, meant) in [("NM", "Nm"), ("MM", "mm"), ("KG", "kg"), ("HZ", "Hz"), ("GPA", "GPa")]
    {
        let error = parse_quantity(&format!("7 {wanted}"), Dimension::NUMBER).unwrap_err();
        assert_eq!(error.hint().unwrap(), format!("did you mean `{meant}`?"));
    }
    fails(
        "7 ma",
        Dimension::CURRENT,
        "\"7 ma\": there is no unit `ma`",
        Some("did you mean `mA`?"),
    );
    fails(
        "7 lbs",
        Dimension::MASS,
        "\"7 lbs\": there is no unit `lbs`",
        Some("did you mean `lb`?"),
    );
    fails(
        "7 N-m",
        Dimension::TORQUE,
        "\"7 N-m\" is not a unit: unexpected `-`",
        Some("write * for products and / for quotients, as in \"N*m^2\""),
    );
    fails(
        "0,2 N*m/A",
        Dimension::TORQUE,
        "\"0,2 N*m/A\" is not a unit: unexpected `,`",
        Some("write numbers with a point, as in \"0.2 N*m/A\""),
    );
    fails(
        "7 N*",
        Dimension::TORQUE,
        "\"7 N*\" is not a unit: it ends too early",
        Some("write * for products and / for quotients, as in \"N*m^2\""),
    );
    fails(
        "7 m^12",
        Dimension::LENGTH,
        "\"7 m^12\" has an exponent above 9",
        Some("check the exponent of the unit"),
    );
    fails(
        "0.12 lb",
        Dimension::LENGTH,
        "\"0.12 lb\" is a mass [kg], where a length [m] is expected",
        Some("write it as in \"7 in\""),
    );
    fails(
        "0.12 lb*in",
        Dimension::TORQUE,
        "\"0.12 lb*in\" is a quantity in [kg*m], where a torque [kg*m^2*s^-2] is expected",
        Some("`lb`, `oz` and `kg` are masses; the forces are `lbf`, `ozf` and `kgf`"),
    );
    fails(
        "0.12 lbf",
        Dimension::MASS,
        "\"0.12 lbf\" is a force [kg*m*s^-2], where a mass [kg] is expected",
        Some("`lbf`, `ozf` and `kgf` are forces; the masses are `lb`, `oz` and `kg`"),
    );
    fails(
        "1e999 m",
        Dimension::LENGTH,
        "\"1e999 m\" is out of range",
        Some("check the exponent of the number and its unit"),
    );
}

#[test]
fn nesting_is_bounded() {
    let deep = format!("1 {}m", "(".repeat(100_000));
    let error = parse_quantity(&deep, Dimension::LENGTH).unwrap_err();
    assert!(matches!(error, UnitError::Syntax { found: Some('('), .. }));
}

proptest! {
    #[test]
    fn no_text_panics(text in "\\PC{0,40}") {
        let _ = parse_quantity(&text, Dimension::TORQUE);
        let _ = parse_any_unit(&text);
    }

    #[test]
    fn no_almost_right_text_panics(text in "[-+0-9.e]{0,6} ?[a-zA-Zµ°Ω*·/^²³() 0-9-]{0,24}") {
        let _ = parse_quantity(&text, Dimension::TORQUE);
        let _ = parse_any_unit(&text);
    }

    #[test]
    fn a_number_survives(number in -1e12..1e12f64) {
        let found = parse_quantity(&format!("{number} N*m/A"), Dimension::TORQUE_PER_CURRENT);
        prop_assert_eq!(found.unwrap().to_bits(), number.to_bits());
    }
}
