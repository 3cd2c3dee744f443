//! Every set of measured logs: what lissom gives of it and what plain least squares gives, as the table of
//! `docs/src/evidence/measured.md`, and that what is not explained is admitted.

use std::io::Write as _;

use lissom::identify::findings::Severity;
use lissom::identify::{Estimate, Identified, Options, identify};
use lissom::record::Campaign;

use super::{common, ur10e};

/// Part of the torque from which on a result must warn.
const UNEXPLAINED: f64 = 0.15;

/// Two digits of the standard error; a dash for what is refused.
fn shown(estimate: Option<Estimate>) -> String {
    let Some(Estimate { value, std }) = estimate else { return "–".to_owned() };
    let digits = (1.0 - std.log10().floor()).max(0.0) as usize;
    format!("{value:.digits$} ± {std:.digits$}")
}

/// A row of the table, past the capture of tests.
fn row(name: &str, found: &Identified) {
    let line = found.least_squares.as_ref();
    let by_line = line.map(|l| &l.estimates);
    let cells = [
        name.to_owned(),
        found.method.map_or("–", |m| m.name()).replace('_', " "),
        shown(found.friction.coulomb),
        shown(by_line.and_then(|l| l.friction.coulomb)),
        shown(found.friction.viscous),
        shown(by_line.and_then(|l| l.friction.viscous)),
        shown(found.inertia),
        shown(by_line.and_then(|l| l.inertia)),
        percent(found.arm.as_ref().and_then(|a| a.torque_used).map(|t| t.relative_error)),
        percent(line.map(|l| l.relative_residual)),
        found.findings.first().map_or("–".to_owned(), |f| format!("`{}`", f.code())),
    ];
    std::io::stderr().write_all(format!("| {} |\n", cells.join(" | ")).as_bytes()).unwrap();
}

fn percent(share: Option<f64>) -> String {
    share.map_or("–".to_owned(), |share| format!("{:.1} %", 100.0 * share))
}

/// Identifies a set in full, prints its row and looks whether torque that is not explained is admitted.
fn admitted(name: &str, campaign: &Campaign) {
    let found = identify(campaign, &Options::default(), |_| ()).unwrap();
    row(name, &found);
    let unexplained = found.arm.as_ref().and_then(|a| a.torque_used);
    if unexplained.is_none_or(|t| t.relative_error > UNEXPLAINED) {
        let worst = found.findings.iter().map(lissom::identify::Finding::severity).max();
        assert!(worst >= Some(Severity::Warning), "{name}: {:?}", found.findings);
    }
}

#[test]
fn emps() {
    let Some(data) = common::data("emps") else { return };
    for file in ["DATA_EMPS.csv", "DATA_EMPS_PULSES.csv"] {
        admitted(file, &common::read(include_str!("emps.toml"), &data, file).campaign);
    }
}

#[test]
fn joints_of_a_robot() {
    let Some(data) = common::data("ur10e") else { return };
    for joint in [1, 4] {
        let read = common::read(&ur10e::campaign(joint), &data, &ur10e::log(joint)).campaign;
        let read = if joint == 4 { read.with_gravity().unwrap() } else { read };
        admitted(&format!("UR10E joint {joint}"), &read);
    }
}

#[test]
fn teaching_arms() {
    let Some(data) = common::data("cu-flexarm") else { return };
    for (name, text) in [
        ("CU rigid arm", include_str!("cu-rigid.toml")),
        ("CU flexible arms", include_str!("cu.toml")),
    ] {
        admitted(name, &common::read(text, &data, "").campaign);
    }
}

#[test]
fn two_link_arm() {
    let Some(data) = common::data("quanser-2dsfl") else { return };
    admitted("Quanser", &common::read(include_str!("quanser.toml"), &data, "").campaign);
}

/// One campaign of the flexible link with an accelerometer.
fn link_with_an_accelerometer(name: &str, text: &str) {
    let Some(data) = common::data("krauss-slfr") else { return };
    admitted(name, &common::read(text, &data, "").campaign);
}

#[test]
fn three_sweeps_of_a_link_with_an_accelerometer() {
    link_with_an_accelerometer("SLFR, three sweeps", include_str!("krauss-sweeps.toml"));
}

#[test]
fn six_sweeps_of_a_link_with_an_accelerometer() {
    link_with_an_accelerometer("SLFR, six sweeps", include_str!("krauss-all-sweeps.toml"));
}

#[test]
fn sines_of_a_link_with_an_accelerometer() {
    link_with_an_accelerometer("SLFR, fixed sines", include_str!("krauss-fixed.toml"));
}
