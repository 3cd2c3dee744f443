//! What the fast engine does for its results: counts, not times.

#![expect(clippy::unwrap_used, reason = "tests")]

use lissom::arm::Arm;
use lissom::beam::{LumpedBeam, Span};
use lissom::rig::{HeldArm, HeldMotion, Hybrid, Motion, Quantiser, RigError, Work};
use lissom_testmodels::report_arm;

const SAMPLE_TIME_S: f64 = 0.003;
const SAMPLES: usize = 20_000;
/// Two engines on one loop stay this close \[rad\]: some thousand roundings of 0.5 rad.
const APART_RAD: f64 = 1e-12;

/// Most evaluations of exponentials per search \[1\]; 1.7 to 2.2 are needed.
const EVALUATIONS: f64 = 2.5;

fn arm(masses: usize) -> Arm {
    let report = report_arm();
    let span = report.beam().spans()[0];
    let parts = masses as f64;
    let span = Span { length_m: span.length_m / parts, mass_kg: span.mass_kg / parts, ..span };
    let beam = LumpedBeam::new(&vec![span; masses]).unwrap();
    Arm::new(beam, report.motor, report.coulomb).unwrap()
}

/// The report's loop; `advance` takes a torque and gives the motor's angle.
fn closed_loop(
    arm: &Arm,
    sensor: Option<Quantiser>,
    samples: usize,
    mut advance: impl FnMut(f64) -> f64,
) {
    let (mut before, mut angle) = (0.0, 0.0);
    for k in 0..samples {
        let read = sensor.map_or(angle, |s| s.read(angle));
        let error = 0.5 * (3.0 * k as f64 * SAMPLE_TIME_S).sin() - read;
        let rate = (error - before) / SAMPLE_TIME_S;
        let current = (8.0 * error + 0.2 * rate).clamp(-4.12, 4.12);
        before = error;
        angle = advance(arm.motor.torque_constant_nm_per_a() * current);
    }
}

fn work(masses: usize, sensor: Option<Quantiser>) -> (Work, usize) {
    let arm = arm(masses);
    let held = HeldArm::new(&arm, &[SAMPLE_TIME_S]).unwrap().unwrap();
    let mut motion = HeldMotion::at_rest(&held);
    let counted = allocation_counter::measure(|| {
        closed_loop(&arm, sensor, SAMPLES, |torque| {
            motion.advance(torque, SAMPLE_TIME_S).unwrap();
            // The whole state once in a while: its room is there already.
            motion.motor_angle_rad() + 0.0 * motion.state()[0]
        });
    });
    assert_eq!(counted.count_total, 0, "allocations");
    (motion.work(), motion.sticks())
}

/// 60 s: searches where something happens and hardly elsewhere, about two evaluations of
/// exponentials each, no allocation, nothing left to the event engine.
#[test]
fn sixty_seconds() {
    let twelve = Quantiser::new(12, std::f64::consts::TAU).unwrap();
    let found = [(1, None), (1, Some(twelve)), (2, None), (10, None)].map(|(masses, sensor)| {
        let (w, sticks) = work(masses, sensor);
        // The last bits of sine and exponential are the system's: Newton may take one more.
        assert!(w.evaluations as f64 <= EVALUATIONS * w.searched as f64, "{w:?}");
        (masses, w.whole, w.searched, w.handed_over, sticks)
    });
    let expected = [
        (1, 19_881, 119, 0, 57),
        (1, 19_864, 136, 0, 67),
        (2, 19_880, 120, 0, 57),
        (10, 19_883, 117, 0, 57),
    ];
    assert_eq!(found, expected);
}

/// Ten masses, fastest mode far above the sampling rate, against the event engine.
#[test]
fn ten_masses_move_as_their_events_say() {
    let arm = arm(10);
    let held = HeldArm::new(&arm, &[SAMPLE_TIME_S]).unwrap().unwrap();
    let (mut fast, mut slow) = (HeldMotion::at_rest(&held), Hybrid::at_rest(&arm));
    closed_loop(&arm, None, 1500, |torque| {
        fast.advance(torque, SAMPLE_TIME_S).unwrap();
        slow.advance(torque, SAMPLE_TIME_S);
        for (a, b) in fast.state().iter().zip(slow.state()).take(12) {
            assert!((a - b).abs() < APART_RAD, "{a} {b}");
        }
        slow.state()[0]
    });
    assert_eq!((fast.mode(), fast.sticks()), (slow.mode(), slow.sticks()));
}

/// Damping that is nearly critical: the modes cannot be told apart, so that there is no fast engine, or only just.
#[test]
fn near_critical_damping_changes_nothing() {
    let mut apart = 0;
    for off in [0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 0.1] {
        let report = report_arm();
        let span = Span { damping_n_s_per_m: 0.0, ..report.beam().spans()[0] };
        let damping = lissom::beam::Damping::Modal { ratios: vec![1.0 + off] };
        let beam = LumpedBeam::new(&[span]).unwrap().with_damping(damping).unwrap();
        let arm = Arm::new(beam, report.motor, report.coulomb).unwrap();
        let Some(held) = HeldArm::new(&arm, &[SAMPLE_TIME_S]).unwrap() else {
            apart += 1;
            continue;
        };
        let (mut fast, mut slow) = (HeldMotion::at_rest(&held), Hybrid::at_rest(&arm));
        closed_loop(&arm, None, 1500, |torque| {
            fast.advance(torque, SAMPLE_TIME_S).unwrap();
            slow.advance(torque, SAMPLE_TIME_S);
            for (a, b) in fast.state().iter().zip(slow.state()) {
                assert!((a - b).abs() < 1e-10, "{off}: {a} {b}");
            }
            slow.state()[0]
        });
        assert_eq!((fast.mode(), fast.sticks()), (slow.mode(), slow.sticks()));
    }
    assert!((1..7).contains(&apart), "{apart}");
}

#[test]
fn what_is_no_number_is_refused() {
    let arm = arm(2);
    let held = HeldArm::new(&arm, &[SAMPLE_TIME_S]).unwrap().unwrap();
    let mut motion = HeldMotion::at_rest(&held);
    assert!(matches!(motion.advance(f64::NAN, 0.003), Err(RigError::NotFinite { .. })));
    assert!(matches!(motion.advance(0.0, -0.003), Err(RigError::NotPositive { .. })));
    assert!(matches!(motion.advance(0.0, f64::INFINITY), Err(RigError::NotPositive { .. })));
    assert!(matches!(HeldArm::new(&arm, &[0.0]), Err(RigError::NotPositive { .. })));
    let short = HeldMotion::with_state(&held, &[0.0; 4]);
    assert!(matches!(short, Err(RigError::State { found: 4, expected: 6 })));
    // Nothing was moved by what was refused.
    assert_eq!(motion.state(), [0.0; 6]);
}
