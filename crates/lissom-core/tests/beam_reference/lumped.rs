//! Matrices, frequencies, zeros and responses of lumped beams, with and without payload.

use lissom::beam::Base;
use num_complex::Complex64;
use serde_json::Value;

use crate::data::{beam, cases, complex, entrywise, list, nearest, numbers, read, real};

/// Every entry of every matrix, relatively: up to 50 spans of any ratio, each entry against
/// itself, however small.
const MATRICES: f64 = 2e-12;
/// Every natural frequency, relatively.
const FREQUENCIES: f64 = 1e-12;
/// Every zero, relatively.
const ZEROS: f64 = 1e-10;
/// Responses, against the larger of their size and one.
const RESPONSES: f64 = 1e-10;

fn rows(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().flat_map(numbers).collect()
}

fn by_rows(m: &lissom::Matrix) -> Vec<f64> {
    m.transpose().iter().copied().collect()
}

#[test]
fn matrices_solve_the_reports_equations() {
    let file = read("lumped.json");
    let mut worst = 0.0_f64;
    for case in cases(&file) {
        let m = beam(case).matrices().unwrap();
        let mut check = |name: &str, found: &[f64], expected: Vec<f64>| {
            let error = entrywise(found, &expected);
            worst = worst.max(error);
            assert!(error < MATRICES, "{} {name}: {error:e}", case["name"]);
        };
        for (name, found) in [("ei_b", &m.ei_b), ("p", &m.p), ("h", &m.h)] {
            check(name, found.as_slice(), numbers(&case[name]));
        }
        check("h_motor", &[m.h_motor], vec![real(case, "h_motor")]);
        check("h_torque", &[m.h_torque], vec![real(case, "h_torque")]);
        if case.get("ei_a").is_some() {
            check("ei_a", &by_rows(&m.ei_a), rows(&case["ei_a"]));
            check("u", &by_rows(&m.u), rows(&case["u"]));
            check("q", m.q.as_slice(), numbers(&case["q"]));
        }
    }
    println!("matrices: worst entry {worst:.1e}");
}

fn frequencies(name: &str) {
    let file = read(name);
    let mut worst = 0.0_f64;
    for case in cases(&file) {
        let beam = beam(case);
        let rotor = Base::Rotor(real(case, "rotor_inertia_kg_m2"));
        for (base, key) in
            [(Base::Clamped, "natural"), (Base::Pinned, "pinned"), (rotor, "coupled")]
        {
            let expected = numbers(&case[&format!("{key}_frequencies_rad_s")]);
            let error = entrywise(&beam.frequencies_rad_s(base, usize::MAX), &expected);
            worst = worst.max(error);
            assert!(error < FREQUENCIES, "{} {key}: {error:e}", case["name"]);
        }
    }
    println!("{name}: worst frequency {worst:.1e}");
}

#[test]
fn frequencies_of_beams() {
    frequencies("lumped.json");
}

#[test]
fn frequencies_with_payload() {
    frequencies("payload.json");
}

fn zeros(cases: &[Value]) {
    let mut worst = 0.0_f64;
    for case in cases {
        let beam = beam(case);
        for (mass, expected) in case["zeros_z"].as_object().unwrap() {
            let found = beam.zeros(mass.parse::<usize>().unwrap() - 1).unwrap();
            assert_eq!(found.missing, 0, "{} mass {mass}", case["name"]);
            let error = nearest(&found.z, &list(expected));
            worst = worst.max(error);
            assert!(error < ZEROS, "{} mass {mass}: {error:e}", case["name"]);
        }
    }
    println!("worst zero {worst:.1e}");
}

#[test]
fn zeros_of_beams() {
    zeros(cases(&read("lumped.json")));
}

#[test]
fn zeros_with_payload() {
    let file = read("payload.json");
    zeros(cases(&file));
    // A payload towards the motor can make zeros complex: class c.
    zeros(file["negative_offset_cases"].as_array().unwrap());
}

#[test]
fn responses() {
    let mut worst = 0.0_f64;
    for name in ["lumped.json", "payload.json"] {
        let file = read(name);
        for case in cases(&file) {
            let beam = beam(case);
            let n = beam.len();
            let index: Vec<usize> = match case.get("response_index") {
                Some(list) => numbers(list).iter().map(|i| *i as usize - 1).collect(),
                None => (0..n).collect(),
            };
            for (k, omega) in numbers(&case["omega_rad_s"]).into_iter().enumerate() {
                let found = beam.response(Complex64::new(0.0, omega));
                let pairs = index.iter().zip(list(&case["response"][k]));
                let pairs = pairs.map(|(i, e)| (found.angles[*i], e, 1.0));
                let ct = complex(&case["ct"][k]);
                let scale = real(case, "h_motor").max(beam.inertia_kg_m2() * omega * omega);
                for (f, e, least) in pairs.chain([(found.coupling_nm_per_rad, ct, scale)]) {
                    let error = (f - e).norm() / e.norm().max(least);
                    worst = worst.max(error);
                    assert!(error < RESPONSES, "{} at {omega}: {f} {e} {error:e}", case["name"]);
                }
            }
        }
    }
    println!("worst response {worst:.1e}");
}

/// Modes add up to the whole: shares to one, inertias to that of the arm.
#[test]
fn modes_are_complete() {
    let file = read("lumped.json");
    for case in cases(&file) {
        let beam = beam(case);
        let modes = beam.modes(usize::MAX);
        assert_eq!(modes.len(), beam.len());
        let inertia: f64 = modes.iter().map(|m| m.inertia_kg_m2).sum();
        let name = &case["name"];
        assert!((inertia / beam.inertia_kg_m2() - 1.0).abs() < 1e-9, "{name} {inertia}");
        for i in 0..beam.len() {
            let sum: f64 = modes.iter().map(|m| m.share[i]).sum();
            assert!((sum - 1.0).abs() < 1e-9, "{name} mass {i}: {sum}");
        }
    }
}
