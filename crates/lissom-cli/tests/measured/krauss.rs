//! SLFR, Krauss: a drive command in unknown units, an encoder, an accelerometer.

use std::f64::consts::TAU;

use lissom::identify::{Options, RunKind, identify};
use num_complex::Complex64;
use serde_json::Value;

use super::common;

/// Encoder counts a turn: the author's responses are in counts.
const COUNTS: f64 = 1024.0;

fn sweeps(data: &std::path::Path) -> Value {
    common::identify(include_str!("krauss-sweeps.toml"), data, "", 0)
}

#[test]
fn modes_and_notches_at_once() {
    let Some(data) = common::data("krauss-slfr") else { return };
    let result = sweeps(&data);
    let hertz: Vec<f64> = result["beam"]["modes"]
        .as_array()
        .unwrap()
        .iter()
        .map(|m| m["natural_frequency_rad_s"]["value"].as_f64().unwrap() / TAU)
        .collect();
    assert_eq!(hertz.len(), 2, "{hertz:?}");
    // Author's fit 2.5 and 17.5 Hz; free decays 2.51-2.53 and 17.95-18.06 Hz.
    assert!((hertz[0] - 2.5).abs() < 0.05, "{hertz:?}");
    assert!((17.5..=18.1).contains(&hertz[1]), "{hertz:?}");
    // What the accelerometer shows as resonances are notches of the motor's response.
    let motor = &result["models"]["motor"];
    let number = |v: &Value| v.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
    let (num, den): (Vec<f64>, Vec<f64>) = (number(&motor["num"]), number(&motor["den"]));
    let motor = lissom::lti::TransferFunction { num, den };
    let level = |hertz: f64| motor.response(TAU * hertz).norm();
    assert!(level(hertz[0]) < 0.2 * level(1.3 * hertz[0]), "no notch at {} Hz", hertz[0]);
    assert!(level(hertz[1]) < 0.8 * level(0.9 * hertz[1]), "no notch at {} Hz", hertz[1]);
    // The replay has an inertia of 0.357 and a lag of 2.8 ms.
    let inertia = result["drive"]["inertia"]["value"].as_f64().unwrap();
    assert!((inertia / 0.357 - 1.0).abs() < 0.05, "{inertia}");
    let lag_s = &result["models"]["motor_delay_s"];
    let (value, std) = (lag_s["value"].as_f64().unwrap(), lag_s["std"].as_f64().unwrap());
    assert!((0.002..0.005).contains(&value) && value > 5.0 * std, "{value} ± {std}");
}

/// Simulation and log agree only over windows shorter than a period of the first mode, which do not determine its frequency.
#[test]
fn sweeps_of_two_amplitudes_give_the_same_modes() {
    let Some(data) = common::data("krauss-slfr") else { return };
    let three = include_str!("krauss-sweeps.toml");
    let further = three.split_once("[[runs]]").unwrap().1;
    let further = further.replace("amp=50_stopn=10000", "amp=25_stopn=20000");
    let further = further.replace("\"sweep ", "\"small sweep ");
    let result = common::identify(&format!("{three}\n[[runs]]{further}"), &data, "", 0);
    let first = &result["beam"]["modes"][0]["natural_frequency_rad_s"]["value"];
    let hertz = first.as_f64().unwrap() / TAU;
    assert!((hertz - 2.5).abs() < 0.05, "{hertz} Hz");
}

#[test]
fn response_of_the_drive_is_the_authors() {
    let Some(data) = common::data("krauss-slfr") else { return };
    let result = sweeps(&data);
    let response = &result["frequency_response"];
    let list = |v: &Value| -> Vec<f64> {
        v.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
    };
    let omega = list(&response["omega_rad_s"]);
    let (re, im) = (list(&response["motor_raw"]["re"]), list(&response["motor_raw"]["im"]));
    for (hertz, decibel) in [(3.5, -7.6), (8.0, -16.1), (12.0, -22.5)] {
        // Between bands: straight in log ω.
        let at: f64 = TAU * hertz;
        let k = omega.iter().position(|w| *w > at).unwrap();
        let level = |i: usize| 20.0 * (Complex64::new(re[i], im[i]).norm() * COUNTS / TAU).log10();
        let share = (at / omega[k - 1]).ln() / (omega[k] / omega[k - 1]).ln();
        let found = level(k - 1) + share * (level(k) - level(k - 1));
        assert!((found - decibel).abs() < 1.5, "{hertz} Hz: {found} dB, {decibel} by the author");
    }
}

#[test]
fn figures_are_per_unit_of_command_and_friction_is_seen() {
    let Some(data) = common::data("krauss-slfr") else { return };
    let result = sweeps(&data);
    assert!(common::has_finding(&result, "per-unit-of-command"));
    assert!(common::has_finding(&result, "friction-visible"));
    assert!(result["friction"].get("coulomb").is_some());
    assert!(result["drive"].get("inertia").is_some());
    // An accelerometer gives no coupling torque: nothing to predict another log with.
    assert!(result["arm"].is_null());
}

#[test]
fn odd_harmonics_of_the_fixed_runs() {
    let Some(data) = common::data("krauss-slfr") else { return };
    let file = common::read(include_str!("krauss-fixed.toml"), &data, "");
    let id = identify(&file.campaign, &Options::default(), |_| {}).unwrap();
    let RunKind::Sinusoidal(run) = &id.runs[0].kind else { panic!("not sinusoidal") };
    assert!((run.omega_rad_s / TAU - 5.0).abs() < 0.005, "{}", run.omega_rad_s);
    // Provenance, harmonics 1 to 7 of v: 101, 0.54, 3.40, 0.07, 1.00, 0.16, 0.77.
    let size = |k: usize| {
        let hold = lissom::spectrum::hold_factor(k as f64 * run.omega_rad_s, 0.002).norm();
        run.command.get(k).unwrap().value.norm() / hold
    };
    assert!((size(1) / 101.0 - 1.0).abs() < 0.02, "{}", size(1));
    for (k, expected) in [(3, 3.40), (5, 1.00), (7, 0.77)] {
        assert!((size(k) / expected - 1.0).abs() < 0.25, "harmonic {k}: {}", size(k));
    }
    let even = size(2).max(size(4)).max(size(6));
    assert!(even < 0.25 * size(3), "{even}");
    let result = lissom_io::ResultFile::of(&file.campaign.channels, &id, None);
    let json = serde_json::to_value(result).unwrap();
    assert!(common::has_finding(&json, "friction-visible"));
}
