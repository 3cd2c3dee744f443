//! The rig's laws as property tests: energy, time reversal, superposition, and that whole samples
//! give what the events' polynomials give.

#![expect(clippy::unwrap_used, reason = "tests")]

use lissom::arm::Arm;
use lissom::beam::{Damping, LumpedBeam, Payload, Span};
use lissom::drive::{Coulomb, Motor};
use lissom::rig::{HeldArm, HeldMotion, Hybrid, Mode, Motion};
use proptest::prelude::*;
use proptest::strategy::ValueTree;

fn decade(low: f64, high: f64) -> impl Strategy<Value = f64> {
    (low.ln()..high.ln()).prop_map(f64::exp)
}

fn span() -> impl Strategy<Value = Span> {
    let damping = prop_oneof![Just(0.0), decade(1e-3, 1e-1)];
    (0.1..0.3_f64, decade(0.02, 0.5), decade(0.02, 0.2), damping).prop_map(|(l, ei, m, c)| Span {
        length_m: l,
        flexural_rigidity_n_m2: ei,
        mass_kg: m,
        damping_n_s_per_m: c,
    })
}

/// One to three masses; friction that may differ by direction, viscous or none.
fn arm() -> impl Strategy<Value = Arm> {
    let motor = (decade(2e-4, 5e-3), prop_oneof![Just(0.0), decade(1e-4, 1e-2)]);
    let limit = || decade(5e-3, 0.1);
    (prop::collection::vec(span(), 1..4), motor, limit(), limit()).prop_map(
        |(spans, (inertia, viscous), forward, backward)| {
            let motor = Motor::new(inertia, viscous, 1.0).unwrap();
            let coulomb = Coulomb::by_direction(forward, backward).unwrap();
            Arm::new(LumpedBeam::new(&spans).unwrap(), motor, coulomb).unwrap()
        },
    )
}

/// The same with other damping models and with a payload that turns.
fn loaded_arm() -> impl Strategy<Value = Arm> {
    let damping = prop_oneof![
        Just(None),
        (decade(1e-2, 2.0), decade(1e-6, 1e-3)).prop_map(|(mass_per_s, stiffness_s)| Some(
            Damping::Proportional { mass_per_s, stiffness_s }
        )),
        decade(1e-3, 0.2).prop_map(|ratio| Some(Damping::Modal { ratios: vec![ratio] })),
    ];
    let payload = prop_oneof![
        Just(Payload::default()),
        (decade(1e-2, 0.2), decade(1e-6, 1e-4), 0.0..0.02_f64).prop_map(|(m, j, e)| Payload {
            mass_kg: m,
            inertia_kg_m2: j,
            offset_m: e
        }),
    ];
    (arm(), damping, payload).prop_map(|(arm, damping, payload)| {
        let mut spans = arm.beam().spans().to_vec();
        if damping.is_some() {
            for span in &mut spans {
                span.damping_n_s_per_m = 0.0;
            }
        }
        let beam = LumpedBeam::new(&spans).unwrap().with_payload(payload).unwrap();
        let beam = match damping {
            Some(damping) => beam.with_damping(damping).unwrap(),
            None => beam,
        };
        Arm::new(beam, arm.motor, arm.coulomb).unwrap()
    })
}

/// Torques held for a sample each: below, at and above what friction holds.
fn torques() -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(prop_oneof![Just(0.0), -0.2..0.2_f64, -0.02..0.02_f64], 5..40)
}

/// Kinetic and elastic energy \[J\].
fn stored(arm: &Arm, x: &[f64]) -> f64 {
    let beam = arm.beam().lumped().unwrap();
    let (n, at) = (beam.len(), beam.position_m());
    let stiffness = beam.matrices().unwrap().ei_a;
    let mut sum = arm.motor.inertia_kg_m2() * x[1] * x[1];
    for i in 0..n {
        let speed = at[i] * x[2 + n + i];
        sum += beam.spans()[i].mass_kg * speed * speed;
        // (13): the force on mass i is L_i·Σ EI·A_ij·(θ_j − θ_m).
        let force: f64 = (0..n).map(|j| stiffness[(i, j)] * (x[2 + j] - x[0])).sum();
        sum -= at[i] * at[i] * (x[2 + i] - x[0]) * force;
    }
    0.5 * sum
}

/// What dampers take \[W\].
fn damped(arm: &Arm, x: &[f64]) -> f64 {
    let beam = arm.beam();
    let n = beam.len();
    let at_mass = |i: usize| {
        beam.spans()[i].damping_n_s_per_m * (beam.position_m()[i] * x[2 + n + i]).powi(2)
    };
    arm.motor.viscous_nm_s_per_rad() * x[1] * x[1] + (0..n).map(at_mass).sum::<f64>()
}

/// Gauss-Legendre nodes and weights on \[0, 1\], exact up to degree nine.
const GAUSS: [(f64, f64); 5] = [
    (0.046_910_077_030_668_0, 0.118_463_442_528_094_5),
    (0.230_765_344_947_158_5, 0.239_314_335_249_683_2),
    (0.5, 0.284_444_444_444_444_4),
    (0.769_234_655_052_841_5, 0.239_314_335_249_683_2),
    (0.953_089_922_969_332, 0.118_463_442_528_094_5),
];

/// Energies of a motion from rest under torques held for `sample_s` each: supplied, kept, rubbed
/// off by Coulomb friction, taken by dampers, and the size of what went to and fro \[J\].
fn energies(arm: &Arm, torques: impl IntoIterator<Item = f64>, sample_s: f64) -> [f64; 5] {
    let mut hybrid = Hybrid::at_rest(arm);
    let [mut supplied, mut rubbed, mut dampers, mut turned_over] = [0.0; 4];
    for torque in torques {
        let mut left = sample_s;
        while left > 1e-15 * sample_s {
            // Pieces short enough for the quadrature.
            let before = hybrid.clone();
            let passed = hybrid.advance_to_event(torque, left.min(PIECE_S));
            left -= passed;
            for (node, weight) in GAUSS {
                let mut within = before.clone();
                within.advance(torque, node * passed);
                dampers += weight * passed * damped(arm, within.state());
            }
            let turned = hybrid.state()[0] - before.state()[0];
            supplied += torque * turned;
            rubbed += turned * arm.coulomb.slipping(turned);
            turned_over += (torque * turned).abs();
        }
    }
    [supplied, stored(arm, hybrid.state()), rubbed, dampers, turned_over]
}

/// Length of a piece \[s\]: some hundredths of the fastest oscillation.
const PIECE_S: f64 = 5e-4;

fn energy_balances([supplied, kept, rubbed, dampers, turned_over]: [f64; 5]) -> Result<(), String> {
    let gap = (supplied - kept - rubbed - dampers).abs();
    if kept >= 0.0 && rubbed >= 0.0 && dampers >= 0.0 && gap <= 1e-9 * turned_over {
        Ok(())
    } else {
        Err(format!("{gap:e} of {turned_over:e}"))
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Supplied work = stored energy + what Coulomb friction, the motor's and the masses' dampers
    /// take.
    #[test]
    fn energy_is_kept(arm in arm(), torques in torques(), sample_s in decade(1e-3, 2e-2)) {
        prop_assert_eq!(energy_balances(energies(&arm, torques, sample_s)), Ok(()));
    }

    /// Modes and the events' polynomials give the same motion, whatever the damping and the load,
    /// prepared durations or not.
    #[test]
    fn modes_change_nothing(
        arm in loaded_arm(),
        torques in torques(),
        sample_s in decade(1e-4, 1e-2),
        prepared: bool,
    ) {
        let durations = if prepared { vec![sample_s] } else { vec![] };
        let held = HeldArm::new(&arm, &durations).unwrap();
        prop_assume!(held.is_some());
        let held = held.unwrap();
        let mut fast = HeldMotion::at_rest(&held);
        let mut slow = Hybrid::at_rest(&arm);
        let mut size = 0.0_f64;
        for torque in torques {
            fast.advance(torque, sample_s).unwrap();
            slow.advance(torque, sample_s);
            for (a, b) in fast.state().iter().zip(slow.state()) {
                size = size.max(b.abs());
                prop_assert!((a - b).abs() <= 1e-10 * size, "{a} {b}");
            }
            let tip = arm.dynamics().len() - 1;
            let angle = fast.angle_rad(tip).unwrap();
            prop_assert!((angle - fast.state()[2 + tip]).abs() <= 1e-13 * size);
        }
        prop_assert_eq!((fast.mode(), fast.sticks()), (slow.mode(), slow.sticks()));
        prop_assert!((fast.stuck_s() - slow.stuck_s()).abs() <= 1e-10);
    }

    /// Without friction the motion runs backward as it came.
    #[test]
    fn time_can_be_turned_round(spans in prop::collection::vec(span(), 1..4), torques in torques()) {
        let spans: Vec<Span> =
            spans.into_iter().map(|s| Span { damping_n_s_per_m: 0.0, ..s }).collect();
        let motor = Motor::new(1e-3, 0.0, 1.0).unwrap();
        let beam = LumpedBeam::new(&spans).unwrap();
        let arm = Arm::new(beam, motor, Coulomb::symmetric(0.0).unwrap()).unwrap();
        let mut hybrid = Hybrid::at_rest(&arm);
        let mut size = 1e-3_f64;
        for torque in &torques {
            hybrid.advance(*torque, 0.005);
            size = hybrid.state().iter().fold(size, |m, v| m.max(v.abs()));
        }
        let mut turned = hybrid.state().to_vec();
        let k = spans.len();
        turned[1] *= -1.0;
        turned[2 + k..].iter_mut().for_each(|v| *v *= -1.0);
        let mut back = Hybrid::with_state(&arm, turned);
        torques.iter().rev().for_each(|torque| back.advance(*torque, 0.005));
        prop_assert!(back.state().iter().all(|v| v.abs() <= 1e-10 * size), "{:?}", back.state());
    }

    /// While the joint slips one way, the answer to the sum of two torques is the sum of answers.
    #[test]
    fn slips_add_up(arm in arm(), one in 0.0..0.2_f64, other in 0.0..0.2_f64) {
        let start = || {
            let mut x = vec![0.0; arm.state_len()];
            x[1] = 50.0; // fast enough not to stop
            Hybrid::with_state(&arm, x)
        };
        let [none, a, b, both] = [0.0, one, other, one + other].map(|torque| {
            let mut hybrid = start();
            hybrid.advance(torque, 0.01);
            (hybrid.mode(), hybrid.state().to_vec())
        });
        prop_assume!([&none, &a, &b, &both].iter().all(|m| m.0 == Mode::Forward));
        for i in 0..arm.state_len() {
            let gap = (both.1[i] - a.1[i] - b.1[i] + none.1[i]).abs();
            prop_assert!(gap <= 1e-11 * (1.0 + both.1[i].abs()), "{gap:e}");
        }
    }
}

/// The property above is about modes: nearly every arm has them.
#[test]
fn most_arms_have_modes() {
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let by_modes = (0..200).filter(|_| {
        let arm = loaded_arm().new_tree(&mut runner).unwrap().current();
        HeldArm::new(&arm, &[]).unwrap().is_some()
    });
    let count = by_modes.count();
    assert!(count >= 190, "{count} of 200");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4))]

    /// The same over a minute.
    #[test]
    fn energy_is_kept_for_a_minute(arm in arm(), seed in 1..u32::MAX) {
        let mut state = seed;
        let torques = (0..1200).map(|_| {
            // Xorshift.
            state ^= state << 13;
            state ^= state >> 17;
            state ^= state << 5;
            0.4 * (f64::from(state) / f64::from(u32::MAX) - 0.5)
        });
        prop_assert_eq!(energy_balances(energies(&arm, torques, 0.05)), Ok(()));
    }
}
