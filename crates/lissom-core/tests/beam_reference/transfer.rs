//! Transfer functions by zeros, poles and gain against the reference responses.

use lissom::arm::Arm;
use lissom::beam::LumpedBeam;
use lissom::drive::{Coulomb, Motor};
use num_complex::Complex64;
use serde_json::Value;

use crate::damping::damped;
use crate::data::{beam, cases, complex, list, numbers, read, real};

/// Relatively to the response's own size: zeros and poles are exact, their product is not more.
const VALUES: f64 = 1e-9;
/// Against a dense state space, whose own rounding enters.
const STATE_SPACE: f64 = 1e-8;

fn each(mut check: impl FnMut(&Value, &LumpedBeam)) {
    for name in ["lumped.json", "payload.json", "damping.json"] {
        let file = read(name);
        for case in cases(&file).iter().filter(|c| c["lengths_m"].as_array().unwrap().len() <= 30) {
            let beam = if case.get("kind").is_some() { damped(case) } else { beam(case) };
            check(case, &beam);
        }
    }
}

#[test]
fn angles_and_coupling() {
    let mut seen = 0;
    each(|case, beam| {
        let index: Vec<usize> = match case.get("response_index") {
            Some(list) => numbers(list).iter().map(|i| *i as usize - 1).collect(),
            None => (0..beam.len()).collect(),
        };
        let coupling = beam.coupling_function();
        assert_eq!(coupling.missing, 0, "{}", case["name"]);
        let angles: Vec<_> = index.iter().map(|i| beam.angle_function(*i).unwrap()).collect();
        for (k, omega) in numbers(&case["omega_rad_s"]).into_iter().enumerate() {
            let s = Complex64::new(0.0, omega);
            let expected = list(&case["response"][k]);
            let mut pairs: Vec<_> = angles.iter().zip(expected).collect();
            pairs.push((&coupling, complex(&case["ct"][k])));
            for (function, expected) in pairs {
                let found = function.value(s);
                let error = (found - expected).norm() / expected.norm();
                assert!(error < VALUES, "{} at {omega}: {found} {expected}", case["name"]);
                seen += 1;
            }
        }
    });
    assert!(seen > 1000, "{seen}");
}

/// The arm's own functions against its state space, motor and loads included.
#[test]
fn the_state_space_tells_the_same() {
    let motor = |j: f64| Motor::new(j, 0.02 * j, 0.3).unwrap();
    each(|case, beam| {
        let j = if case.get("rotor_inertia_kg_m2").is_some() {
            real(case, "rotor_inertia_kg_m2")
        } else {
            beam.inertia_kg_m2()
        };
        if beam.len() > 6 || case["name"].as_str().unwrap().starts_with("g_") {
            return;
        }
        let arm = Arm::new(beam.clone(), motor(j), Coulomb::symmetric(0.1).unwrap()).unwrap();
        let (space, function) = (arm.state_space(), arm.motor_function());
        assert_eq!(function.missing, 0);
        let first = beam.natural_frequencies_rad_s()[0];
        for omega in [0.3 * first, 1.7 * first, 4.1 * first] {
            let s = Complex64::new(0.0, omega);
            let dense = space.response(omega).unwrap();
            let mut pairs = vec![
                (function.value(s), dense[(0, 0)]),
                (arm.motor_response(omega), dense[(0, 0)]),
            ];
            for i in 0..beam.len() {
                pairs.push((arm.angle_function(i).unwrap().value(s), dense[(1 + i, 0)]));
            }
            let torque = arm.motor_response(omega) * beam.response(s).coupling_nm_per_rad;
            pairs.push((torque, dense[(1 + beam.len(), 0)]));
            for (found, expected) in pairs {
                let error = (found - expected).norm() / expected.norm();
                assert!(error < STATE_SPACE, "{} {omega}: {found} {expected}", case["name"]);
            }
        }
    });
}
