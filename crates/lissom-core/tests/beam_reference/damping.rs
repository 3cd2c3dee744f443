//! Proportional and modal damping, and dampers at the masses.

use lissom::beam::{Damping, LumpedBeam};
use num_complex::Complex64;
use serde_json::Value;

use crate::data::{beam, cases, complex, list, nearest, numbers, read, real};

/// Poles and zeros, relatively.
const ROOTS: f64 = 1e-10;
/// Responses, against the larger of their size and one.
const RESPONSES: f64 = 1e-10;

pub(crate) fn damped(case: &Value) -> LumpedBeam {
    let damping = match case["kind"].as_str().unwrap() {
        "modal" => Damping::Modal { ratios: numbers(&case["zeta"]) },
        _ => Damping::Proportional {
            mass_per_s: real(case, "alpha_1_per_s"),
            stiffness_s: real(case, "beta_s"),
        },
    };
    beam(case).with_damping(damping).unwrap()
}

#[test]
fn damping_of_the_whole_beam() {
    let file = read("damping.json");
    for case in cases(&file) {
        let (beam, name) = (damped(case), &case["name"]);
        let poles = beam.poles();
        assert_eq!(poles.missing, 0);
        let error = nearest(&poles.s, &list(&case["damped_poles_s"]));
        assert!(error < ROOTS, "{name} poles: {error:e}");
        for (k, omega) in numbers(&case["omega_rad_s"]).into_iter().enumerate() {
            let found = beam.response(Complex64::new(0.0, omega));
            for (f, e) in found.angles.iter().zip(list(&case["response"][k])) {
                assert!((f - e).norm() < RESPONSES * e.norm().max(1.0), "{name} {omega}: {f} {e}");
            }
            let (f, e) = (found.coupling_nm_per_rad, complex(&case["ct"][k]));
            assert!((f - e).norm() < RESPONSES * e.norm(), "{name} {omega}: {f} {e}");
        }
    }
}

#[test]
fn dampers_at_the_masses() {
    let file = read("lumped.json");
    let mut seen = 0;
    for case in cases(&file).iter().filter(|c| c.get("damped_poles_s").is_some()) {
        let (beam, name) = (beam(case), &case["name"]);
        let poles = beam.poles();
        let error = nearest(&poles.s, &list(&case["damped_poles_s"]));
        assert!(poles.missing == 0 && error < ROOTS, "{name} poles: {error:e}");
        let zeros = beam.zeros_s(beam.len() - 1).unwrap();
        let error = nearest(&zeros.s, &list(&case["damped_zeros_s_tip"]));
        assert!(zeros.missing == 0 && error < ROOTS, "{name} zeros: {error:e}");
        seen += 1;
    }
    assert!(seen > 5, "{seen}");
}
