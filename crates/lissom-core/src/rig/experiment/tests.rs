use std::f64::consts::{PI, SQRT_2, TAU};

use super::*;
use crate::beam::{LumpedBeam, Span};
use crate::drive::{Coulomb, Motor};

/// Roundings of a sum of some tens of sines of size one.
const ROUNDING: f64 = 1e-12;

/// Amplitude of line h over one period of `omega`, by a plain sum.
fn line(value: impl Fn(f64) -> f64, omega: f64, h: u32) -> f64 {
    let n = 4096;
    let (mut re, mut im) = (0.0, 0.0);
    for k in 0..n {
        let x = TAU * f64::from(k) / f64::from(n);
        let v = value(x / omega);
        re += v * (f64::from(h) * x).cos();
        im += v * (f64::from(h) * x).sin();
    }
    2.0 / f64::from(n) * f64::hypot(re, im)
}

#[test]
fn a_multisine_has_flat_odd_lines_alone() {
    let lines = [1, 3, 7, 9, 21, 63];
    let m = Multisine::new(0.7, &lines, 0.5, 11).unwrap().with_crest(1.6).unwrap();
    for h in 0..130 {
        let expected = if lines.contains(&h) { m.line_amplitude() } else { 0.0 };
        let found = line(|t| m.value(t), 0.7, h);
        assert!((found - expected).abs() < ROUNDING, "line {h}: {found}, {expected}");
    }
    assert!((m.highest_rad_s() - 44.1).abs() < ROUNDING);
    // Half a period on it is its own negative.
    for t in [0.1, 1.7, 3.3] {
        assert!((m.value(t) + m.value(t + PI / 0.7)).abs() < ROUNDING);
    }
}

#[test]
fn its_peak_is_the_amplitude_and_its_crest_the_peak_over_rms() {
    for seed in 0..5 {
        let m = Multisine::odd(1.0, 31.0, 0.8, seed).unwrap();
        let n = 200_000;
        let value = |k: u32| m.value(TAU * f64::from(k) / f64::from(n));
        let peak = (0..n).map(|k| value(k).abs()).fold(0.0, f64::max);
        let rms = ((0..n).map(|k| value(k).powi(2)).sum::<f64>() / f64::from(n)).sqrt();
        // Between points of this grid the peak is at most (31·π/200 000)²/2 = 1.2e-7 higher.
        assert!((peak / 0.8 - 1.0).abs() < 2e-7, "{peak}");
        assert!((m.crest() / (peak / rms) - 1.0).abs() < 2e-7, "{}", m.crest());
    }
}

#[test]
fn the_crest_goal_is_reached_or_what_was_is_said() {
    for seed in 0..4 {
        let random = Multisine::odd(1.0, 99.0, 1.0, seed).unwrap();
        let low = random.clone().with_crest(1.6).unwrap();
        assert!(random.crest() > 1.9 && low.crest() <= 1.6, "{} {}", random.crest(), low.crest());
        let rms = low.line_amplitude() * 25f64.sqrt();
        assert!((1.0 / rms / low.crest() - 1.0).abs() < ROUNDING);
        // No signal has a crest factor below one.
        let best = random.with_crest(0.5).unwrap();
        assert!(best.crest() > 1.0 && best.crest() <= low.crest());
    }
    let one = Multisine::new(2.0, &[1], 0.3, 5).unwrap();
    assert!(
        (one.crest() - SQRT_2).abs() < ROUNDING && (one.line_amplitude() - 0.3).abs() < ROUNDING
    );
}

#[test]
fn a_seed_decides_the_phases() {
    let odd = |seed| Multisine::odd(1.0, 20.0, 1.0, seed).unwrap();
    assert_eq!(odd(3), odd(3));
    assert_ne!(odd(3), odd(4));
    assert_eq!(odd(3).with_crest(1.7), odd(3).with_crest(1.7));
}

#[test]
fn lines_that_are_none() {
    let new = |lines: &[u32]| Multisine::new(1.0, lines, 1.0, 0);
    assert_eq!(new(&[]), Err(RigError::NoLines));
    for (lines, found) in [(&[1, 2][..], 2), (&[3, 3], 3), (&[5, 3], 3), (&[1, 70_001], 70_001)] {
        assert!(matches!(new(lines), Err(RigError::Line { found: f, .. }) if f == found));
    }
    assert_eq!(Multisine::odd(2.0, 1.0, 1.0, 0), Err(RigError::NoLines));
    assert!(matches!(Multisine::odd(1e-6, 1.0, 1.0, 0), Err(RigError::Line { .. })));
    assert!(matches!(new(&[1]).unwrap().with_crest(f64::NAN), Err(RigError::NotPositive { .. })));
}

/// Difference quotient of the phase \[rad/s\].
fn frequency(chirp: &Chirp, t: f64) -> f64 {
    let h = 1e-5;
    (chirp.phase_rad(t + h) - chirp.phase_rad(t - h)) / (2.0 * h)
}

#[test]
fn a_chirp_goes_from_one_frequency_to_the_other_and_stays() {
    for (sweep, middle) in [(Sweep::Linear, 10.5), (Sweep::Logarithmic, 20f64.sqrt())] {
        for (from, to) in [(1.0, 20.0), (20.0, 1.0)] {
            let chirp = Chirp::new(sweep, (from, to), 0.5, 8.0).unwrap();
            for (t, expected) in [(1e-5, from), (4.0, middle), (8.0 - 1e-5, to), (9.0, to)] {
                // The quotient's own rounding and curvature.
                let error = (frequency(&chirp, t) / expected - 1.0).abs();
                assert!(error < 2e-4, "{sweep:?} {t}: {error}");
            }
            assert!((chirp.value(3.0) - 0.5 * chirp.phase_rad(3.0).sin()).abs() < ROUNDING);
            assert!((chirp.highest_rad_s() - 20.0).abs() < ROUNDING);
        }
    }
    let level = Chirp::new(Sweep::Logarithmic, (3.0, 3.0), 1.0, 2.0).unwrap();
    assert!((level.phase_rad(1.3) - 3.9).abs() < ROUNDING);
    for (range, amplitude, duration) in [
        ((0.0, 1.0), 1.0, 1.0),
        ((1.0, -1.0), 1.0, 1.0),
        ((1.0, 2.0), 0.0, 1.0),
        ((1.0, 2.0), 1.0, 0.0),
    ] {
        let chirp = Chirp::new(Sweep::Linear, range, amplitude, duration);
        assert!(matches!(chirp, Err(RigError::NotPositive { .. })));
    }
}

#[test]
fn a_square_wave_turns_at_half_periods() {
    // 1000 samples of 3 ms a period: the edges fall on samples, whatever the product rounds to.
    let square = Square::new(TAU / 3.0, 0.4).unwrap();
    for k in 0..5000 {
        let expected = if (k / 500) % 2 == 0 { 0.4 } else { -0.4 };
        let found = square.value(f64::from(k) * 0.003);
        assert!((found - expected).abs() < ROUNDING, "sample {k}");
    }
}

#[test]
fn a_table_holds_or_goes_straight() {
    let table = |hold| Table::new(vec![1.0, 2.0, 4.0], vec![5.0, -1.0, 3.0], hold).unwrap();
    let (zero, linear) = (table(TableHold::Zero), table(TableHold::Linear));
    for (t, held, straight) in [
        (0.0, 5.0, 5.0),
        (1.0, 5.0, 5.0),
        (1.5, 5.0, 2.0),
        (2.0, -1.0, -1.0),
        (3.0, -1.0, 1.0),
        (9.0, 3.0, 3.0),
    ] {
        assert!((zero.value(t) - held).abs() < ROUNDING, "{t}");
        assert!((linear.value(t) - straight).abs() < ROUNDING, "{t}");
    }
    assert!((zero.amplitude() - 5.0).abs() < ROUNDING);
}

#[test]
fn tables_that_are_none() {
    let new = |t: &[f64], v: &[f64]| Table::new(t.to_vec(), v.to_vec(), TableHold::Zero);
    assert_eq!(new(&[], &[]), Err(RigError::EmptyTable));
    assert_eq!(new(&[0.0], &[]), Err(RigError::TableLength { times: 1, values: 0 }));
    assert_eq!(
        new(&[0.0, 1.0, 1.0], &[0.0; 3]),
        Err(RigError::TableOrder { row: 2, before_s: 1.0, after_s: 1.0 })
    );
    assert!(matches!(
        new(&[0.0, 1.0], &[0.0, f64::NAN]),
        Err(RigError::TableNotFinite { row: 1, .. })
    ));
    assert!(matches!(new(&[f64::INFINITY], &[0.0]), Err(RigError::TableNotFinite { row: 0, .. })));
}

#[test]
fn references_that_are_none() {
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(Reference::sine(bad, 1.0), Err(RigError::NotPositive { .. })));
        assert!(matches!(Reference::sine(1.0, bad), Err(RigError::NotPositive { .. })));
        assert!(matches!(Reference::square(bad, 1.0), Err(RigError::NotPositive { .. })));
        assert!(matches!(Experiment::sine(1.0, 1.0, bad), Err(RigError::NotPositive { .. })));
    }
    assert!(matches!(Reference::ramp(f64::NAN), Err(RigError::NotFinite { .. })));
    assert!(matches!(Reference::hold(f64::INFINITY), Err(RigError::NotFinite { .. })));
    let sine = Experiment::sine(1.0, 1.0, 1.0).unwrap();
    for settle in [
        Settle::Wait { wait_s: -1.0 },
        Settle::Detected { tolerance: 0.0, longest_s: 1.0 },
        Settle::Detected { tolerance: 1e-3, longest_s: f64::NAN },
    ] {
        assert!(sine.clone().settling(settle).check().is_err(), "{settle:?}");
    }
}

fn arm(spans: &[Span]) -> Arm {
    let beam = LumpedBeam::new(spans).unwrap();
    Arm::new(beam, Motor::new(1e-3, 0.0, 1.0).unwrap(), Coulomb::symmetric(0.1).unwrap()).unwrap()
}

#[test]
fn a_pushed_beam_is_bent_like_a_cantilever() {
    // y(x) = F·x²·(3·L − x)/(6·EI), θ = y/x, whatever the masses.
    let (ei, force, length) = (0.3, 0.7, 0.6);
    let span = |length_m, mass_kg| Span {
        length_m,
        flexural_rigidity_n_m2: ei,
        mass_kg,
        damping_n_s_per_m: 0.2,
    };
    for lengths in [&[0.6][..], &[0.1, 0.5], &[0.2, 0.1, 0.3]] {
        let spans: Vec<Span> =
            lengths.iter().enumerate().map(|(k, l)| span(*l, 0.1 + k as f64)).collect();
        let arm = arm(&spans);
        let state = Start::Deflected { tip_force_n: force }.state(&arm).unwrap();
        assert!(state[0].abs() + state[1].abs() < f64::MIN_POSITIVE);
        for (x, q) in arm.beam().position_m().iter().zip(&state[2..]) {
            let expected = force * x * (3.0 * length - x) / (6.0 * ei);
            assert!((q / expected - 1.0).abs() < ROUNDING, "{q}, {expected}");
        }
        // The coupling torque is the force's moment.
        assert!((arm.coupling_torque(&state) + force * length).abs() < ROUNDING);
        let far = Start::Deflected { tip_force_n: f64::MAX }.state(&arm);
        assert_eq!(far, Err(RigError::Deflection { tip_force_n: f64::MAX }));
        let bad = Start::Deflected { tip_force_n: f64::NAN }.state(&arm);
        assert!(matches!(bad, Err(RigError::NotFinite { .. })));
    }
}
