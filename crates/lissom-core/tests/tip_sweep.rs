//! The tip's sweep and the lowest modes of long beams, against 106 bits.

#![expect(clippy::print_stdout, reason = "tests, which show their errors")]

use lissom::beam::{Base, LumpedBeam};
use lissom_testmodels::{contrast_beam, exact, random_beam, uniform_beam};

/// Largest `|G − G_exact|/max(|G_exact|, 1)` up to ten times the twentieth natural frequency.
const MOST: f64 = 1e-9;
/// Points closer to a pole than this, relatively, are not held to it.
const NEAR_POLE: f64 = 1e-6;

/// Every third pole from both sides, just outside of what is left out, and points between.
fn frequencies(beam: &LumpedBeam) -> Vec<f64> {
    let lowest = beam.frequencies_rad_s(Base::Clamped, 20);
    let (low, high) = (0.1 * lowest[0], 10.0 * lowest[19]);
    let mut omega: Vec<f64> =
        (0..=40).map(|k| low * (high / low).powf(f64::from(k) / 40.0)).collect();
    let poles = beam.frequencies_below(Base::Clamped, high);
    for pole in beam.frequencies_rad_s(Base::Clamped, poles).iter().step_by(3) {
        omega.extend([-1.01, 1.01].map(|side| pole * (1.0 + side * NEAR_POLE)));
    }
    omega
}

fn worst(beam: &LumpedBeam) -> f64 {
    let omega = frequencies(beam);
    let found = beam.tip_response(&omega);
    let error = |(w, g): (&f64, &num_complex::Complex64)| {
        let exact = exact::tip_response(beam, *w);
        (g - exact).norm() / exact.abs().max(1.0)
    };
    omega.iter().zip(&found).map(error).fold(0.0, f64::max)
}

#[test]
fn a_thousand_masses_are_swept_to_1e_9() {
    let beams = [
        ("uniform", uniform_beam(1000)),
        ("random", random_beam(1000, 1)),
        ("another", random_beam(1000, 2)),
        ("EI 1 : 1e9", contrast_beam(1000)),
    ];
    for (name, beam) in beams {
        let worst = worst(&beam);
        println!("{name}: {worst:.1e}");
        assert!(worst <= MOST, "{name}: {worst:e}");
    }
}

/// A dense matrix of this beam would take 80 GB.
#[test]
fn modes_of_100_000_masses_need_no_matrix() {
    let beam = uniform_beam(100_000);
    for mode in beam.modes(2) {
        let exact = exact::mode(&beam, mode.natural_frequency_rad_s);
        let frequency = mode.natural_frequency_rad_s / exact.frequency_rad_s - 1.0;
        let shape = mode.shape.iter().zip(&exact.shape).map(|(f, e)| (f - e).abs());
        let shape = shape.fold(0.0, f64::max);
        println!("frequency: {frequency:.1e}, shape: {shape:.1e}");
        assert!(frequency.abs() < 1e-11 && shape < 1e-7, "{frequency:e}, {shape:e}");
    }
}
