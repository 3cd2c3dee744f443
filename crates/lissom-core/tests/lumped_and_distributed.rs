//! `docs/src/theory/lumped-and-distributed.md`: orders of convergence, and what a tip's load does to zeros.

#![expect(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::PI;

use lissom::beam::{Base, DistributedBeam, Payload, Piece, RootClass, Zeros, class, zero_shift};
use lissom_testmodels::limit::{
    LumpedArm, Masses, Properties, cantilever, hub_and_tip_mass, order, stepped,
};
use num_complex::Complex64;
use proptest::prelude::*;

/// Numbers of masses that orders are fitted to.
const COUNTS: [usize; 3] = [64, 128, 256];
/// Fitted orders, absolutely.
const ORDER: f64 = 0.01;
/// Constants in front of n⁻², relatively, at the last of [`COUNTS`].
const CONSTANT: f64 = 3e-3;
/// Zeros that are the same zero, relatively.
const SAME: f64 = 1e-9;

/// Errors of each estimate over [`COUNTS`].
fn errors(beam: &DistributedBeam, masses: Masses) -> Vec<Vec<f64>> {
    let exact = Properties::of_distributed(beam);
    let by_count = COUNTS.map(|n| {
        Properties::of_lumped(&LumpedArm::new(beam, n, masses).unwrap(), &exact).errors(&exact)
    });
    (0..by_count[0].len()).map(|row| by_count.iter().map(|e| e[row]).collect()).collect()
}

#[test]
fn half_masses_at_both_ends_give_order_two() {
    for beam in [cantilever(), hub_and_tip_mass(), stepped()] {
        for (row, errors) in errors(&beam, Masses::BothEnds).iter().enumerate() {
            let order = order(&COUNTS, errors);
            assert!((order - 2.0).abs() < ORDER, "estimate {row}: {order}");
        }
    }
}

/// The constants of the uniform beam: −φ′/(3φ) at the tip for a frequency of the mode φ, κ·tanh κ/3
/// for the zero s = 2κ², a half for the inertia.
#[test]
fn the_error_is_that_of_the_trapezoid_rule() {
    let found = errors(&cantilever(), Masses::BothEnds);
    let at_last = |row: usize| found[row][2] * (COUNTS[2] as f64).powi(2);
    let exact = Properties::of_distributed(&cantilever());
    for k in 0..3 {
        let l = exact.frequencies_rad_s[k].sqrt();
        let (ch, sh, c, s) = (l.cosh(), l.sinh(), l.cos(), l.sin());
        let sigma = (ch + c) / (sh + s);
        let expected = -l * (sh + s - sigma * (ch - c)) / (ch - c - sigma * (sh - s)) / 3.0;
        assert!((at_last(k) / expected - 1.0).abs() < CONSTANT, "{} {expected}", at_last(k));
        let kappa = (0.5 * exact.zeros_per_s[k]).sqrt();
        assert!((kappa.tan() + kappa.tanh()).abs() < 1e-9);
        let expected = kappa * kappa.tanh() / 3.0;
        assert!((at_last(3 + k) / expected - 1.0).abs() < CONSTANT, "{expected}");
    }
    assert!((at_last(9) - 0.5).abs() < 1e-9);
}

/// Whole masses at outer ends: half a span's mass too much at the tip, which no zero feels.
#[test]
fn whole_masses_at_outer_ends_give_order_one_but_for_zeros() {
    let found = errors(&cantilever(), Masses::OuterEnds);
    for (row, errors) in found.iter().enumerate() {
        let expected = if (3..6).contains(&row) { 2.0 } else { 1.0 };
        let order = order(&COUNTS, errors);
        assert!((order - expected).abs() < 0.03, "estimate {row}: {order}");
    }
    for frequency in &found[..3] {
        assert!((frequency[2] * COUNTS[2] as f64 + 1.0).abs() < 0.01);
    }
    let zeros = |masses| {
        let arm = LumpedArm::new(&cantilever(), 24, masses).unwrap();
        arm.beam.zeros(23).unwrap()
    };
    let shift = zero_shift(&zeros(Masses::BothEnds), &zeros(Masses::OuterEnds));
    assert!(shift < 1e-12, "{shift}");
    // Where mass per length steps, the outer ends put a wrong mass within the beam too.
    let first = order(&COUNTS, &errors(&stepped(), Masses::OuterEnds)[3]);
    assert!((first - 1.0).abs() < 0.1, "{first}");
}

/// On a hub, the half mass at the clamp is the torque's only error of order one.
#[test]
fn the_half_mass_at_the_clamp_turns_with_the_hub() {
    let beam = hub_and_tip_mass();
    let lost = COUNTS.map(|n| beam.lumped(n).unwrap().inertia_kg_m2() - beam.inertia_kg_m2());
    for (n, lost) in COUNTS.into_iter().zip(lost) {
        let n = n as f64;
        assert!((lost - (-0.01 / (2.0 * n) + 1.0 / (6.0 * n * n))).abs() < 1e-12, "{lost}");
    }
}

fn below(beam: &DistributedBeam, payload: Payload, point: f64, omega: f64) -> Zeros {
    let zeros = beam.clone().with_payload(payload).unwrap().zeros_below(point, omega).unwrap();
    assert_eq!(zeros.missing, 0);
    zeros
}

fn count(zeros: &Zeros, wanted: RootClass) -> usize {
    zeros.z.iter().filter(|z| class(**z) == wanted).count()
}

/// Closed forms of the uniform beam: tan κ = −tanh κ without rotary inertia, sin κ = 0 with an
/// infinite one, s = 2κ²; the pair tends to √(2EI/(J·L)).
#[test]
fn rotary_inertia_moves_zeros_between_two_limits() {
    let heavy = Payload { inertia_kg_m2: 1e3, ..Payload::default() };
    let zeros = below(&cantilever(), heavy, 1.0, 200.0);
    let pair = zeros.z[0].re;
    assert!((pair * 1e3 + 2.0).abs() < 1e-3, "{pair}");
    for (k, z) in zeros.z[1..].iter().enumerate() {
        let limit = 2.0 * ((k + 1) as f64 * PI).powi(2);
        assert!((z.re.sqrt() / limit - 1.0).abs() < 1e-5, "{z}");
    }
    // The pair comes from infinity as J^(−2/3).
    let light = below(&cantilever(), Payload { inertia_kg_m2: 1e-4, ..heavy }, 1.0, 500.0);
    let pair = light.z.iter().find(|z| z.re < 0.0).unwrap().re;
    assert!(((-pair).sqrt() * 1e-4_f64.powf(2.0 / 3.0) - 1.0).abs() < 1e-3, "{pair}");
    // A lumped arm's zeros tend to these with order 2 as well, the pair too.
    let load = Payload { mass_kg: 0.5, inertia_kg_m2: 0.01, offset_m: 0.0 };
    let beam = cantilever().with_payload(load).unwrap();
    let exact = beam.zeros_below(1.0, 100.0).unwrap();
    let error = |n: usize| {
        let arm = beam.lumped(n).unwrap();
        let zeros = arm.zeros(n - 1).unwrap();
        let found = |k: usize| zeros.z[k].re.abs().sqrt();
        (0..3).map(move |k| found(k) / exact.z[k].re.abs().sqrt() - 1.0).collect::<Vec<_>>()
    };
    let (coarse, fine) = (error.clone()(16), error(64));
    for (c, f) in coarse.iter().zip(&fine) {
        let order = order(&[16, 64], &[*c, *f]);
        assert!((order - 2.0).abs() < 0.1, "{order}: {c:e} {f:e}");
    }
}

/// A load with its centre towards the motor: complex zeros at a point within the beam.
#[test]
fn a_negative_offset_can_give_zeros_of_class_c() {
    let load = Payload { mass_kg: 1.0, inertia_kg_m2: 0.0, offset_m: -0.2 };
    let zeros = below(&cantilever(), load, 0.8, 50.0);
    assert_eq!(count(&zeros, RootClass::Quadruple), 2);
    let s = zeros.z[1].sqrt();
    assert!((s - Complex64::new(3.229, 21.485)).norm() < 1e-3, "{s}");
    // The same load the other way round, and the same point: classes a and b alone.
    let outwards = Payload { offset_m: 0.2, ..load };
    assert_eq!(count(&below(&cantilever(), outwards, 0.8, 50.0), RootClass::Quadruple), 0);
    assert_eq!(count(&below(&cantilever(), load, 1.0, 200.0), RootClass::Quadruple), 0);
}

fn beam() -> impl Strategy<Value = DistributedBeam> {
    let decade = || (-0.5..0.5_f64).prop_map(|e| 10f64.powf(e));
    let mass = prop_oneof![Just(0.0), decade()];
    let piece = (decade(), decade(), decade(), mass).prop_map(|(l, ei, mu, m)| Piece {
        length_m: l,
        flexural_rigidity_n_m2: ei,
        mass_per_length_kg_per_m: mu,
        end_mass_kg: m,
        end_damping_n_s_per_m: 0.0,
    });
    (prop::collection::vec(piece, 1..4), prop_oneof![Just(0.0), 0.01..2.0]).prop_map(
        |(pieces, hub)| DistributedBeam::new(&pieces).unwrap().with_hub_radius(hub).unwrap(),
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// A point mass at the tip moves poles and torque, no zero; zeros are of class b. The torque
    /// follows `C_m = C_0 + m·s²·L²·G_0·G_m`, so at a zero it is the same for every m.
    #[test]
    fn zeros_do_not_feel_a_point_mass(beam in beam(), mass_kg in 0.01..50.0_f64) {
        let l = beam.length_m();
        let omega = beam.frequencies_rad_s(Base::Clamped, 5);
        let load = Payload { mass_kg, ..Payload::default() };
        let loaded = beam.clone().with_payload(load).unwrap();
        let before = below(&beam, Payload::default(), l, omega[4]);
        let after = below(&beam, load, l, omega[4]);
        prop_assert!(before.z.len() > 1 && zero_shift(&before, &after) < SAME, "{before:?} {after:?}");
        prop_assert_eq!(count(&before, RootClass::Real), before.z.len());
        let lower = loaded.frequencies_rad_s(Base::Clamped, 5);
        prop_assert!(omega.iter().zip(&lower).all(|(a, b)| b < a));
        let tip = beam.pieces().len() - 1;
        for s in [Complex64::new(0.0, 0.7 * omega[0]), Complex64::new(0.3, 0.4) * omega[1]] {
            let (free, held) = (beam.response(s), loaded.response(s));
            let product = free.angles[tip] * held.angles[tip];
            let expected = free.coupling_nm_per_rad + s * s * product * (mass_kg * l * l);
            let error = (held.coupling_nm_per_rad - expected).norm();
            prop_assert!(error < SAME * (expected.norm() + free.coupling_nm_per_rad.norm()));
        }
        for z in &before.z {
            let torque = |b: &DistributedBeam| b.response(z.sqrt()).coupling_nm_per_rad.re;
            prop_assert!((torque(&loaded) / torque(&beam) - 1.0).abs() < SAME);
        }
    }

    /// Class c takes a load whose centre lies towards the motor, and never shows at the tip.
    #[test]
    fn where_class_c_is_not(beam in beam(), n in 2..7_usize, m in 0.1..10.0_f64, e in -0.6..0.6_f64) {
        let offset_m = e * beam.length_m();
        let inertia_kg_m2 = 0.01 * m;
        let load = Payload { mass_kg: m, inertia_kg_m2, offset_m };
        let arm = beam.lumped(n).unwrap().with_payload(load);
        // Offsets beyond about half the length are refused.
        prop_assume!(arm.is_ok());
        let arm = arm.unwrap();
        let tip = arm.len() - 1;
        for i in if e < 0.0 { tip..=tip } else { 0..=tip } {
            let zeros = arm.zeros(i).unwrap();
            prop_assert_eq!((zeros.missing, count(&zeros, RootClass::Quadruple)), (0, 0));
        }
    }

    /// A mass at the very point where the angle is taken moves no zero there.
    #[test]
    fn zeros_do_not_feel_a_mass_at_their_point(beam in beam(), mass_kg in 0.01..50.0_f64) {
        let point = beam.position_m()[0];
        let beyond = beam.frequencies_rad_s(Base::Clamped, 4)[3];
        let mut pieces = beam.pieces().to_vec();
        pieces[0].end_mass_kg += mass_kg;
        let other = DistributedBeam::new(&pieces).unwrap();
        let other = other.with_hub_radius(beam.hub_radius_m()).unwrap();
        let zeros = [&beam, &other].map(|b| b.zeros_below(point, beyond).unwrap());
        prop_assert!(zero_shift(&zeros[0], &zeros[1]) < SAME, "{zeros:?}");
    }

    /// With rotary inertia zeros know J + m·e² and m·e alone. Without an offset, one pair comes in on
    /// the imaginary axis, and each zero on the real axis goes outwards.
    #[test]
    fn what_zeros_feel_of_a_body(beam in beam(), share in 0.05..5.0_f64, e in 0.02..0.5_f64) {
        let l = beam.length_m();
        let beyond = beam.frequencies_rad_s(Base::Clamped, 5)[4];
        let inertia = share * beam.inertia_kg_m2();
        let body = |mass_kg, inertia_kg_m2, offset_m| Payload { mass_kg, inertia_kg_m2, offset_m };
        let turning = below(&beam, body(0.0, inertia, 0.0), l, beyond);
        let heavy = below(&beam, body(7.0, inertia, 0.0), l, beyond);
        prop_assert!(zero_shift(&turning, &heavy) < SAME);
        prop_assert_eq!(count(&turning, RootClass::Imaginary), 1);
        prop_assert_eq!(count(&turning, RootClass::Quadruple), 0);
        let real = |zeros: &Zeros| -> Vec<f64> {
            zeros.z.iter().map(|z| z.re).filter(|z| *z > 0.0).collect()
        };
        let free = below(&beam, Payload::default(), l, beyond);
        prop_assert!(real(&turning).iter().zip(real(&free)).all(|(with, without)| *with > without));
        // Twice the mass at half the offset, J made up: the same first and second moment.
        let (m, e) = (0.5, e * l);
        for e in [e, -e] {
            let one = below(&beam, body(m, inertia, e), l, beyond);
            prop_assert_eq!(count(&one, RootClass::Quadruple), 0);
            let made_up = inertia + 0.5 * m * e * e;
            let other = below(&beam, body(2.0 * m, made_up, 0.5 * e), l, beyond);
            prop_assert!(zero_shift(&one, &other) < 1e-8, "{one:?} {other:?}");
        }
    }
}
