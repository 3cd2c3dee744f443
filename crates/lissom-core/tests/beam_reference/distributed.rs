//! Distributed beams: closed forms, and transfer matrices in ball arithmetic.

use lissom::beam::{Base, DistributedBeam, Piece, RootClass, class};
use num_complex::Complex64;
use serde_json::Value;

use crate::data::{cases, complex, entrywise, list, nearest, numbers, payload, read, real};

/// Frequencies and zeros, relatively.
const ROOTS: f64 = 1e-10;
/// Responses, against the larger of their size and one.
const RESPONSES: f64 = 1e-10;

fn distributed(case: &Value) -> DistributedBeam {
    let each = |key: &str| numbers(&case[key]);
    let (l, ei) = (each("lengths_m"), each("ei_n_m2"));
    let (mu, m) = (each("mu_kg_per_m"), each("point_masses_kg"));
    let pieces: Vec<Piece> = (0..l.len())
        .map(|i| Piece {
            length_m: l[i],
            flexural_rigidity_n_m2: ei[i],
            mass_per_length_kg_per_m: mu[i],
            end_mass_kg: m[i],
            end_damping_n_s_per_m: 0.0,
        })
        .collect();
    DistributedBeam::new(&pieces)
        .and_then(|b| b.with_hub_radius(real(case, "hub_radius_m")))
        .and_then(|b| b.with_payload(payload(case)))
        .unwrap()
}

#[test]
fn closed_forms_of_the_uniform_cantilever() {
    let file = read("distributed.json");
    let closed = &file["uniform_closed_form"];
    let beam = distributed(&cases(&file)[0]);
    // EI = μ = l = 1: ω = λ².
    for (base, key) in [(Base::Clamped, "clamped_free"), (Base::Pinned, "pinned_free")] {
        let expected = numbers(&closed[&format!("{key}_lambda")]);
        let found: Vec<f64> =
            beam.frequencies_rad_s(base, expected.len()).iter().map(|w| w.sqrt()).collect();
        let error = entrywise(&found, &expected);
        println!("{key}: {error:.1e}");
        assert!(error < ROOTS, "{key}: {error:e}");
    }
    let expected: Vec<Complex64> =
        numbers(&closed["tip_zeros_z"]).into_iter().map(Complex64::from).collect();
    let beyond = expected[14].re.sqrt() * 1.01;
    let found = beam.zeros_below(1.0, beyond).unwrap();
    let error = nearest(&found.z, &expected);
    println!("tip zeros: {error:.1e}");
    assert!(error < ROOTS && found.missing == 0);
}

#[test]
fn beams_of_pieces_with_everything_on_them() {
    let file = read("distributed.json");
    let (mut frequency, mut response, mut zero) = (0.0_f64, 0.0_f64, 0.0_f64);
    for case in cases(&file) {
        let (beam, name) = (distributed(case), &case["name"]);
        let rotor = Base::Rotor(real(case, "rotor_inertia_kg_m2"));
        for (base, key) in
            [(Base::Clamped, "natural"), (Base::Pinned, "pinned"), (rotor, "coupled")]
        {
            let expected = numbers(&case[&format!("{key}_frequencies_rad_s")]);
            let error = entrywise(&beam.frequencies_rad_s(base, expected.len()), &expected);
            frequency = frequency.max(error);
            assert!(error < ROOTS, "{name} {key}: {error:e}");
        }
        for (k, omega) in numbers(&case["omega_rad_s"]).into_iter().enumerate() {
            let found = beam.response(Complex64::new(0.0, omega));
            let expected = numbers(&case["response"][k]);
            for (f, e) in found.angles.iter().zip(expected) {
                let error = (f - e).norm() / e.abs().max(1.0);
                response = response.max(error);
                assert!(error < RESPONSES, "{name} {omega}: {f} {e}");
            }
            let e = case["ct"][k].as_f64().unwrap();
            let scale = e.abs().max(beam.inertia_kg_m2() * omega * omega);
            let error = (found.coupling_nm_per_rad - e).norm() / scale;
            response = response.max(error);
            assert!(error < RESPONSES, "{name} {omega}: coupling {error:e}");
        }
        let radius = real(case, "tip_zeros_radius_z").sqrt();
        let found = beam.zeros_below(beam.length_m(), radius).unwrap();
        let error = nearest(&found.z, &list(&case["tip_zeros_z_all_below_radius"]));
        zero = zero.max(error);
        assert!(error < ROOTS && found.missing == 0, "{name}: {found:?}");
    }
    println!("frequencies {frequency:.1e}, responses {response:.1e}, zeros {zero:.1e}");
}

/// A point within the beam has zeros of classes a and b; all are found.
#[test]
fn zeros_at_a_point_within_the_beam() {
    let file = read("distributed.json");
    let beam = distributed(&cases(&file)[0]);
    let zeros = beam.zeros_below(0.5, beam.frequencies_rad_s(Base::Clamped, 12)[11]).unwrap();
    assert_eq!(zeros.missing, 0);
    let count = |c| zeros.z.iter().filter(|z| class(**z) == c).count();
    assert!(count(RootClass::Imaginary) > 2 && count(RootClass::Real) > 2, "{:?}", zeros.z);
    for z in &zeros.z {
        let angle = beam.response_at(z.sqrt(), &[0.5]).angles[0].norm();
        let beside = beam.response_at((z * 1.01).sqrt(), &[0.5]).angles[0].norm();
        // A pole may stand a millionth away: half of the beam hardly knows of the other half.
        assert!(angle < 1e-8 * beside, "{z}: {angle} {beside}");
    }
}

/// With one mode the plain sum is 14 % off at zero frequency; the corrected model is not.
#[test]
fn truncated_models_are_exact_at_zero_frequency() {
    let file = read("distributed.json");
    let uniform = distributed(&cases(&file)[0]);
    let plain = uniform.modes(1, &[1.0])[0].share[0];
    // 4/λ₁² for a uniform cantilever.
    assert!((plain - 4.0 / 1.875_104_068_711_961_f64.powi(2)).abs() < 1e-12, "{plain}");
    for case in cases(&file) {
        let (beam, name) = (distributed(case), &case["name"]);
        let (r, l) = (beam.hub_radius_m(), beam.length_m());
        for n in 1..=4_usize {
            let points: Vec<f64> = (1..=n).map(|k| r + (l - r) * k as f64 / n as f64).collect();
            let model = beam.truncated(&points).unwrap();
            let zero = Complex64::new(0.0, 0.0);
            let rest: f64 = model.h.sum() + model.h_motor;
            assert!(rest.abs() < 1e-9 * model.h_motor, "{name}: {rest}");
            for i in 0..n {
                let strained: f64 = model.a.row(i).sum() + model.b[i];
                assert!(strained.abs() < 1e-9 * model.a.row(i).abs().sum(), "{name}: {strained}");
                assert!((model.response(zero).angles[i].re - 1.0).abs() < 1e-12);
            }
            // The matrices say what the modal form says.
            let omega = 0.7 * model.natural_frequencies_rad_s[n - 1];
            let s2 = -omega * omega;
            let matrix = lissom::Matrix::identity(n, n) * s2 - &model.a;
            let theta = matrix.lu().solve(&model.b).unwrap();
            let modal = model.response(Complex64::new(0.0, omega));
            for i in 0..n {
                let (a, b) = (theta[i], modal.angles[i].re);
                assert!((a - b).abs() < 1e-8 * b.abs().max(1.0), "{name} {n} {i}: {a} {b}");
            }
            // Torque and angles approach those of the whole beam towards low frequencies, the
            // torque with the residual inertia on the motor's side.
            let first = model.natural_frequencies_rad_s[0];
            let slow = Complex64::new(0.0, 0.1 * first);
            let (exact, found) = (beam.response_at(slow, &points), model.response(slow));
            let torque = found.coupling_nm_per_rad + slow * slow * model.residual_inertia_kg_m2;
            let error = (torque / exact.coupling_nm_per_rad - 1.0).norm();
            assert!(error < 1e-3, "{name} {n}: torque {error:e}");
            for (f, e) in found.angles.iter().zip(&exact.angles) {
                assert!((f - e).norm() < 0.01, "{name} {n}: {f} {e}");
            }
        }
    }
}

#[test]
fn points_that_cannot_tell_the_modes_apart_are_refused() {
    let file = read("distributed.json");
    let beam = distributed(&cases(&file)[0]);
    let error = beam.truncated(&[0.999_999_999_9, 1.0]).unwrap_err().to_string();
    assert!(error.contains("cannot be separated"), "{error}");
}

/// The lumped beam of n masses tends to this one, with second order in 1/n.
#[test]
fn lumped_beams_tend_to_the_distributed_one() {
    let file = read("distributed.json");
    for case in cases(&file).iter().take(12) {
        let (beam, name) = (distributed(case), &case["name"]);
        let exact = beam.frequencies_rad_s(Base::Clamped, 3);
        let error = |n: usize| {
            let found = beam.lumped(n).unwrap().frequencies_rad_s(Base::Clamped, 3);
            (0..3).map(|k| (found[k] / exact[k] - 1.0).abs()).fold(0.0, f64::max)
        };
        let (coarse, fine) = (error(400), error(1600));
        let order = (coarse / fine).log2() / 2.0;
        assert!(fine < 1e-5 && (order - 2.0).abs() < 0.1, "{name}: {coarse:e} {fine:e} {order}");
    }
}

/// The slope's sign and the complex form of the response agree off the axes too.
#[test]
fn the_response_is_analytic() {
    let file = read("distributed.json");
    let beam = distributed(&cases(&file)[10]);
    let s = complex(&serde_json::json!([-3.0, 40.0]));
    let h = 1e-4;
    let at = |s: Complex64| beam.response(s).angles[0];
    let along = (at(s + h) - at(s - h)) / (2.0 * h);
    let across = (at(s + Complex64::new(0.0, h)) - at(s - Complex64::new(0.0, h)))
        / Complex64::new(0.0, 2.0 * h);
    assert!((along / across - 1.0).norm() < 1e-6, "{along} {across}");
    assert!((at(s.conj()) - at(s).conj()).norm() < 1e-12);
}
