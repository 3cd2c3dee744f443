//! A joint behind a stiff gear with a second encoder on the load, over a bus that is later: the lag times the stiffness of the gear
//! is more than the motor's viscous friction.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use lissom::identify::findings::rows;
use lissom::identify::{Finding, Identified, Options, identify};
use lissom::record::{
    Axis, Campaign, Channels, Command, CommandQuantity, Hold, Run, TimeBase, Tip, TipQuantity,
};

const SAMPLE_S: f64 = 0.004;
const GEAR: f64 = 6e4;
const INERTIA: f64 = 20.0;
const COULOMB: f64 = 40.0;
const VISCOUS: f64 = 60.0;
const LOAD_INERTIA: f64 = 50.0;
const LOAD_TORQUE: f64 = 300.0;
const ENCODER_RAD: f64 = 3e-7;

/// The load's angle.
fn load(t: f64) -> f64 {
    0.2 + 0.3 * (0.7 * t).sin() + 0.12 * (1.9 * t + 1.0).sin() + 0.05 * (3.1 * t).sin()
}

/// Rates of change by central differences.
fn rates(of: impl Fn(f64) -> f64, t: f64) -> [f64; 2] {
    let h = 1e-3;
    let [before, at, after] = [t - h, t, t + h].map(of);
    [(after - before) / (2.0 * h), (after - 2.0 * at + before) / (h * h)]
}

fn torque_of_gear(t: f64) -> f64 {
    LOAD_INERTIA * rates(load, t)[1] + LOAD_TORQUE * load(t).sin()
}

fn motor(t: f64) -> f64 {
    load(t) + torque_of_gear(t) / GEAR
}

fn identified(late_s: f64) -> Identified {
    let times: Vec<f64> = (0..10_000).map(|k| SAMPLE_S * f64::from(k)).collect();
    // Noise of three newton metres that repeats nowhere.
    let noise = |t: f64| 3.0 * ((7919.0 * t).sin() * 43_758.545_3).fract();
    let command = |&t: &f64| {
        let [speed, acceleration] = rates(motor, t);
        let joint = INERTIA * acceleration + VISCOUS * speed + COULOMB * speed.signum();
        joint + torque_of_gear(t) + noise(t)
    };
    let read = |angle: f64| (angle / ENCODER_RAD).round() * ENCODER_RAD;
    let command = times.iter().map(command).collect();
    let angles = times.iter().map(|t| read(motor(*t))).collect();
    let tips = vec![times.iter().map(|t| read(load(t - late_s))).collect()];
    let run = Run::new("run", TimeBase::uniform(0.0, SAMPLE_S), command, angles, tips).unwrap();
    let tip = Tip { name: "load".to_owned(), quantity: TipQuantity::Angle, calibrated: true };
    let command = Command {
        quantity: CommandQuantity::Current,
        hold: Hold::Measured,
        torque_per_command: Some(1.0),
        back_emf_viscous: 0.0,
        limit: None,
    };
    let channels = Channels { axis: Axis::Rotary, command, tips: vec![tip] };
    identify(&Campaign::new(channels, vec![run]).unwrap(), &Options::default(), |_| ()).unwrap()
}

#[test]
fn viscous_friction_is_that_of_the_motor() {
    for late_s in [0.0, 0.0025] {
        let found = identified(late_s);
        let viscous = found.friction.viscous.unwrap();
        assert!((viscous.value / VISCOUS - 1.0).abs() < 0.05, "{late_s}: {viscous:?}");
        let coulomb = found.friction.coulomb.unwrap();
        assert!((coulomb.value / COULOMB - 1.0).abs() < 0.02, "{late_s}: {coulomb:?}");
        let coupling = found.beam.coupling.unwrap();
        assert!((coupling.value / GEAR - 1.0).abs() < 0.01, "{late_s}: {coupling:?}");
        let said = found.findings.iter().any(Finding::is::<rows::TipReadLate>);
        assert_eq!(said, late_s > 0.0, "{:?}", found.findings);
        // The arm is that of the logs as they are.
        let arm = found.arm.as_ref().unwrap();
        let lag_s = arm.arm.tip_lags_s.first().copied().unwrap_or(0.0);
        assert!((lag_s - late_s).abs() < 1e-4, "{late_s}: {lag_s}");
    }
}
