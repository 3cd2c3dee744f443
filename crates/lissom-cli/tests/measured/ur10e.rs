//! UR10E, Mamedov: joints of a robot arm with harmonic drives, a clock of 10 and 12 ms, and gravity on joint 4.

use lissom::identify::findings::rows;
use lissom::identify::{Effort, Estimate, Identified, MissingKind, Options, identify};

use super::common;

/// The campaign of a joint.
pub(crate) fn campaign(joint: usize) -> String {
    let text = include_str!("ur10e.toml").replace("{motor}", &(1 + joint).to_string());
    text.replace("{current}", &(13 + joint).to_string())
}

/// Its log.
pub(crate) fn log(joint: usize) -> String {
    format!("ur-20_01_22-joint_{joint}.csv")
}

fn quick(joint: usize, gravity: bool) -> Option<Identified> {
    let data = common::data("ur10e")?;
    let read = common::read(&campaign(joint), &data, &log(joint)).campaign;
    let read = if gravity { read.with_gravity().unwrap() } else { read };
    let options = Options { effort: Effort::Quick, ..Options::default() };
    Some(identify(&read, &options, |_| ()).unwrap())
}

#[track_caller]
fn within(name: &str, found: Option<Estimate>, published: f64, share: f64) {
    let found = found.unwrap_or_else(|| panic!("{name} is refused")).value;
    assert!((found / published - 1.0).abs() < share, "{name}: {found}, by others {published}");
}

/// By the line with |speed| above 5 % (PROVENANCE.md): friction is concave, and no value is beyond the log's 4.4 A.
#[test]
fn joint_1_has_the_line_that_others_find() {
    let Some(found) = quick(1, false) else { return };
    let line = &found.least_squares.as_ref().unwrap().estimates;
    within("Coulomb", line.friction.coulomb, 1.40, 0.04);
    within("viscous", line.friction.viscous, 2.15, 0.05);
    within("inertia", line.inertia, 0.57, 0.08);
    let law = &found.friction_law.as_ref().unwrap().chosen;
    for (name, value) in [("taken", found.friction.coulomb), ("law", law.coulomb)] {
        let value = value.unwrap().value;
        assert!(value < 4.4, "Coulomb friction {name}: {value} A");
    }
    let clock = found.findings.iter().filter(|f| f.is::<rows::Resampled>()).count();
    assert_eq!(clock, 1);
}

#[test]
fn joint_4_has_gravity() {
    let Some(found) = quick(4, true) else { return };
    let line = found.least_squares.as_ref().unwrap();
    within("Coulomb", line.estimates.friction.coulomb, 0.267, 0.05);
    within("viscous", line.estimates.friction.viscous, 0.327, 0.05);
    within("inertia", line.estimates.inertia, 0.055, 0.15);
    assert!(line.relative_residual < 0.03, "{}", line.relative_residual);
    assert!(found.gravity.unwrap().amplitude().value > 0.3);
}

#[test]
fn joint_4_without_gravity_is_told_to_add_it() {
    let Some(found) = quick(4, false) else { return };
    let gravity = |row: &rows::MissingTerm| row.term.kind == MissingKind::Gravity;
    let codes: Vec<_> = found.findings.iter().map(lissom::identify::Finding::code).collect();
    assert!(found.findings.iter().any(|f| f.get().is_some_and(gravity)), "{codes:?}");
}
