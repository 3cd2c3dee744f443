//! Responses with a delay, with damping within the beam, with a phase turned round.
#![expect(clippy::print_stdout, reason = "what tests measure is for docs")]

use std::f64::consts::FRAC_1_SQRT_2;

use lissom::identify::{
    Equivalent, EquivalentData, EquivalentRefusal, Finding, MotorData, Response, Severity,
    StdSource, equivalent,
};
use num_complex::Complex64;
use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

const OMEGA: [f64; 2] = [45.0, 170.0];
const GAINS: [[f64; 2]; 2] = [[0.6, 0.4], [1.15, -0.15]];

/// What is wrong, or not even, about the responses.
#[derive(Clone, Copy)]
struct Channels {
    damping: f64,
    /// Of the damping, what is within the beam.
    within: f64,
    delays_s: [f64; 2],
    noise: f64,
    seed: u64,
    std_source: StdSource,
}

const CLEAN: Channels = Channels {
    damping: 0.005,
    within: 0.0,
    delays_s: [0.0; 2],
    noise: 0.01,
    seed: 1,
    std_source: StdSource::Measured,
};

fn data(of: Channels) -> EquivalentData {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(of.seed);
    let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
    let omega: Vec<f64> = (0..400).map(|i| 10.0 * 35f64.powf(f64::from(i) / 399.0)).collect();
    let mut response = |i: usize, w: f64| {
        let s = Complex64::new(0.0, w);
        let part = |k: usize| {
            let (square, turn) = (OMEGA[k] * OMEGA[k], 2.0 * of.damping * OMEGA[k] * s);
            GAINS[i][k] * (square + of.within * turn) / (s * s + turn + square)
        };
        let value = (part(0) + part(1)) * (-s * of.delays_s[i]).exp();
        let error = Complex64::new(normal(), normal()) * (of.noise * value.norm() * FRAC_1_SQRT_2);
        let std = match of.std_source {
            StdSource::FromResidual => 1e-6,
            _ => of.noise.max(1e-3),
        };
        Response { value: value + error, std: std * value.norm() }
    };
    let outputs = (0..2).map(|i| omega.iter().map(|w| response(i, *w)).collect()).collect();
    EquivalentData {
        names: vec!["elbow".to_owned(), "tip".to_owned()],
        omega_rad_s: omega,
        outputs,
        motor: None,
        std_source: of.std_source,
    }
}

fn codes(found: &Equivalent) -> Vec<&str> {
    found.findings.iter().map(Finding::code).collect()
}

/// Largest error of a frequency or gain in its standard errors, and of a frequency as a share.
fn off(found: &Equivalent) -> (f64, f64) {
    assert_eq!(found.modes.len(), 2, "{:?}", found.fit.poles);
    let (mut worst, mut share) = (0.0_f64, 0.0_f64);
    for (k, omega) in OMEGA.iter().enumerate() {
        let estimate = found.kept.natural_frequency_rad_s(k);
        worst = worst.max((estimate.value - omega).abs() / estimate.std);
        share = share.max((estimate.value / omega - 1.0).abs());
        for (i, gains) in GAINS.iter().enumerate() {
            let gain = found.kept.static_gain(i, k);
            worst = worst.max((gain.value - gains[k]).abs() / gain.std);
        }
    }
    (worst, share)
}

/// What the fit has of a code: its message.
fn said(found: &Equivalent, code: &str) -> Option<String> {
    found.findings.iter().find(|f| f.code() == code).map(Finding::message)
}

#[test]
fn a_delay_is_found_and_taken_out() {
    for (delay_ms, noise) in [(0.02, 0.01), (-0.3, 0.0), (1.0, 1e-3)] {
        for std_source in [StdSource::Measured, StdSource::FromResidual] {
            let delays_s = [1e-3 * delay_ms, 2e-4 * delay_ms];
            let of = Channels { delays_s, noise, std_source, ..CLEAN };
            let found = equivalent(&data(of), None).unwrap();
            let (worst, share) = off(&found);
            println!("{delay_ms} ms, noise {noise}: {worst:.2} deviations, {share:.1e} off");
            let late = found.fit.delays_s[0].unwrap();
            assert!((late.value - delays_s[0]).abs() < 4.0 * late.std, "{late:?}");
            assert!(worst < 4.0 && said(&found, "equivalent-delay").unwrap().contains("elbow"));
            if noise == 0.0 {
                assert!(share < 1e-9);
            }
        }
    }
}

/// More than a tenth of the response is none of an arm's, however well a delay describes it.
#[test]
fn a_long_delay_is_refused() {
    let refused = equivalent(&data(Channels { delays_s: [5e-3; 2], ..CLEAN }), None).unwrap_err();
    let EquivalentRefusal::Uneven(part) = &refused else { panic!("{refused}") };
    assert!((part.delay_s.unwrap().value - 5e-3).abs() < 1e-4);
    assert!(refused.to_string().contains("ms late"), "{refused}");
}

#[test]
fn damping_within_the_beam_is_in_the_fit() {
    use StdSource::{FromResidual, Measured};
    let cases = [(0.01, 0.0, Measured), (0.01, 1e-3, FromResidual), (0.03, 0.01, Measured)];
    for (damping, noise, std_source) in cases {
        let of = Channels { damping, within: 1.0, noise, std_source, ..CLEAN };
        let found = equivalent(&data(of), None).unwrap();
        let (worst, share) = off(&found);
        println!("ζ {damping}, noise {noise}: {worst:.2} deviations, {share:.1e} off");
        assert!(worst < 4.0 && said(&found, "equivalent-terms-in-s").is_some());
        assert!(!codes(&found).contains(&"equivalent-spurious-pole"));
        assert!(!found.findings.iter().any(|f| f.severity() == Severity::Warning));
        if noise == 0.0 {
            assert!(share < 1e-10);
        }
    }
}

/// The torque of a beam that is damped within has (1 + 2ζ·s/ω) in it: coupling and motor as they are.
#[test]
fn coupling_knows_damping_within_the_beam() {
    let mut data = data(Channels { damping: 0.03, within: 1.0, noise: 0.0, ..CLEAN });
    let coupling = [0.3, 0.2];
    let torque = |w: f64| {
        let s = Complex64::new(0.0, w);
        let part = |k: usize| {
            let turn = 2.0 * 0.03 * OMEGA[k] * s;
            let denominator = s * s + turn + OMEGA[k] * OMEGA[k];
            coupling[k] * (1.0 + 2.0 * 0.03 * s / OMEGA[k]) * s * s / denominator
        };
        s * (s * 6e-4 + 1.5e-3) + part(0) + part(1)
    };
    let response = |w: &f64| {
        let value = 0.25 / torque(*w);
        Response { value, std: 1e-3 * value.norm() }
    };
    data.motor = Some(MotorData {
        response: data.omega_rad_s.iter().map(response).collect(),
        omega_rad_s: data.omega_rad_s.clone(),
        torque_per_command: 0.25,
    });
    let arm = equivalent(&data, None).unwrap().arm.unwrap();
    for (found, exact) in arm.coupling.iter().zip(coupling) {
        assert!((found.value / exact - 1.0).abs() < 1e-8, "{found:?}");
    }
    assert!((arm.inertia.value / 6e-4 - 1.0).abs() < 1e-8);
    assert!((arm.viscous.value / 1.5e-3 - 1.0).abs() < 1e-6 && arm.weighted_rms < 1e-6);
    let at = data.omega_rad_s[100];
    assert!((arm.motor_response(at) * torque(at) / 0.25 - 1.0).norm() < 1e-8);
}

/// To first order they are the same terms in s: estimates are right, or there is a warning.
#[test]
fn delay_and_damping_within_at_once_do_not_pass_silently() {
    for (delay_ms, noise) in [(-0.1, 1e-3), (0.1, 1e-3)] {
        let delays_s = [1e-3 * delay_ms; 2];
        let of = Channels { damping: 0.01, within: 1.0, delays_s, noise, ..CLEAN };
        let found = equivalent(&data(of), None).unwrap();
        let warned = found.findings.iter().any(|f| f.severity() == Severity::Warning);
        println!("{delay_ms} ms, noise {noise}: {:?} {:?}", off(&found), codes(&found));
        assert!(warned || off(&found).0 < 4.0);
    }
}

#[test]
fn clean_responses_stay_as_they_were() {
    for std_source in [StdSource::Measured, StdSource::FromResidual] {
        for seed in 0..4 {
            let found = equivalent(&data(Channels { seed, std_source, ..CLEAN }), None).unwrap();
            assert!(found.findings.is_empty() && off(&found).0 < 4.5, "{seed} {:?}", codes(&found));
        }
    }
}

/// A phase that is off by the same angle everywhere is neither a delay nor damping.
#[test]
fn a_turned_phase_is_told_of() {
    for std_source in [StdSource::Measured, StdSource::FromResidual] {
        let mut data = data(Channels { std_source, ..CLEAN });
        for response in data.outputs.iter_mut().flatten() {
            response.value *= Complex64::from_polar(1.0, 0.02);
        }
        let found = equivalent(&data, None).unwrap();
        println!("{:?} {:?}", off(&found), codes(&found));
        let warned = found.findings.iter().any(|f| f.severity() == Severity::Warning);
        assert!(warned || off(&found).0 < 4.0);
    }
}

/// With the phase's sign turned the responses are of poles that gain energy.
#[test]
fn a_turned_sign_of_the_phase_is_said() {
    for std_source in [StdSource::Measured, StdSource::FromResidual] {
        for turned in [&[0, 1][..], &[1]] {
            let mut data = data(Channels { std_source, damping: 0.01, ..CLEAN });
            for &i in turned {
                for response in &mut data.outputs[i] {
                    response.value.im = -response.value.im;
                }
            }
            let refused = equivalent(&data, None).unwrap_err();
            println!("{refused}");
            let names: Vec<&str> = turned.iter().map(|i| ["elbow", "tip"][*i]).collect();
            assert!(
                matches!(&refused, EquivalentRefusal::TurnedRound { names: n } if *n == names),
                "{refused}"
            );
            assert!(refused.hint().contains("sign of the phase"));
        }
    }
    // Noise alone is no phase of either sign.
    for seed in 0..5 {
        let mut data = data(Channels { seed, ..CLEAN });
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        for response in data.outputs.iter_mut().flatten() {
            let (re, im) = (StandardNormal.sample(&mut random), StandardNormal.sample(&mut random));
            *response = Response { value: Complex64::new(re, im), std: 1.5 };
        }
        let refused = equivalent(&data, None).unwrap_err();
        assert!(matches!(refused, EquivalentRefusal::Noise { .. }), "{refused}");
    }
}

/// The unit of a response is no matter as long as doubles hold it, and said where they do not.
#[test]
fn sizes_are_no_matter_until_doubles_end() {
    let plain = equivalent(&data(CLEAN), None).unwrap();
    for exponent in [-150, -40, 40, 150] {
        let mut data = data(CLEAN);
        for response in data.outputs.iter_mut().flatten() {
            response.value *= 10f64.powi(exponent);
            response.std *= 10f64.powi(exponent);
        }
        match equivalent(&data, None) {
            Ok(found) => {
                let (a, b) = (&found.kept.poles, &plain.kept.poles);
                assert!(
                    a.iter()
                        .zip(b)
                        .all(|(a, b)| (a.omega_rad_s / b.omega_rad_s - 1.0).abs() < 1e-9)
                );
                // No angle per angle: there is no form for use, and that is said.
                assert!(found.strainless.is_none());
                assert!(said(&found, "equivalent-gains").unwrap().contains("are not given"));
            }
            Err(refused) => {
                assert!(matches!(refused, EquivalentRefusal::Size { .. }), "{refused}");
                assert_eq!(exponent.abs(), 150);
            }
        }
    }
    let mut slip = data(CLEAN);
    slip.outputs[1][6].std = 1e-300;
    let refused = equivalent(&slip, None).unwrap_err().to_string();
    assert!(refused.contains("tip, frequency 7") && refused.contains("1.0e-300"), "{refused}");
}
