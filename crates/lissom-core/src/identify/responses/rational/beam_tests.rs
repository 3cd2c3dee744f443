//! Tests of the fit of a beam.

use crate::identify::responses::correct::Response;
use crate::identify::responses::rational::Pole;
use crate::identify::responses::rational::beam::{TipData, TipForm, fit_beam};

#[test]
fn two_modes_and_two_tips_are_found_without_being_told() {
    let truth = [
        Pole { omega_rad_s: 6.0, damping_ratio: 0.004 },
        Pole { omega_rad_s: 40.0, damping_ratio: 0.01 },
    ];
    let residues = [[30.0, 400.0], [45.0, -500.0]];
    let omega: Vec<f64> = (0..60).map(|k| 1.1_f64.powi(k) * 0.5).collect();
    let tips: Vec<TipData> = residues
        .iter()
        .map(|r| TipData {
            form: TipForm::Angle,
            response: omega
                .iter()
                .map(|&w| {
                    let value = r[0] / truth[0].denominator(w) + r[1] / truth[1].denominator(w);
                    Response { value, std: 1e-4 * value.norm() }
                })
                .collect(),
        })
        .collect();
    let fit = fit_beam(&omega, &tips).unwrap();
    assert_eq!(fit.poles.len(), 2);
    for (found, t) in fit.poles.iter().zip(truth) {
        assert!((found.omega_rad_s / t.omega_rad_s - 1.0).abs() < 1e-8, "{found:?}");
        assert!((found.damping_ratio - t.damping_ratio).abs() < 1e-8, "{found:?}");
    }
    assert!((fit.residues[1][1].value + 500.0).abs() < 1e-5);
    let g = fit.transfer_functions[0].response(3.0);
    let t = 30.0 / truth[0].denominator(3.0) + 400.0 / truth[1].denominator(3.0);
    assert!((g - t).norm() < 1e-6);
}
