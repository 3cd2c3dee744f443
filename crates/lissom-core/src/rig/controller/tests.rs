use super::*;
use crate::rig::{Quantiser, RigError};

const T: f64 = 0.003;

fn at(reference_rad: f64, motor_rad: f64, limit_a: f64) -> Sensed<'static> {
    Sensed { time_s: 0.0, period_s: T, reference_rad, motor_rad, tips_rad: &[], limit_a }
}

fn outputs(law: &mut dyn Controller, errors: &[f64]) -> Vec<f64> {
    errors.iter().map(|e| law.current_a(&at(*e, 0.0, f64::INFINITY))).collect()
}

#[track_caller]
fn near(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len());
    for (f, e) in found.iter().zip(expected) {
        assert!((f - e).abs() <= 1e-12 * e.abs().max(1.0), "{found:?}, by hand {expected:?}");
    }
}

#[test]
fn p_and_pd_by_hand() {
    let errors = [0.1, 0.25, -0.05];
    near(&outputs(&mut Proportional::new(8.0).unwrap(), &errors), &[0.8, 2.0, -0.4]);
    let mut pd = Pd::new(8.0, 0.3).unwrap();
    let expected = [0.8, 2.0 + 0.3 * 0.15 / T, -0.4 - 0.3 * 0.3 / T];
    near(&outputs(&mut pd, &errors), &expected);
    pd.reset();
    near(&outputs(&mut pd, &errors), &expected);
}

#[test]
fn the_filtered_derivative_is_the_backward_recursion() {
    let (kd, tau) = (0.3, 0.006);
    let mut pd = Pd::new(0.0, kd).unwrap().with_filter(tau).unwrap();
    // τ = 2T: d = 2/3·d + k_d·Δe/(3T).
    let one = kd * 0.2 / (3.0 * T);
    near(&outputs(&mut pd, &[0.0, 0.2, 0.2, 0.2]), &[0.0, one, one * 2.0 / 3.0, one * 4.0 / 9.0]);
    // With no filter time it is the plain difference.
    let errors = [0.1, 0.3, 0.2, 0.7];
    let mut plain = Pd::new(1.0, kd).unwrap();
    let mut zero = plain.with_filter(0.0).unwrap();
    near(&outputs(&mut zero, &errors), &outputs(&mut plain, &errors));
}

#[test]
fn the_integral_sums_and_does_not_wind_up() {
    let mut pid = Pid::new(Pd::new(2.0, 0.0).unwrap(), 10.0).unwrap();
    near(&outputs(&mut pid, &[0.5, 0.5, -0.1]), &[1.015, 1.03, -0.2 + 0.027]);
    pid.reset();
    // 1 A of limit, error 1: P alone is beyond it, so the integral stands.
    for _ in 0..1000 {
        pid.current_a(&at(1.0, 0.0, 1.0));
    }
    assert!(pid.integral_a().abs() < 1e-12);
    // An error that drives it back in is summed, and so is one within the limit.
    pid.current_a(&at(0.2, 0.0, 1.0));
    assert!((pid.integral_a() - 10.0 * T * 0.2).abs() < 1e-12);
}

#[test]
fn gains_must_not_be_negative() {
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        let pd = Pd::new(1.0, 1.0).unwrap();
        assert!(matches!(Proportional::new(bad), Err(RigError::Negative { .. })));
        assert!(matches!(Pd::new(bad, 0.0), Err(RigError::Negative { .. })));
        assert!(matches!(Pd::new(0.0, bad), Err(RigError::Negative { .. })));
        assert!(matches!(pd.with_filter(bad), Err(RigError::Negative { .. })));
        assert!(matches!(Pid::new(pd, bad), Err(RigError::Negative { .. })));
    }
}

#[test]
fn memory_is_the_slowest_time_constant() {
    let pd = Pd::new(8.0, 0.2).unwrap();
    let laws: [(ControlLaw, f64); 4] = [
        (Proportional::new(3.0).unwrap().into(), 0.0),
        (pd.into(), 0.025),
        (pd.with_filter(0.1).unwrap().into(), 0.1),
        (Pid::new(pd, 0.5).unwrap().into(), 16.0),
    ];
    for (law, memory_s) in laws {
        assert!((law.memory_s() - memory_s).abs() < 1e-12, "{law:?}");
    }
}

/// The report's boards: 12 bits over a turn, 12 bits over ±5 A.
fn boards() -> (Quantiser, Quantiser) {
    (Quantiser::new(12, std::f64::consts::TAU).unwrap(), Quantiser::new(12, 10.0).unwrap())
}

fn integer(word: Word, binary_point: u32) -> IntegerPd {
    let (input, output) = boards();
    IntegerPd::new(&Pd::new(8.0, 0.2).unwrap(), T, input, output, word, binary_point).unwrap()
}

#[test]
fn integer_gains_are_the_nearest() {
    // s = (2π/4096)/(10/4096) = 0.628 318 5; ·8·16 = 80.42; ·0.2/0.003·16 = 670.2.
    assert_eq!(integer(Word::Short, 4).gains(), (80, 670));
    assert_eq!(integer(Word::Long, 0).gains(), (5, 42));
}

/// The law again, in integers that never overflow, with the bounds written out; for counts that fit
/// into 16 bits. `>>` floors, as Python's does.
fn by_hand(
    (p, d): (i128, i128),
    b: u32,
    (low, high): (i128, i128),
    counts: &[(i128, i128)],
) -> Vec<i128> {
    let sat = |x: i128| {
        if x < low {
            low
        } else if x > high {
            high
        } else {
            x
        }
    };
    let mut before = None;
    let mut outputs = Vec::new();
    for (reference, motor) in counts {
        let e = sat(reference - motor);
        let change = sat(e - before.unwrap_or(e));
        before = Some(e);
        let sum = sat(sat(p * e) + sat(d * change));
        outputs.push(sum.div_euclid(1 << b));
    }
    outputs
}

#[test]
fn integer_pd_equals_integers_written_out() {
    // A linear congruential walk through all sizes, with jumps that saturate.
    let mut walk = 12_345_u64;
    let mut next = |span: i64| {
        walk = walk.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        i64::from((walk >> 33) as u32) % span
    };
    let counts: Vec<(i64, i64)> = (0..5000)
        .map(|k| {
            let span = [3, 50, 2048, 32_767][k % 4];
            (next(span), -next(span))
        })
        .collect();
    let wide: Vec<(i128, i128)> =
        counts.iter().map(|(r, m)| (i128::from(*r), i128::from(*m))).collect();
    for (word, point, bounds) in [
        (Word::Short, 4, (-32_768, 32_767)),
        (Word::Short, 0, (-32_768, 32_767)),
        (Word::Long, 4, (-2_147_483_648, 2_147_483_647)),
        (Word::Long, 12, (-2_147_483_648, 2_147_483_647)),
    ] {
        let mut law = integer(word, point);
        let (p, d) = law.gains();
        let expected = by_hand((i128::from(p), i128::from(d)), point, bounds, &wide);
        let found: Vec<i128> =
            counts.iter().map(|(r, m)| i128::from(law.output_count(*r, *m))).collect();
        assert_eq!(found, expected, "{word:?}, {point}");
    }
}

#[test]
fn short_products_saturate_and_shifts_cut_towards_minus_infinity() {
    let mut law = integer(Word::Short, 4);
    // 80·(−1) = −80; −80/16 = −5 exactly. 80·500 = 40 000 saturates at 32 767; >> 4 is 2047.
    assert_eq!(law.output_count(-1, 0), -5);
    law.reset();
    assert_eq!(law.output_count(500, 0), 2047);
    let mut law = integer(Word::Short, 0);
    assert_eq!(law.output_count(3, 0), 15);
    let pd = Pd::new(8.0, 0.0).unwrap();
    let (input, output) = boards();
    let mut fine = IntegerPd::new(&pd, T, input, output, Word::Short, 5).unwrap();
    assert_eq!(fine.gains(), (161, 0));
    // 161/32 = 5.03: +1 gives 5, −1 gives −6.
    assert_eq!((fine.output_count(1, 0), fine.output_count(-1, 0)), (5, -6));
}

#[test]
fn in_amperes_it_is_near_the_real_pd() {
    let (input, output) = boards();
    let mut law = integer(Word::Long, 8);
    let mut real = Pd::new(8.0, 0.2).unwrap();
    // A slow sine with sensor steps: gains are right to 0.5/2574, the shift loses one D/A count.
    for k in 0..2000 {
        let reference = 0.02 * (0.01 * f64::from(k)).sin();
        let (r, y) = (input.read(reference), input.read(0.5 * reference));
        let demand = real.current_a(&at(r, y, f64::INFINITY));
        let found = law.current_a(&at(reference, y, f64::INFINITY));
        let gain = 0.5 / 1287.0 * demand.abs() + 0.5 / 10_724.0 * 5.0;
        assert!((found - demand).abs() <= 2.0 * output.step() + gain, "{found} {demand}");
    }
    // At its end the D/A holds.
    let found = law.current_a(&at(3.0, -3.0, f64::INFINITY));
    assert!((found - output.ends().1).abs() < 1e-12);
}

#[test]
fn gains_and_points_that_do_not_fit() {
    let (input, output) = boards();
    let new = |pd: Pd, period, word, point| IntegerPd::new(&pd, period, input, output, word, point);
    let pd = Pd::new(8.0, 0.2).unwrap();
    let error = new(pd, T, Word::Short, 12).unwrap_err();
    assert!(
        matches!(error, RigError::Gain { quantity: "the derivative gain", most, .. } if most as i64 == 32_767),
        "{error}"
    );
    let error = new(pd, T, Word::Short, 16).unwrap_err();
    assert_eq!(error, RigError::BinaryPoint { found: 16, most: 15 });
    assert!(matches!(new(pd, 0.0, Word::Long, 4), Err(RigError::NotPositive { .. })));
}
