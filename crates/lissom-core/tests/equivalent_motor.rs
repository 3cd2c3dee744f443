//! Errors that are no share of each response, and motors that are not what they are said to be.
#![expect(clippy::print_stdout, reason = "what tests measure is for docs")]

use std::f64::consts::FRAC_1_SQRT_2;

use lissom::identify::{
    Equivalent, EquivalentData, EquivalentRefusal, Estimate, Finding, MotorData, Response,
    Severity, StdSource, equivalent,
};
use num_complex::Complex64;
use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

const OMEGA: [f64; 2] = [12.0, 46.0];
const DAMPING: [f64; 2] = [0.005, 0.008];
const GAINS: [[f64; 2]; 2] = [[0.6, 0.4], [1.15, -0.15]];
const COUPLING: [f64; 2] = [0.3, 0.4];
const INERTIA: f64 = 6e-4;
const VISCOUS: f64 = 4e-3;
const CONSTANT: f64 = 0.25;

/// Responses of two points and of the motor, exact.
#[derive(Clone, Copy)]
struct Truth {
    /// Share of the damping that is within the beam.
    within: f64,
    motor_delay_s: f64,
    /// Torque against the motion per angle that is the same at all frequencies [N·m/rad].
    friction: f64,
}

const SOUND: Truth = Truth { within: 0.0, motor_delay_s: 0.0, friction: 0.0 };

impl Truth {
    fn shares(self, w: f64) -> [Complex64; 2] {
        let s = Complex64::new(0.0, w);
        [0, 1].map(|k| {
            let (square, turn) = (OMEGA[k] * OMEGA[k], 2.0 * DAMPING[k] * OMEGA[k] * s);
            (square + self.within * turn) / (s * s + turn + square)
        })
    }

    fn point(self, i: usize, w: f64) -> Complex64 {
        let shares = self.shares(w);
        GAINS[i][0] * shares[0] + GAINS[i][1] * shares[1]
    }

    fn motor(self, w: f64) -> Complex64 {
        let (s, shares) = (Complex64::new(0.0, w), self.shares(w));
        let torque = |k: usize| {
            let spring = COUPLING[k] * (1.0 + 2.0 * self.within * DAMPING[k] * s / OMEGA[k]);
            spring * (1.0 - shares[k])
        };
        let rigid = s * (INERTIA * s + VISCOUS) + Complex64::new(0.0, self.friction);
        CONSTANT / (rigid + torque(0) + torque(1)) * (-s * self.motor_delay_s).exp()
    }
}

struct Noise {
    size: f64,
    /// Of one size for all of a response, its median's share; a share of each value otherwise.
    of_one_size: bool,
    known: bool,
    seed: u64,
}

fn data(truth: Truth, noise: &Noise) -> EquivalentData {
    let omega: Vec<f64> = (0..80).map(|i| 4.0 * 25f64.powf(f64::from(i) / 79.0)).collect();
    let mut random = Xoshiro256PlusPlus::seed_from_u64(noise.seed);
    let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
    let mut noisy = |exact: Vec<Complex64>| -> Vec<Response> {
        let mut sizes: Vec<f64> = exact.iter().map(|v| v.norm()).collect();
        sizes.sort_by(f64::total_cmp);
        let median = sizes[sizes.len() / 2];
        let one = |value: Complex64| {
            let std = noise.size * if noise.of_one_size { median } else { value.norm() };
            let error = Complex64::new(normal(), normal()) * (std * FRAC_1_SQRT_2);
            let value = value + error;
            Response { value, std: if noise.known { std } else { 1e-6 * value.norm() } }
        };
        exact.into_iter().map(one).collect()
    };
    let outputs =
        (0..2).map(|i| noisy(omega.iter().map(|&w| truth.point(i, w)).collect())).collect();
    let motor = noisy(omega.iter().map(|&w| truth.motor(w)).collect());
    EquivalentData {
        names: vec!["middle".to_owned(), "tip".to_owned()],
        motor: Some(MotorData {
            omega_rad_s: omega.clone(),
            response: motor,
            torque_per_command: CONSTANT,
        }),
        omega_rad_s: omega,
        outputs,
        std_source: if noise.known { StdSource::Measured } else { StdSource::FromResidual },
    }
}

/// Largest error of J, V, coupling, frequencies and gains in their deviations.
fn off(found: &Equivalent) -> f64 {
    assert_eq!(found.modes.len(), 2, "{:?}", found.fit.poles);
    let Some(arm) = &found.arm else { return f64::INFINITY };
    let mut worst = 0.0_f64;
    let mut judge = |e: Estimate, truth: f64| worst = worst.max((e.value - truth).abs() / e.std);
    judge(arm.inertia, INERTIA);
    judge(arm.viscous, VISCOUS);
    for k in 0..2 {
        judge(arm.coupling[k], COUPLING[k]);
        judge(found.kept.natural_frequency_rad_s(k), OMEGA[k]);
        for (i, gains) in GAINS.iter().enumerate() {
            judge(found.kept.static_gain(i, k), gains[k]);
        }
    }
    worst
}

fn warnings(found: &Equivalent) -> Vec<&str> {
    let warned = found.findings.iter().filter(|f| f.severity() == Severity::Warning);
    warned.map(Finding::code).collect()
}

/// Seeds 0 to 19: each estimate is within 4.5 standard errors, and this is warned of.
fn sound(
    truth: Truth,
    of_one_size: bool,
    known: bool,
    expected: &[&str],
) -> Result<(), EquivalentRefusal> {
    let mut worst = 0.0_f64;
    for seed in 0..20 {
        let noise = Noise { size: 0.02, of_one_size, known, seed };
        let found = equivalent(&data(truth, &noise), None)?;
        assert_eq!(warnings(&found), expected, "seed {seed}: {:?}", found.findings);
        worst = worst.max(off(&found));
    }
    println!("one size {of_one_size}, known {known}: {worst:.2} deviations at most");
    assert!(worst < 4.5, "{worst}");
    Ok(())
}

/// Noise of one size swamps the motor where inertia holds it, and both points between their modes.
#[test]
fn errors_of_one_size_are_seen_as_such() {
    for known in [true, false] {
        sound(SOUND, true, known, &[]).unwrap();
        sound(SOUND, false, known, &[]).unwrap();
    }
}

#[test]
fn damping_within_the_beam_is_in_viscous_frictions_interval() {
    for known in [true, false] {
        sound(Truth { within: 1.0, ..SOUND }, false, known, &[]).unwrap();
    }
}

#[test]
fn a_late_motor_is_turned_back() {
    for known in [true, false] {
        let truth = Truth { motor_delay_s: 1e-3, ..SOUND };
        sound(truth, false, known, &["equivalent-delay"]).unwrap();
        let noise = Noise { size: 0.02, of_one_size: false, known, seed: 1 };
        let late = equivalent(&data(truth, &noise), None).unwrap().arm.unwrap().delay_s.unwrap();
        assert!((late.value - 1e-3).abs() < 4.0 * late.std && late.std < 1e-4, "{late:?}");
    }
}

#[test]
fn friction_left_in_is_told_of() {
    for (known, seed) in [(true, 0), (true, 1), (false, 0), (false, 1)] {
        let noise = Noise { size: 0.02, of_one_size: false, known, seed };
        let truth = Truth { friction: 0.1, ..SOUND };
        let found = equivalent(&data(truth, &noise), None).unwrap();
        let warned = warnings(&found);
        println!("{warned:?}, {:.1} deviations", off(&found));
        assert!(warned.contains(&"equivalent-motor-friction"), "{:?}", found.findings);
    }
}

/// What is no angle per command does not pass, standard errors or none.
#[test]
fn what_is_no_motors_response_is_told_of() {
    type Made = fn(&[Response], &[f64]) -> Vec<Complex64>;
    let cases: [(&str, Made); 4] = [
        ("torque per angle", |all, _| all.iter().map(|r| 1.0 / r.value).collect()),
        ("velocity", |all, omega| {
            let each = all.iter().zip(omega);
            each.map(|(r, w)| r.value * Complex64::new(0.0, *w)).collect()
        }),
        ("rows out of place", |all, _| {
            (0..all.len()).map(|i| all[(37 * i + 11) % all.len()].value).collect()
        }),
        ("degrees of a phase turned", |all, _| all.iter().map(|r| r.value.conj()).collect()),
    ];
    for known in [true, false] {
        for (name, made) in cases {
            let noise = Noise { size: 0.01, of_one_size: false, known, seed: 3 };
            let mut data = data(SOUND, &noise);
            let motor = data.motor.as_mut().unwrap();
            let values = made(&motor.response, &data.omega_rad_s);
            for (response, value) in motor.response.iter_mut().zip(values) {
                let share = response.std / response.value.norm();
                *response = Response { value, std: share * value.norm() };
            }
            match equivalent(&data, None) {
                Ok(found) => {
                    println!("{name}, known {known}: {:?}", warnings(&found));
                    assert!(!warnings(&found).is_empty(), "{name}, known {known}");
                }
                Err(refused) => println!("{name}, known {known}: {refused}"),
            }
        }
    }
}
