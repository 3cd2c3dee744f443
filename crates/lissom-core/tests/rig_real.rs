//! What real drives have and the rig makes: measured currents, friction that wanders, constant loads, late time stamps.
#![expect(clippy::unwrap_used, reason = "tests")]

use lissom::arm::Arm;
use lissom::beam::Beam;
use lissom::drive::{Coulomb, DryFriction, Falloff, LuGre, Motor};
use lissom::record::Hold;
use lissom::rig::{
    CurrentReading, CurrentSensor, Drive, Experiment, FrictionWander, Instruments, JointFriction,
    LateStamps, Logged, Noise, Pd, Reference, Rig, RigError, Settle,
};

const COULOMB_NM: f64 = 0.3;
const INERTIA_KG_M2: f64 = 0.02;
const VISCOUS: f64 = 0.05;
/// Torque constant \[N·m/A\].
const CONSTANT: f64 = 0.5;
const SAMPLE_S: f64 = 0.002;

fn rig() -> Rig {
    let motor = Motor::new(INERTIA_KG_M2, VISCOUS, CONSTANT).unwrap();
    let coulomb = Coulomb::symmetric(COULOMB_NM).unwrap();
    let arm = Arm::new(Beam::Rigid, motor, coulomb).unwrap();
    let instruments = Instruments::ideal(SAMPLE_S).unwrap();
    Rig::new(arm, instruments, Pd::new(40.0, 2.0).unwrap().into())
}

fn sine() -> Experiment {
    Experiment::sine(3.0, 1.0, 20.0).unwrap().settling(Settle::AtOnce)
}

fn run(rig: &Rig) -> Logged {
    rig.run("run", &sine(), 5).unwrap()
}

/// Log, and speed and factor of the friction at each row.
fn watched(rig: &Rig, experiment: &Experiment) -> (Logged, Vec<[f64; 2]>) {
    let mut rows = Vec::new();
    let mut controller = rig.controller.clone();
    let logged = rig.run_watched(&mut controller, "run", experiment, 5, &mut |row| {
        rows.push([row.state[1], row.friction_factor]);
    });
    (logged.unwrap(), rows)
}

/// Largest difference of two channels.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn a_sensor_of_the_current_changes_the_log_and_nothing_else() {
    let commanded = run(&rig());
    let mut measuring = rig();
    measuring.instruments.current = Some(CurrentSensor::default());
    assert_eq!(measuring.channels(0..0).unwrap().command.hold, Hold::Measured);
    let measured = run(&measuring);
    assert_eq!(measured.run.motor(), commanded.run.motor());
    // Between two samples the current steps: its mean about the instant is that of both.
    let (read, held) = (measured.run.command(), commanded.run.command());
    let means: Vec<f64> = held.windows(2).map(|w| 0.5 * (w[0] + w[1])).collect();
    assert!(apart(&read[1..], &means) < 1e-12);

    measuring.instruments.current =
        Some(CurrentSensor { reading: CurrentReading::MeanBefore, ..CurrentSensor::default() });
    let late = run(&measuring);
    assert!(apart(&late.run.command()[1..], held) < 1e-12);
}

#[test]
fn noise_of_the_current_is_in_the_log_alone() {
    let mut measuring = rig();
    measuring.instruments.current = Some(CurrentSensor::default());
    let exact = run(&measuring);
    let std_a = 0.1;
    measuring.instruments.current = Some(CurrentSensor::from(Noise::new(std_a).unwrap()));
    let noisy = run(&measuring);
    assert_eq!(noisy.run.motor(), exact.run.motor());
    let both = noisy.run.command().iter().zip(exact.run.command());
    let variance = both.map(|(a, b)| (a - b).powi(2)).sum::<f64>() / noisy.run.len() as f64;
    // 10 000 samples know a variance to 1.4 %.
    assert!((variance / (std_a * std_a) - 1.0).abs() < 0.06, "{variance}");
}

/// A current that is measured behind a delay has none against the angle.
#[test]
fn the_sensor_reads_the_current_that_acts() {
    let mut delayed = rig();
    let delay_s = 3.0 * SAMPLE_S;
    delayed.instruments.delay = Some(lissom::rig::Delay::new(delay_s).unwrap());
    let commanded = run(&delayed);
    delayed.instruments.current =
        Some(CurrentSensor { reading: CurrentReading::AtInstant, ..CurrentSensor::default() });
    let measured = run(&delayed);
    assert!(apart(&measured.run.command()[4..], commanded.run.command()) < 1e-12);
}

#[test]
fn a_slow_log_of_a_fast_loop_reads_means() {
    let mut fast = rig();
    fast.instruments = Instruments::ideal(SAMPLE_S / 4.0).unwrap();
    let every = run(&fast);
    fast.instruments.log_every = 4;
    fast.instruments.current = Some(CurrentSensor::default());
    let slow = run(&fast);
    assert!(slow.findings.is_empty(), "{:?}", slow.findings);
    let mean = |row: usize| every.run.command()[4 * row - 2..4 * row + 2].iter().sum::<f64>() / 4.0;
    let means: Vec<f64> = (1..slow.run.len()).map(mean).collect();
    assert!(apart(&slow.run.command()[1..], &means) < 1e-12);
}

/// In slip the torque less inertia and viscous friction is Coulomb friction times the factor.
#[test]
fn friction_wanders_by_its_factor() {
    let mut wandering = rig();
    wandering.scene.wander = Some(FrictionWander::new(0.05, 0.5).unwrap());
    wandering.instruments.current = None;
    let (logged, rows) = watched(&wandering, &sine());
    let mut slipping = 0;
    for (k, pair) in rows.windows(2).enumerate() {
        let [[before, factor], [after, _]] = [pair[0], pair[1]];
        // No reversal within the sample, and fast enough not to stick.
        if before * after <= 0.0 || before.abs() < 0.2 {
            continue;
        }
        // Under a constant torque and friction the speed goes to its end as e^{−V·t/J}.
        let left = (-VISCOUS * SAMPLE_S / INERTIA_KG_M2).exp();
        let end = (after - before * left) / (1.0 - left);
        let friction = CONSTANT * logged.run.command()[k] - VISCOUS * end;
        assert!((friction * before.signum() / (factor * COULOMB_NM) - 1.0).abs() < 1e-9, "row {k}");
        slipping += 1;
    }
    assert!(slipping > 5000);
    let factors: Vec<f64> = rows.iter().map(|row| row[1]).collect();
    let largest = factors.iter().fold(0.0_f64, |m, f| m.max((f - 1.0).abs()));
    assert!((0.05..0.3).contains(&largest), "{largest}");
}

/// All dry friction is scaled, not Coulomb friction alone: a joint whose law changes near rest slips as well.
#[test]
fn a_law_near_rest_wanders_as_a_whole() {
    let mut wandering = rig();
    let law = DryFriction::from(Coulomb::symmetric(COULOMB_NM).unwrap())
        .with_rest(Coulomb::symmetric(0.1).unwrap(), 1.0, Falloff::Exponential)
        .unwrap();
    wandering.scene.friction = JointFriction::Dry(law.clone());
    wandering.scene.wander = Some(FrictionWander::new(0.1, 0.5).unwrap());
    let (logged, rows) = watched(&wandering, &sine());
    // Without the start, where the loop jumps.
    for (k, pair) in rows.windows(2).enumerate().skip(250) {
        let [[before, factor], [after, _]] = [pair[0], pair[1]];
        if before * after <= 0.0 || before.abs() < 0.5 {
            continue;
        }
        let (mean, change) = (0.5 * (before + after), (after - before) / SAMPLE_S);
        let torque = CONSTANT * logged.run.command()[k];
        let friction = torque - INERTIA_KG_M2 * change - VISCOUS * mean;
        let expected = factor * law.at(mean, 0.0).forward();
        // The speed is taken as straight within a sample.
        assert!((friction * mean.signum() / expected - 1.0).abs() < 1e-3, "row {k}");
    }
}

#[test]
fn bristles_do_not_wander() {
    let mut bristles = rig();
    let sliding = Coulomb::symmetric(COULOMB_NM).unwrap();
    let law = LuGre::new(300.0, 1.0, sliding, sliding, 0.1).unwrap();
    bristles.scene.friction = JointFriction::Bristles { law, tolerance: 1e-6 };
    bristles.scene.wander = Some(FrictionWander::new(0.05, 0.5).unwrap());
    let refused = bristles.run("run", &sine(), 5);
    assert!(matches!(refused, Err(RigError::Unsupported { .. })));
}

/// A weight that friction does not hold pulls the loop off by its torque over the stiffness.
#[test]
fn a_constant_load_hangs_on_the_loop() {
    let mut hoist = rig();
    hoist.scene.load_nm = 2.0;
    let hold = Experiment::new(Drive::Angle(Reference::hold(0.0).unwrap()), 5.0);
    let (logged, rows) = watched(&hoist, &hold.unwrap().settling(Settle::AtOnce));
    assert!(rows[rows.len() - 1][0].abs() < 1e-12);
    let last = logged.run.motor()[logged.run.len() - 1];
    let stiffness = CONSTANT * 40.0;
    assert!(last < 0.0 && (stiffness * last + hoist.scene.load_nm).abs() <= COULOMB_NM, "{last}");
    // Less than friction holds moves nothing.
    hoist.scene.load_nm = 0.9 * COULOMB_NM;
    let held = hoist.run("held", &Experiment::sine(3.0, 1e-4, 2.0).unwrap(), 5).unwrap();
    assert!(held.run.motor().iter().all(|a| *a == 0.0));
    hoist.scene.load_nm = f64::NAN;
    assert!(matches!(hoist.run("", &sine(), 5), Err(RigError::NotFinite { .. })));
}

#[test]
fn time_stamps_are_late_and_increase() {
    let mut late = rig();
    let even = run(&late);
    assert!(even.stamps_s.is_none());
    late.instruments.stamps = Some(LateStamps::new(0.9 * SAMPLE_S).unwrap());
    let logged = run(&late);
    assert_eq!(logged.run.motor(), even.run.motor());
    let stamps = logged.stamps_s.unwrap();
    assert!(stamps.windows(2).all(|w| w[1] > w[0]));
    let lateness: Vec<f64> =
        stamps.iter().enumerate().map(|(k, s)| s - k as f64 * SAMPLE_S).collect();
    let mean = lateness.iter().sum::<f64>() / lateness.len() as f64;
    assert!(lateness.iter().all(|l| (-1e-12..=0.9 * SAMPLE_S).contains(l)));
    // The standard error of a mean of 10 000 uniform numbers is 0.6 % of it.
    assert!((mean / (0.45 * SAMPLE_S) - 1.0).abs() < 0.025, "{mean}");
    late.instruments.stamps = Some(LateStamps::new(SAMPLE_S).unwrap());
    assert!(matches!(late.run("", &sine(), 5), Err(RigError::LateStamps { .. })));
}

/// What one instrument draws changes nothing for another.
#[test]
fn streams_are_independent() {
    let mut noisy = rig();
    noisy.instruments.motor = Noise::new(1e-4).unwrap().into();
    let alone = run(&noisy);
    noisy.instruments.current = Some(CurrentSensor::from(Noise::new(0.1).unwrap()));
    noisy.instruments.stamps = Some(LateStamps::new(0.5 * SAMPLE_S).unwrap());
    assert_eq!(run(&noisy).run.motor(), alone.run.motor());
}
