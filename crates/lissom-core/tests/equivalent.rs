//! Steps 1 to 6 of Section 4 on a distributed beam whose truncated model is known.
#![expect(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "tests; what they measure is for docs"
)]

use std::f64::consts::FRAC_1_SQRT_2;

use lissom::beam::{DistributedBeam, Piece, TruncatedBeam};
use lissom::identify::{
    Damping, EquivalentData, EquivalentError, Estimate, MotorData, Response, SharedPoles,
    StdSource, equivalent, equivalent_arm, equivalent_beam, fit_shared_poles, response_zeros,
};
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
/// the standard error that they claim is no less than 1e-3.
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

/// Its motor: J, V, and K.
const MOTOR: (f64, f64, f64) = (6e-4, 1.5e-3, 0.25);

/// The motor's response with the beam's torque, at the frequencies of [`measured`].
fn motor(beam: &TruncatedBeam, omega: &[f64], noise: f64, seed: u64) -> MotorData {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed + 1_000_000);
    let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
    let (inertia, viscous, torque_per_command) = MOTOR;
    let response = |w: &f64| {
        let s = Complex64::new(0.0, *w);
        let rigid = s * (s * (inertia + beam.residual_inertia_kg_m2) + viscous);
        let value = torque_per_command / (rigid + beam.response(s).coupling_nm_per_rad);
        let error = Complex64::new(normal(), normal()) * (noise * value.norm() * FRAC_1_SQRT_2);
        Response { value: value + error, std: noise.max(1e-3) * value.norm() }
    };
    let response = omega.iter().map(response).collect();
    MotorData { omega_rad_s: omega.to_vec(), response, torque_per_command }
}

/// s² of the zeros of θ_i/θ_m, from the exact shares.
fn exact_zeros(beam: &TruncatedBeam, output: usize) -> Vec<f64> {
    let steps = 400_000;
    let last = beam.natural_frequencies_rad_s.last().unwrap();
    let (low, high) = (-(2.0 * last).powi(2), (4.0 * last).powi(2));
    let at = |z: f64| {
        let product: f64 = beam.natural_frequencies_rad_s.iter().map(|w| z + w * w).product();
        let s = Complex64::new(z, 0.0).sqrt();
        beam.response(s).angles[output].re * product
    };
    let grid = |i: i32| low + (high - low) * (f64::from(i) + 0.123) / f64::from(steps);
    (0..steps)
        .filter(|i| at(grid(*i)) * at(grid(i + 1)) < 0.0)
        .map(|i| {
            let (mut a, mut b) = (grid(i), grid(i + 1));
            for _ in 0..200 {
                let middle = 0.5 * (a + b);
                if at(a) * at(middle) <= 0.0 { b = middle } else { a = middle }
            }
            0.5 * (a + b)
        })
        .collect()
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
        // All modes are there: the form for use is as near as what was fitted.
        let form = found.strainless(&[]).unwrap();
        let off = (&form.a - &truth.a).component_div(&found.a_std).amax();
        assert!(form.given_to_last == [false; 3] && off < 5.0, "{seed}: {off}");
        assert!((form.a.column_sum() + &form.b).amax() < 1e-12 * form.b.amax());
        for i in 0..3 {
            let b = (found.b[i] - truth.b[i]) / found.b_std[i];
            let a = (0..3).map(|j| (found.a[(i, j)] - truth.a[(i, j)]) / found.a_std[(i, j)]);
            for standard_errors in a.chain([b]) {
                assert!(standard_errors.abs() < 5.0, "{seed}: {standard_errors}");
                within += usize::from(standard_errors.abs() < 1.96);
                all += 1;
            }
        }
    }
    println!("{within} of {all} within 1.96 deviations");
    assert!((0.90..0.98).contains(&(f64::from(within as u32) / f64::from(all as u32))));
}

/// Step 6 on exact data, up to six modes: Ĥ, ĥ, J with the inertia left over, and V.
#[test]
fn exact_responses_give_the_whole_arm() {
    for points in 1..=6 {
        let truth = truncated(points);
        let (omega, outputs) = measured(&truth, 0.0, 1);
        let fit = fit_shared_poles(&omega, &outputs, points, Damping::None).unwrap();
        let found = equivalent_arm(&fit, &motor(&truth, &omega, 0.0, 1)).unwrap();
        let h = (0..points).map(|i| (found.h[i].value - truth.h[i]).abs()).fold(0.0, f64::max);
        let h = h / truth.h.amax();
        let h_motor = found.h_motor.value / truth.h_motor - 1.0;
        let inertia = found.inertia.value / (MOTOR.0 + truth.residual_inertia_kg_m2) - 1.0;
        let viscous = found.viscous.value / MOTOR.1 - 1.0;
        println!("{points} points: Ĥ {h:.1e}, ĥ {h_motor:.1e}, J {inertia:.1e}, V {viscous:.1e}");
        assert!(h < 1e-8 && h_motor.abs() < 1e-8);
        assert!(inertia.abs() < 1e-8 && viscous.abs() < 1e-6);
        // The shares of a truncated beam add up to one: nothing is left to give.
        let form = found.strainless().unwrap();
        assert!(form.missing.amax() < 1e-8);
        assert!((&form.a - &truth.a).amax() < 1e-8 * truth.a.amax());
        assert!((&form.h - &truth.h).amax() < 1e-8 * truth.h.amax());
        let names: Vec<&str> = ["a", "b", "c", "d", "e", "f"][..points].to_vec();
        let space = found.state_space(&names, "rad");
        for w in [0.3, 1.7, 2.9].map(|share| share * truth.natural_frequencies_rad_s[0]) {
            let shown = space.response(w).unwrap();
            let motor = found.motor_response(w);
            assert!((shown[(0, 0)] / motor - 1.0).norm() < 1e-7);
            let angles = truth.response(Complex64::new(0.0, w)).angles;
            assert!((shown[(points, 0)] / motor / angles[points - 1] - 1.0).norm() < 1e-7);
        }
        assert!((form.h.sum() + form.h_motor).abs() < 1e-12 * form.h_motor);
    }
}

#[test]
fn zeros_are_those_of_the_shares() {
    for points in 2..=4 {
        let truth = truncated(points);
        let (omega, outputs) = measured(&truth, 0.0, 1);
        let fit = fit_shared_poles(&omega, &outputs, points, Damping::None).unwrap();
        for output in 0..points {
            let found = response_zeros(&fit, output);
            let real = exact_zeros(&truth, output);
            assert!(found.len() < points && found.len() >= real.len());
            for z in real {
                let near = found.iter().map(|f| (f.square / z - 1.0).norm()).fold(1.0, f64::min);
                assert!(near < 1e-7, "{points} {output}: {z} {found:?}");
            }
        }
    }
}

fn median(mut of: Vec<f64>) -> f64 {
    of.sort_by(f64::total_cmp);
    of[of.len() / 2]
}

/// Three modes, 1 % of noise, 1000 draws: frequencies 0.2 %, zeros 1 %, coupling 2 %, and 95 % intervals that
/// hold.
#[test]
fn one_per_cent_of_noise_with_three_modes() {
    let truth = truncated(3);
    let zeros: Vec<Vec<f64>> = (0..3).map(|i| exact_zeros(&truth, i)).collect();
    let (mut frequencies, mut at_zeros, mut coupling) = (Vec::new(), Vec::new(), Vec::new());
    let mut within = [(0, 0); 3];
    let mut count = |kind: usize, found: Estimate, truth: f64| {
        within[kind].0 += u32::from((found.value - truth).abs() < 1.96 * found.std);
        within[kind].1 += 1;
        (found.value / truth - 1.0).abs()
    };
    for seed in 0..1000 {
        let (omega, outputs) = measured(&truth, 0.01, seed);
        let fit: SharedPoles = fit_shared_poles(&omega, &outputs, 3, Damping::None).unwrap();
        let found = equivalent_arm(&fit, &motor(&truth, &omega, 0.01, seed)).unwrap();
        for k in 0..3 {
            let exact = truth.natural_frequencies_rad_s[k];
            frequencies.push(count(0, fit.natural_frequency_rad_s(k), exact));
        }
        for (i, exact) in zeros.iter().enumerate() {
            let found = response_zeros(&fit, i);
            for z in exact {
                let near = |f: &&lissom::identify::ResponseZero| (f.square / z - 1.0).norm();
                let zero = found.iter().min_by(|a, b| near(a).total_cmp(&near(b))).unwrap();
                at_zeros.push(count(1, zero.omega_rad_s, z.abs().sqrt()));
            }
        }
        for i in 0..3 {
            coupling.push(count(2, found.h[i], truth.h[i]));
        }
        coupling.push(count(2, found.h_motor, truth.h_motor));
    }
    let medians = [frequencies, at_zeros, coupling].map(median);
    println!("medians {medians:?}, within {within:?}");
    assert!(medians[0] < 2e-3 && medians[1] < 1e-2 && medians[2] < 2e-2);
    for (inside, all) in within {
        assert!((0.925..0.975).contains(&(f64::from(inside) / f64::from(all))));
    }
}

/// Three modes of a beam that has all of them: what was fitted strains a beam that turns as one body, the
/// form for use does not.
#[test]
fn the_form_for_use_turns_as_one_body() {
    let beam = beam();
    let points = [0.15, 0.3, 0.45];
    let omega: Vec<f64> = (0..400).map(|i| 5.0 * 60f64.powf(f64::from(i) / 399.0)).collect();
    let mut outputs = vec![Vec::new(); 3];
    let whole = beam.truncated(&[0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.45]).unwrap();
    for w in &omega {
        let angles = whole.response(Complex64::new(0.0, *w)).angles;
        for (output, value) in outputs.iter_mut().zip([angles[2], angles[5], angles[7]]) {
            output.push(Response { value, std: 1e-3 * value.norm() });
        }
    }
    let fit = fit_shared_poles(&omega, &outputs, 3, Damping::None).unwrap();
    let found = equivalent_beam(&fit).unwrap();
    let raw = (found.a.column_sum() + &found.b).amax() / found.b.amax();
    let form = found.strainless(&[]).unwrap();
    let used = (form.a.column_sum() + &form.b).amax() / form.b.amax();
    println!(
        "{points:?}: strained by {raw:.1e} as fitted, {used:.1e} as used, missing {}",
        form.missing
    );
    assert!(raw > 1e-4 && used < 1e-12 && form.given_to_last == [true; 3]);
}

#[test]
fn points_that_move_alike_are_refused() {
    let truth = beam().truncated(&[0.2, 0.449_99, 0.45]).unwrap();
    let (omega, outputs) = measured(&truth, 0.01, 2);
    let fit = fit_shared_poles(&omega, &outputs, 3, Damping::None).unwrap();
    let refused = equivalent_beam(&fit).unwrap_err();
    assert!(matches!(refused, EquivalentError::TooClose { first: 1, second: 2, .. }), "{refused}");
    // Where the second would do better, and there it does.
    let best = beam().best_point(&[0.2, 0.449_99, 0.45], 1).unwrap();
    println!("{best:?}");
    assert!(best.least > 100.0 * best.least_now);
    for position in [0.1, 0.15, 0.25, 0.35, 0.4] {
        let others = beam().best_point(&[0.2, position, 0.45], 1).unwrap();
        assert!(others.least_now <= best.least * 1.001);
        assert!((others.position_m - best.position_m).abs() < 1e-12);
    }
    let mut points = [0.2, best.position_m, 0.45];
    points.sort_by(f64::total_cmp);
    let moved = beam().truncated(&points).unwrap();
    let (omega_moved, outputs_moved) = measured(&moved, 0.01, 2);
    let fit = fit_shared_poles(&omega_moved, &outputs_moved, 3, Damping::None).unwrap();
    assert!(equivalent_beam(&fit).is_ok());
    assert!(beam().best_point(&[0.2, 0.5], 0).is_err() && beam().best_point(&[0.2], 1).is_err());
    let fewer = fit_shared_poles(&omega, &outputs[..2], 3, Damping::None).unwrap();
    let refused = equivalent_beam(&fewer).unwrap_err();
    assert_eq!(refused, EquivalentError::PointsAndModes { points: 2, modes: 3 });
}

/// Two points of a beam whose third mode lies beyond the frequencies: what it does within them is neither the
/// modes' coupling nor lost from the inertia.
#[test]
fn modes_beyond_the_frequencies_are_counted_with_the_inertia() {
    let whole = truncated(5);
    let poles = &whole.natural_frequencies_rad_s;
    let (low, high) = (0.3 * poles[0], 0.6 * poles[2]);
    let omega: Vec<f64> = (0..300).map(|i| low * (high / low).powf(f64::from(i) / 299.0)).collect();
    let two = beam().truncated(&[0.27, 0.45]).unwrap();
    let (mut coupling, mut inertia) = (Vec::new(), Vec::new());
    let seen = |z: &f64| (low..high).contains(&z.abs().sqrt());
    let exact_zeros: Vec<Vec<f64>> = [2, 4]
        .map(|i| exact_zeros(&whole, i).into_iter().filter(seen).collect::<Vec<f64>>())
        .to_vec();
    let (mut zeros, mut zeros_within) = (0, 0);
    for seed in 0..20 {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let mut noisy = |value: Complex64| {
            let error = Complex64::new(normal(), normal()) * (0.01 * value.norm() * FRAC_1_SQRT_2);
            Response { value: value + error, std: 0.01 * value.norm() }
        };
        let angle = |w: f64, i: usize| whole.response(Complex64::new(0.0, w)).angles[i];
        let data = EquivalentData {
            names: vec!["middle".to_owned(), "tip".to_owned()],
            omega_rad_s: omega.clone(),
            outputs: [2, 4].map(|i| omega.iter().map(|w| noisy(angle(*w, i))).collect()).to_vec(),
            motor: Some(motor(&whole, &omega, 0.01, seed)),
            std_source: StdSource::Measured,
        };
        let found = equivalent(&data, None).unwrap();
        assert!(found.findings.iter().any(|f| f.code() == "equivalent-spurious-pole"));
        // Of the whole response: two modes alone have others.
        for (exact, found) in exact_zeros.iter().zip(&found.zeros) {
            for square in exact {
                let size = square.abs().sqrt();
                let near = found.iter().filter(|z| z.square.re * square > 0.0);
                let off = near.map(|z| {
                    let estimate = z.omega_rad_s;
                    ((estimate.value - size).abs() / estimate.std, estimate.std / estimate.value)
                });
                let least = off.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
                assert!(least.0 < 4.5 && least.1 < 0.05, "seed {seed}: {size} {least:?} {found:?}");
                (zeros, zeros_within) = (zeros + 1, zeros_within + usize::from(least.0 < 1.96));
            }
        }
        let arm = found.arm.unwrap();
        coupling.push(arm.h_motor.value / two.h_motor - 1.0);
        let exact = MOTOR.0 + two.residual_inertia_kg_m2;
        inertia.push((arm.inertia.value - exact) / arm.inertia.std);
    }
    let (coupling, inertia) = (median(coupling), median(inertia));
    println!("ĥ off by {coupling:.1e}, J by {inertia:.2} deviations (medians)");
    println!("{zeros_within} of {zeros} zeros within 1.96 deviations");
    assert!(zeros >= 40);
    assert!(coupling.abs() < 2e-2 && inertia.abs() < 2.0);
}
