//! Laws of motion with a world at the tip: Section 3's property 5, energy.

use lissom::Matrix;
use lissom::arm::Arm;
use lissom::beam::{LumpedBeam, Payload, Span};
use lissom::drive::{Coulomb, DryFriction, Falloff, Motor};
use lissom::rig::{Harmonic, Hybrid, Signal, TipWorld, Wall};
use proptest::prelude::*;

fn span() -> impl Strategy<Value = Span> {
    let damping = prop_oneof![Just(0.0), 1e-3..1e-1_f64];
    (0.1..0.3_f64, 0.02..0.5_f64, 0.02..0.2_f64, damping).prop_map(|(l, ei, m, c)| Span {
        length_m: l,
        flexural_rigidity_n_m2: ei,
        mass_kg: m,
        damping_n_s_per_m: c,
    })
}

fn beam() -> impl Strategy<Value = LumpedBeam> {
    let payload = prop_oneof![
        Just(Payload::default()),
        (0.0..0.1_f64, 1e-5..1e-3_f64, 0.0..0.03_f64).prop_map(
            |(mass_kg, inertia_kg_m2, offset_m)| { Payload { mass_kg, inertia_kg_m2, offset_m } }
        ),
    ];
    (prop::collection::vec(span(), 1..4), payload)
        .prop_map(|(spans, load)| LumpedBeam::new(&spans).unwrap().with_payload(load).unwrap())
}

fn arm(beam: LumpedBeam, coulomb: Coulomb) -> Arm {
    Arm::new(beam, Motor::new(1e-3, 2e-3, 1.0).unwrap(), coulomb).unwrap()
}

fn none() -> Coulomb {
    Coulomb::symmetric(0.0).unwrap()
}

fn loads(force_n: f64, torque_nm: f64) -> TipWorld {
    let constant = |value| Signal::constant(value).unwrap();
    TipWorld { force: constant(force_n), torque: constant(torque_nm), ..TipWorld::default() }
}

fn moved(arm: &Arm, world: TipWorld, torque_nm: f64, time_s: f64) -> Vec<f64> {
    let mut hybrid = Hybrid::at_rest(arm).with_world(world).unwrap();
    hybrid.advance(torque_nm, time_s);
    hybrid.state().to_vec()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// The matrix exponential of the state space of (13)-(15) with the constant inputs as states.
    #[test]
    fn tip_loads_act_as_in_the_state_space(
        beam in beam(), force in -1.0..1.0_f64, torque in -0.1..0.1_f64, time_s in 0.01..0.3_f64,
    ) {
        let arm = arm(beam, none());
        let s = arm.state_space();
        let len = arm.state_len();
        let mut block = Matrix::zeros(len + 3, len + 3);
        block.view_mut((0, 0), (len, len)).copy_from(&s.a);
        block.view_mut((0, len), (len, 3)).copy_from(&s.b);
        let answer = (block * time_s).exp();
        let found = moved(&arm, loads(force, torque), 0.02, time_s);
        let exact = |i: usize| {
            0.02 * answer[(i, len)] + force * answer[(i, len + 1)] + torque * answer[(i, len + 2)]
        };
        let size = (0..len).fold(0.0_f64, |m, i| m.max(exact(i).abs()));
        for (i, x) in found.iter().enumerate() {
            prop_assert!((x - exact(i)).abs() <= 1e-10 * size, "{i}: {x} {}", exact(i));
        }
    }

    /// A drive in continuous time, against the matrix exponential with an oscillator as two states.
    #[test]
    fn a_swinging_torque_acts_as_in_the_state_space(
        beam in beam(), omega in 0.5..60.0_f64, phase in 0.0..6.0_f64, time_s in 0.01..0.3_f64,
    ) {
        let arm = arm(beam, none());
        let (s, len) = (arm.state_space(), arm.state_len());
        let mut block = Matrix::zeros(len + 2, len + 2);
        block.view_mut((0, 0), (len, len)).copy_from(&s.a);
        block.view_mut((0, len), (len, 1)).copy_from(&s.b.column(0));
        (block[(len, len + 1)], block[(len + 1, len)]) = (omega, -omega);
        let answer = (block * time_s).exp();
        let swing = Harmonic { amplitude: 0.05, omega_rad_s: omega, phase_rad: phase };
        let mut hybrid = Hybrid::at_rest(&arm);
        let torque = Signal::harmonics(&[swing]).unwrap();
        hybrid.advance_driven(&torque, 0.3 * time_s);
        hybrid.advance_driven(&torque, 0.7 * time_s);
        let exact = |i: usize| {
            0.05 * (phase.sin() * answer[(i, len)] + phase.cos() * answer[(i, len + 1)])
        };
        let size = (0..len).fold(0.0_f64, |m, i| m.max(exact(i).abs()));
        for (i, x) in hybrid.state().iter().enumerate() {
            prop_assert!((x - exact(i)).abs() <= 1e-10 * size, "{i}: {x} {}", exact(i));
        }
    }

    /// Property 5: F_n and T_n act linearly on all masses, whatever the joint does between events.
    #[test]
    fn tip_loads_add_up(
        beam in beam(), force in -1.0..1.0_f64, torque in -0.1..0.1_f64, stuck in any::<bool>(),
    ) {
        // A joint that always sticks, or one that never does.
        let arm = arm(beam, if stuck { Coulomb::symmetric(1e3).unwrap() } else { none() });
        let at = |f, t| moved(&arm, loads(f, t), 0.0, 0.2);
        let (one, other, both) = (at(force, 0.0), at(0.0, torque), at(force, torque));
        let size = both.iter().chain(&one).chain(&other).fold(0.0_f64, |m, v| m.max(v.abs()));
        for i in 0..arm.state_len() {
            prop_assert!((both[i] - one[i] - other[i]).abs() <= 1e-11 * size);
        }
        prop_assert!(!stuck || both[0] == 0.0 && both[1] == 0.0);
    }
}

fn world() -> impl Strategy<Value = TipWorld> {
    let friction = prop_oneof![Just(0.0), 0.01..0.2_f64];
    let wall = (0.05..0.5_f64, 20.0..300.0_f64).prop_map(|(angle_rad, stiffness_n_per_m)| Wall {
        angle_rad,
        stiffness_n_per_m,
        ahead: true,
    });
    let walls = prop::collection::vec(wall, 0..2);
    (-0.2..0.2_f64, friction, prop_oneof![Just(0.0), 0.01..0.2_f64], walls).prop_map(
        |(force, coulomb_n, viscous_n_s_per_m, walls)| TipWorld {
            force: Signal::constant(force).unwrap(),
            coulomb_n,
            viscous_n_s_per_m,
            walls,
            ..TipWorld::default()
        },
    )
}

fn law() -> impl Strategy<Value = DryFriction> {
    let limit = || 5e-3..0.05_f64;
    (limit(), limit(), 0.3..2.0_f64, 0.1..1.0_f64, 0.0..0.5_f64, any::<[bool; 2]>()).prop_map(
        |(forward, backward, rest, velocity, ripple, [bends, gaussian])| {
            let law = DryFriction::from(Coulomb::by_direction(forward, backward).unwrap());
            if !bends {
                return law;
            }
            let falloff = if gaussian { Falloff::Gaussian } else { Falloff::Exponential };
            // Never more ripple than there is friction in either direction.
            let least = rest.min(1.0) * forward.min(backward) / (0.5 * (forward + backward));
            let rest = Coulomb::by_direction(rest * forward, rest * backward).unwrap();
            law.with_rest(rest, velocity, falloff)
                .and_then(|law| law.with_ripple(ripple * least, 9.0, 0.2))
                .unwrap()
        },
    )
}

/// Kinetic and elastic energy of arm and walls \[J\].
fn stored(arm: &Arm, world: &TipWorld, x: &[f64]) -> f64 {
    let beam = arm.beam().lumped().unwrap();
    let (n, at) = (beam.len(), beam.position_m());
    let stiffness = beam.matrices().unwrap().ei_a;
    let mut sum = arm.motor.inertia_kg_m2() * x[1] * x[1];
    for i in 0..n {
        sum += beam.spans()[i].mass_kg * (at[i] * x[2 + n + i]).powi(2);
        // (13): the force on mass i is L_i·Σ EI·A_ij·(θ_j − θ_m).
        let force: f64 = (0..n).map(|j| stiffness[(i, j)] * (x[2 + j] - x[0])).sum();
        sum -= at[i] * at[i] * (x[2 + i] - x[0]) * force;
    }
    for wall in &world.walls {
        sum += wall.stiffness_n_per_m * (at[n - 1] * (x[1 + n] - wall.angle_rad).max(0.0)).powi(2);
    }
    0.5 * sum
}

/// Gauss-Legendre nodes and weights on \[0, 1\], exact up to degree nine.
const GAUSS: [(f64, f64); 5] = [
    (0.046_910_077_030_668_0, 0.118_463_442_528_094_5),
    (0.230_765_344_947_158_5, 0.239_314_335_249_683_2),
    (0.5, 0.284_444_444_444_444_4),
    (0.769_234_655_052_841_5, 0.239_314_335_249_683_2),
    (0.953_089_922_969_332, 0.118_463_442_528_094_5),
];
/// Length of a piece \[s\]: some hundredths of the fastest oscillation.
const PIECE_S: f64 = 5e-4;
/// What is left of the balance, by the energy that went to and fro.
const BALANCE: f64 = 1e-9;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// Supplied by motor and tip force = stored + taken by each friction and damper.
    #[test]
    fn energy_is_kept(
        spans in prop::collection::vec(span(), 1..4), world in world(), law in law(),
        torques in prop::collection::vec(-0.2..0.2_f64, 5..25), sample_s in 2e-3..2e-2_f64,
    ) {
        let arm = arm(LumpedBeam::new(&spans).unwrap(), law.sliding());
        let (n, radius) = (spans.len(), arm.beam().position_m()[spans.len() - 1]);
        let rate = 1 + 2 * n;
        let force = world.force.at(0.0);
        let mut hybrid = Hybrid::at_rest(&arm).with_friction(law.clone()).with_world(world.clone()).unwrap();
        let (mut supplied, mut taken, mut turned_over) = (0.0, 0.0, 0.0);
        for torque in torques {
            let mut left = sample_s;
            while left > 1e-15 * sample_s {
                let before = hybrid.clone();
                let passed = hybrid.advance_to_event(torque, left.min(PIECE_S));
                left -= passed;
                for (node, weight) in GAUSS {
                    let mut within = before.clone();
                    within.advance(torque, node * passed);
                    let x = within.state();
                    let rubbed = law.at(x[1], x[0]).slipping(x[1]) * x[1];
                    let dampers: f64 = (0..n)
                        .map(|i| {
                            let c = spans[i].damping_n_s_per_m
                                + if i + 1 == n { world.viscous_n_s_per_m } else { 0.0 };
                            c * (arm.beam().position_m()[i] * x[2 + n + i]).powi(2)
                        })
                        .sum();
                    let tip = world.coulomb_n * radius * x[rate].abs();
                    let motor = arm.motor.viscous_nm_s_per_rad() * x[1] * x[1];
                    taken += weight * passed * (rubbed + dampers + tip + motor);
                }
                let turned = hybrid.state()[0] - before.state()[0];
                let tip = radius * (hybrid.state()[1 + n] - before.state()[1 + n]);
                supplied += torque * turned + force * tip;
                turned_over += (torque * turned).abs() + (force * tip).abs();
            }
        }
        let kept = stored(&arm, &world, hybrid.state());
        let gap = (supplied - kept - taken).abs();
        prop_assert!(gap <= BALANCE * turned_over, "{gap:e} of {turned_over:e}");
    }
}
