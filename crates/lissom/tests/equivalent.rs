//! Steps 1 to 5 of Section 4 on a distributed beam whose truncated model is known.
#![expect(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "tests; what they measure is for docs"
)]

use std::f64::consts::FRAC_1_SQRT_2;

use lissom::beam::{DistributedBeam, Piece, TruncatedBeam};
use lissom::identify::{Damping, EquivalentError, Response, equivalent_beam, fit_shared_poles};
use num_complex::Complex64;
use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

/// A steel ruler with a weight at its tip.
fn beam() -> DistributedBeam {
    let piece = Piece {
        length_m: 0.45,
        flexural_rigidity_n_m2: 0.17,
        mass_per_length_kg_per_m: 0.13,
        end_mass_kg: 0.02,
        end_damping_n_s_per_m: 0.0,
    };
    DistributedBeam::new(&[piece]).unwrap()
}

/// Seen at evenly spaced points up to the tip.
fn truncated(points: usize) -> TruncatedBeam {
    let at: Vec<f64> = (1..=points).map(|i| 0.45 * i as f64 / points as f64).collect();
    beam().truncated(&at).unwrap()
}

/// Its responses from half the first frequency to twice the last, with noise of a relative deviation;
/// the deviation that they claim is no less than 1e-3.
fn measured(beam: &TruncatedBeam, noise: f64, seed: u64) -> (Vec<f64>, Vec<Vec<Response>>) {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
    let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
    let poles = &beam.natural_frequencies_rad_s;
    let (low, high) = (0.5 * poles[0], 2.0 * poles[poles.len() - 1]);
    let omega: Vec<f64> = (0..600).map(|i| low * (high / low).powf(i as f64 / 599.0)).collect();
    let mut outputs = vec![Vec::new(); poles.len()];
    for w in &omega {
        let angles = beam.response(Complex64::new(0.0, *w)).angles;
        for (output, value) in outputs.iter_mut().zip(angles) {
            let error = Complex64::new(normal(), normal()) * (noise * value.norm() * FRAC_1_SQRT_2);
            let std = noise.max(1e-3) * value.norm();
            output.push(Response { value: value + error, std });
        }
    }
    (omega, outputs)
}

#[test]
fn exact_responses_give_the_truncated_beam() {
    for points in 1..=6 {
        let truth = truncated(points);
        let (omega, outputs) = measured(&truth, 0.0, 1);
        let fit = fit_shared_poles(&omega, &outputs, points, Damping::None).unwrap();
        let found = equivalent_beam(&fit).unwrap();
        let (a, b) = ((&found.a - &truth.a).amax() / truth.a.amax(), (&found.b - &truth.b).amax());
        println!("{points} points: Â off by {a:.1e}, B̂ by {:.1e}", b / truth.b.amax());
        assert!(a < 1e-8 && b < 1e-8 * truth.b.amax());
    }
}

/// Three modes with 1 % of noise: frequencies to 0.2 %, Â and B̂ within their deviations.
#[test]
fn noise_stays_within_its_deviations() {
    let truth = truncated(3);
    let (mut within, mut all) = (0, 0);
    for seed in 0..30 {
        let (omega, outputs) = measured(&truth, 0.01, seed);
        let fit = fit_shared_poles(&omega, &outputs, 3, Damping::None).unwrap();
        for (pole, omega) in fit.poles.iter().zip(&truth.natural_frequencies_rad_s) {
            assert!((pole.omega_rad_s / omega - 1.0).abs() < 2e-3);
        }
        let found = equivalent_beam(&fit).unwrap();
        for i in 0..3 {
            let b = (found.b[i] - truth.b[i]) / found.b_std[i];
            let a = (0..3).map(|j| (found.a[(i, j)] - truth.a[(i, j)]) / found.a_std[(i, j)]);
            for deviations in a.chain([b]) {
                assert!(deviations.abs() < 5.0, "{seed}: {deviations}");
                within += usize::from(deviations.abs() < 1.96);
                all += 1;
            }
        }
    }
    println!("{within} of {all} within 1.96 deviations");
    assert!((0.90..0.98).contains(&(f64::from(within as u32) / f64::from(all as u32))));
}

#[test]
fn points_that_move_alike_are_refused() {
    let truth = beam().truncated(&[0.2, 0.449_99, 0.45]).unwrap();
    let (omega, outputs) = measured(&truth, 0.01, 2);
    let fit = fit_shared_poles(&omega, &outputs, 3, Damping::None).unwrap();
    let refused = equivalent_beam(&fit).unwrap_err();
    assert!(matches!(refused, EquivalentError::TooClose { first: 1, second: 2, .. }), "{refused}");
    let fewer = fit_shared_poles(&omega, &outputs[..2], 3, Damping::None).unwrap();
    let refused = equivalent_beam(&fewer).unwrap_err();
    assert_eq!(refused, EquivalentError::PointsAndModes { points: 2, modes: 3 });
}
