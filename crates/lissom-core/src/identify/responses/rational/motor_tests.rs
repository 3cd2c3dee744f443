//! Tests of the motor's equation fitted to its response.

use num_complex::Complex64;

use crate::identify::responses::correct::Response;
use crate::identify::responses::rational::Pole;
use crate::identify::responses::rational::motor::{MotorData, fit_motor};
use crate::lti::TransferFunction;

/// Responses of the report's (35).
fn report() -> MotorData {
    let g = TransferFunction {
        num: vec![394.94, 394.94 * 0.06, 394.94 * 43.75],
        den: vec![1.0, 2.26, 165.7, 103.56, 0.0],
    };
    let omega_rad_s: Vec<f64> = (0..40).map(|k| 1.1_f64.powi(k)).collect();
    let response = omega_rad_s
        .iter()
        .map(|&w| Response { value: g.response(w), std: 1e-3 * g.response(w).norm() })
        .collect();
    MotorData { omega_rad_s, response, torque_per_command: 2.184 }
}

#[test]
fn reads_the_reports_parameters_off_its_transfer_function() {
    // 6.2.2: J = 0.005529, V = 0.01216, coupling 0.674, from (35) and (36).
    let pole = Pole { omega_rad_s: 43.75_f64.sqrt(), damping_ratio: 0.03 / 43.75_f64.sqrt() };
    let fit = fit_motor(&report(), Some(&[pole])).unwrap();
    assert!((fit.inertia.value / 0.005_529 - 1.0).abs() < 5e-3, "{fit:?}");
    assert!((fit.viscous.value / 0.012_16 - 1.0).abs() < 2e-2, "{fit:?}");
    assert!((fit.coupling[0].value / 0.674 - 1.0).abs() < 5e-3, "{fit:?}");
    let (a, b) = (fit.transfer_function.response(8.0), report_at(8.0));
    assert!((a / b - 1.0).norm() < 0.01);
}

fn report_at(omega: f64) -> Complex64 {
    let d = report();
    let k = d.omega_rad_s.iter().position(|w| *w >= omega).unwrap();
    let g = TransferFunction {
        num: vec![394.94, 394.94 * 0.06, 394.94 * 43.75],
        den: vec![1.0, 2.26, 165.7, 103.56, 0.0],
    };
    assert!(d.omega_rad_s[k] > 0.0);
    g.response(omega)
}

#[test]
fn finds_the_pole_without_tips() {
    let fit = fit_motor(&report(), None).unwrap();
    assert_eq!(fit.poles.len(), 1);
    assert!((fit.poles[0].omega_rad_s / 43.75_f64.sqrt() - 1.0).abs() < 5e-3, "{fit:?}");
    assert!((fit.inertia.value / 0.005_529 - 1.0).abs() < 1e-2, "{fit:?}");
}

#[test]
fn too_few_frequencies_give_nothing() {
    let mut d = report();
    d.omega_rad_s.truncate(1);
    d.response.truncate(1);
    assert!(fit_motor(&d, None).is_none());
}
