//! Hub, payload, damping, repeated spans and mass along the beam.
#![expect(clippy::float_cmp, reason = "these numbers are exact")]

use std::f64::consts::PI;
use std::path::Path;

use lissom_core::beam::{Damping, Payload};

use super::arm_fixture::{fails, near, read};
use crate::arm_file::{BeamKind, BeamSpec};

fn beam(keys: &str) -> BeamSpec {
    read(&format!("[beam]\n{keys}\n")).unwrap().beam.unwrap()
}

/// Two spans of a lumped beam and further keys.
fn lumped(keys: &str) -> String {
    format!(
        "[beam]\nflexural_rigidity = 2\nspans = [{{ length = 1, mass = 1 }}, {{ length = 1, mass = 1 }}]\n{keys}\n"
    )
}

#[test]
fn hub_and_payload() {
    let text = lumped(
        "hub_radius = \"20 mm\"\npayload = { mass = \"0.2 kg\", inertia = \"1e-4 kg*m^2\", offset = \"-30 mm\" }",
    );
    let file = read(&text).unwrap();
    let spec = file.beam.as_ref().unwrap();
    assert_eq!(spec.hub_radius_m, 0.02);
    let payload = Payload { mass_kg: 0.2, inertia_kg_m2: 1e-4, offset_m: -0.03 };
    assert_eq!(spec.payload, Some(payload));
    let made = file.lumped_beam(Path::new("arm.toml")).unwrap();
    assert_eq!((made.hub_radius_m(), *made.payload()), (0.02, payload));
}

#[test]
fn the_inertia_of_the_last_span_sits_at_the_tip() {
    let spec = beam(
        "flexural_rigidity = 2\nspans = [{ length = 1, mass = 1, inertia = 0.5 }]\npayload = { mass = 3 }",
    );
    assert_eq!(spec.tip(), Payload { mass_kg: 3.0, inertia_kg_m2: 0.5, offset_m: 0.0 });
    assert_eq!(spec.tip_inertia_kg_m2, Some(0.5));
    fails(
        "[beam]\nflexural_rigidity = 2\nspans = [{ length = 1, mass = 1, inertia = 0.5 }]\n\
         payload = { mass = 3, inertia = 0 }\n",
        "arm.toml, line 4: `beam` has both `payload.inertia` and `spans[].inertia`",
        Some("give one of the two"),
    );
}

#[test]
fn damping_of_the_whole_beam() {
    let damping = |text: &str| {
        beam(&format!(
            "flexural_rigidity = 2\nspans = [{{ length = 1, mass = 1 }}]\ndamping = {text}"
        ))
        .damping
    };
    assert_eq!(
        damping("{ mass_proportional = \"0.1 1/s\", stiffness_proportional = \"0.1 ms\" }"),
        Damping::Proportional { mass_per_s: 0.1, stiffness_s: 1e-4 }
    );
    assert_eq!(
        damping("{ stiffness_proportional = 2 }"),
        Damping::Proportional { mass_per_s: 0.0, stiffness_s: 2.0 }
    );
    assert_eq!(damping("{ ratio = 0.01 }"), Damping::Modal { ratios: vec![0.01] });
    assert_eq!(
        damping("{ ratios = [0.01, \"2 %\"] }"),
        Damping::Modal { ratios: vec![0.01, 0.02] }
    );
    let made = read(&lumped("damping = { ratio = 0.01 }")).unwrap();
    let made = made.lumped_beam(Path::new("arm.toml")).unwrap();
    assert_eq!(made.damping().ratio(7), Some(0.01));
}

#[test]
fn a_span_is_repeated() {
    let spec = beam(
        "flexural_rigidity = 2\nhub_radius = 0.5\n\
         spans = [{ length = 0.5, mass = 1, count = 3, damping = \"6 N*s/rad\" }, { length = 1, mass = 2 }]",
    );
    let masses: Vec<f64> = spec.spans.iter().map(|s| s.mass_kg).collect();
    assert_eq!(masses, [1.0, 1.0, 1.0, 2.0]);
    // ν/L at 1, 1.5 and 2 m.
    let damping: Vec<f64> = spec.spans.iter().map(|s| s.damping_n_s_per_m).collect();
    assert_eq!(damping, [6.0, 4.0, 3.0, 0.0]);
    let long = beam("flexural_rigidity = 2\nspans = [{ length = 1, mass = 1, count = 1_000_000 }]");
    assert_eq!(long.spans.len(), 1_000_000);
}

#[test]
fn mass_along_the_beam() {
    let spec = beam(
        "young_modulus = \"200 GPa\"\nsection = { round = \"10 mm\" }\ndensity = \"7850 kg/m^3\"\n\
         spans = [{ length = 1 }, { length = 1, mass = 3 }, { length = 1, mass_per_length = \"30 g/m\" }, \
         { length = 1, section = { rectangle = [\"4 mm\", \"2 mm\"] } }]",
    );
    assert_eq!(spec.kind(), BeamKind::Distributed);
    let along: Vec<f64> = spec.spans.iter().map(|s| s.mass_per_length_kg_per_m.unwrap()).collect();
    near(along[0], 7850.0 * PI * 1e-4 / 4.0);
    near(along[1], along[0]);
    near(along[2], 0.03);
    near(along[3], 7850.0 * 8e-6);
    assert_eq!(spec.spans.iter().map(|s| s.mass_kg).collect::<Vec<_>>(), [0.0, 3.0, 0.0, 0.0]);
    let rigid = beam(
        "flexural_rigidity = 2\nmass_per_length = 0.1\nspans = [{ length = 1 }, { length = 1, flexural_rigidity = 3 }]",
    );
    assert_eq!(rigid.kind(), BeamKind::Distributed);
    assert_eq!(
        beam("flexural_rigidity = 2\nspans = [{ length = 1, mass = 1 }]").kind(),
        BeamKind::Lumped
    );
}

#[test]
fn a_rig_needs_point_masses() {
    let text = "[beam]\nflexural_rigidity = 2\nmass_per_length = 0.1\nspans = [{ length = 1 }]\n\
                [drive]\ninertia = 1\ntorque_constant = 1\n";
    let file = read(text).unwrap();
    let error = file.arm(Path::new("arm.toml")).unwrap_err();
    assert_eq!(
        error.to_string(),
        "arm.toml: the beam has mass along its length; here it must have point masses"
    );
    assert_eq!(
        error.hint().unwrap(),
        "give each span a `mass` instead of `density` or `mass_per_length`; with more spans \
         the point masses come closer to a beam with mass along it"
    );
}

#[test]
fn a_heavy_beam_is_built() {
    let path = Path::new("arm.toml");
    let text = "[beam]\nflexural_rigidity = 2\nmass_per_length = 0.1\nhub_radius = 0.1\n\
                spans = [{ length = 1, mass = 0.3 }, { length = 0.5 }]\npayload = { mass = 2 }\n";
    let file = read(text).unwrap();
    let beam = file.distributed_beam(path).unwrap();
    assert_eq!(beam.pieces().len(), 2);
    assert_eq!((beam.length_m(), beam.payload().mass_kg), (1.6, 2.0));
    assert_eq!(file.beam.as_ref().map(BeamSpec::kind), Some(BeamKind::Distributed));
    let ratio = read(&format!("{text}damping = {{ ratio = 0.01 }}\n")).unwrap();
    let error = ratio.distributed_beam(path).unwrap_err();
    assert_eq!(
        error.to_string(),
        "arm.toml: a distributed beam takes proportional damping, not a ratio for each mode"
    );
    assert!(error.hint().unwrap().starts_with("write damping = { mass_proportional"));
    let points = read(&lumped("")).unwrap().distributed_beam(path).unwrap_err();
    assert!(points.problem.contains("the beam has point masses"), "{points}");
}

#[test]
fn wrong_hubs_and_payloads_are_named() {
    let sign = Some("check its sign");
    for (keys, message, hint) in [
        (
            "hub_radius = \"-20 mm\"",
            "arm.toml, line 4: `beam.hub_radius` is \"-20 mm\", but must be zero or greater",
            sign,
        ),
        (
            "payload = { mass = -1 }",
            "arm.toml, line 4: `beam.payload.mass` is -1, but must be zero or greater",
            sign,
        ),
        (
            "payload = { mass = 1, inertia = -1 }",
            "arm.toml, line 4: `beam.payload.inertia` is -1, but must be zero or greater",
            sign,
        ),
        (
            "payload = { offset = \"30 mm\" }",
            "arm.toml, line 4: `beam.payload` has none of `mass`, `inertia`",
            Some("add one of them"),
        ),
        (
            "payload = { mass = 1, ofset = 2 }",
            "arm.toml, line 4: `beam.payload.ofset` is not a known key",
            Some("did you mean `offset`?"),
        ),
        (
            "payload = 0.2",
            "arm.toml, line 4: `beam.payload` is 0.2, where a table is expected",
            Some("write it as in { mass = \"0.2 kg\", inertia = \"1e-4 kg*m^2\" }"),
        ),
    ] {
        fails(&lumped(keys), message, hint);
    }
}

#[test]
fn wrong_damping_is_named() {
    for (damping, message, hint) in [
        (
            "{ ratio = -0.01 }",
            "arm.toml, line 4: `beam.damping.ratio` is -0.01, but must be zero or greater",
            "check its sign",
        ),
        (
            "{ ratios = [] }",
            "arm.toml, line 4: `beam.damping.ratios` is a list, where a list of damping ratios is expected",
            "write them as in [0.01, 0.02]",
        ),
        (
            "{ ratios = [0.1, -0.1] }",
            "arm.toml, line 4: `beam.damping.ratios[2]` is -0.1, but must be zero or greater",
            "check its sign",
        ),
        (
            "{ ratio = 0.01, mass_proportional = 1 }",
            "arm.toml, line 4: `beam.damping` has both `mass_proportional` and `ratio`",
            "give one of the two",
        ),
        (
            "{}",
            "arm.toml, line 4: `beam.damping` has none of `mass_proportional`, `stiffness_proportional`, `ratio`, `ratios`",
            "add one of them",
        ),
        (
            "{ mass_proportional = \"0.1 s\" }",
            "arm.toml, line 4: `beam.damping.mass_proportional`: \"0.1 s\" is a time [s], where an angular rate or frequency [s^-1] is expected",
            "write it as in \"5 Hz\"",
        ),
        (
            "\"0.2 N*s/m\"",
            "arm.toml, line 4: `beam.damping` is \"0.2 N*s/m\", where a table is expected",
            "write it as in { ratio = 0.01 }",
        ),
    ] {
        fails(&lumped(&format!("damping = {damping}")), message, Some(hint));
    }
}

#[test]
fn wrong_counts_are_named() {
    let limits = Some("give a whole number within these limits");
    let spans = |spans: &str| format!("[beam]\nflexural_rigidity = 2\nspans = [{spans}]\n");
    for count in ["0", "-3", "1.5", "1_000_001", "\"many\""] {
        fails(
            &spans(&format!("{{ length = 1, mass = 1, count = {count} }}")),
            &format!(
                "arm.toml, line 3: `beam.spans[1].count` is {}, but must be a whole number from 1 to 1000000",
                count.replace('_', "")
            ),
            limits,
        );
    }
    let million = "{ length = 1, mass = 1, count = 1_000_000 }";
    fails(
        &spans(&[million; 3].join(", ")),
        "arm.toml, line 3: `beam.spans` has 3000000 entries with repetitions, but at most 2000000 are allowed",
        Some("use a smaller `count`"),
    );
}

#[test]
fn mass_is_either_at_points_or_along_the_beam() {
    fails(
        "[beam]\nflexural_rigidity = 2\nspans = [{ length = 1, mass = 1 }, { length = 1 }]\n",
        "arm.toml, line 3: `beam.spans[2]` has no `mass`",
        Some(
            "add `mass` to beam.spans[2], or give the beam mass along its length: \
             `mass_per_length`, or `density` with `section`",
        ),
    );
    fails(
        "[beam]\nflexural_rigidity = 2\nspans = [{ length = 1, mass_per_length = 1 },\n{ length = 1, mass = 1 }]\n",
        "arm.toml, line 4: `beam.spans[2]` has no mass along its length, but `beam.spans[1]` has",
        Some(
            "give all spans a mass along their length (`mass_per_length`, or `density` with \
             `section`), or none of them",
        ),
    );
    fails(
        "[beam]\nflexural_rigidity = 2\ndensity = 7850\nspans = [{ length = 1 }]\n",
        "arm.toml, line 3: `beam.density` needs `section`",
        Some(
            "give `section` and `young_modulus`, from which the area follows, or write \
             `mass_per_length` instead of `density`",
        ),
    );
    fails(
        "[beam]\nflexural_rigidity = 2\ndensity = 7850\nmass_per_length = 1\nspans = [{ length = 1 }]\n",
        "arm.toml, line 1: `beam` has both `density` and `mass_per_length`",
        Some("give one of the two"),
    );
    fails(
        "[beam]\nflexural_rigidity = 2\nmass_per_length = 0\nspans = [{ length = 1 }]\n",
        "arm.toml, line 3: `beam.mass_per_length` is 0, but must be greater than zero",
        Some("check the number and its unit"),
    );
    fails(
        "[beam]\nflexural_rigidity = 2\nspans = [{ length = 1, mass_per_length = \"7850 kg/m^3\" }]\n",
        "arm.toml, line 3: `beam.spans[1].mass_per_length`: \"7850 kg/m^3\" is a density [kg*m^-3], where a mass per length [kg*m^-1] is expected",
        Some("write it as in \"0.03 kg/m\""),
    );
    // A span of another stiffness has another section, which is unknown.
    fails(
        "[beam]\nyoung_modulus = 2\nsection = { round = 1 }\ndensity = 7850\n\
         spans = [{ length = 1 }, { length = 1, flexural_rigidity = 3 }]\n",
        "arm.toml, line 4: `beam.density` needs `section`",
        Some(
            "give `section` and `young_modulus`, from which the area follows, or write \
             `mass_per_length` instead of `density`",
        ),
    );
}
