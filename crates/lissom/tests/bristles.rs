//! A drive whose joint rests on bristles (LuGre), simulated by its own equations in short Runge-Kutta steps: the
//! replay must find what yields before the joint slips, and inertia and friction with it.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::f64::consts::TAU;

use lissom::identify::{Options, Severity, identify};
use lissom::record::{Axis, Campaign, Channels, Command, CommandQuantity, Hold, Run, TimeBase};

const INERTIA: f64 = 2e-3;
const VISCOUS: f64 = 4e-3;
const COULOMB: f64 = 0.08;
/// Beyond Coulomb friction at rest, and the speed over which that goes, by its square.
const AT_REST: f64 = 0.02;
const FALLS: f64 = 0.3;
/// Bends by 1 mrad before it slips.
const STIFFNESS: f64 = 80.0;
const DAMPING: f64 = 0.4;
const CONSTANT: f64 = 0.2;
const T: f64 = 2e-3;
/// Short steps of a sample.
const SHORT: usize = 100;

/// Rates of angle, speed and deflection under a torque.
fn rates([_, speed, bent]: [f64; 3], torque: f64) -> [f64; 3] {
    let level = COULOMB + AT_REST * (-(speed / FALLS).powi(2)).exp();
    let bends = speed - STIFFNESS * speed.abs() / level * bent;
    let friction = STIFFNESS * bent + DAMPING * bends;
    [speed, (torque - friction - VISCOUS * speed) / INERTIA, bends]
}

/// One run of a PD loop after a sine, read by an encoder of 14 bits.
fn run(name: &str, omega: f64, amplitude: f64) -> Run {
    let step = TAU / 16384.0;
    let (mut state, mut before) = ([0.0_f64; 3], None);
    let (mut command, mut motor) = (Vec::new(), Vec::new());
    for k in 0..6_000 {
        let t = f64::from(k) * T;
        let read = step * (state[0] / step).round();
        let rate = before.map_or(0.0, |b| (read - b) / T);
        let (sine, cosine) = (omega * t).sin_cos();
        let error = amplitude * sine - read;
        let asked = 6.0 * error + 0.2 * (amplitude * omega * cosine - rate);
        command.push(asked);
        motor.push(read);
        before = Some(read);
        let torque = CONSTANT * asked;
        let h = T / SHORT as f64;
        let along =
            |from: [f64; 3], by: [f64; 3], h: f64| [0, 1, 2].map(|i: usize| from[i] + h * by[i]);
        for _ in 0..SHORT {
            let k1 = rates(state, torque);
            let k2 = rates(along(state, k1, 0.5 * h), torque);
            let k3 = rates(along(state, k2, 0.5 * h), torque);
            let k4 = rates(along(state, k3, h), torque);
            let mean = [0, 1, 2].map(|i| (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]) / 6.0);
            state = along(state, mean, h);
        }
    }
    Run::new(name, TimeBase::uniform(0.0, T), command, motor, Vec::new()).unwrap()
}

#[test]
fn bristles_are_found_and_named() {
    let sines = [(2.0, 0.6), (4.0, 0.5), (9.0, 0.3)];
    let runs = sines.map(|(w, a)| run(&format!("{w}"), w, a));
    let command = Command {
        quantity: CommandQuantity::Current,
        hold: Hold::Sampled,
        torque_per_command: Some(CONSTANT),
        back_emf_viscous: 0.0,
        limit: None,
    };
    let channels = Channels { axis: Axis::Rotary, command, tips: Vec::new() };
    let campaign = Campaign::new(channels, runs.into()).unwrap();
    let found = identify(&campaign, &Options::default(), |_| ()).unwrap();
    let replay = found.output_error.as_ref().unwrap();
    assert!(replay.describes_whole_runs(), "{:?}", replay.beyond_noise);
    let (bristles, near_rest) =
        (found.friction.bristles.unwrap(), found.friction.near_rest.unwrap());
    for (name, figure, truth, within) in [
        ("inertia", found.inertia.unwrap(), INERTIA, 1e-3),
        ("Coulomb friction", found.friction.coulomb.unwrap(), COULOMB, 1e-3),
        ("viscous friction", found.friction.viscous.unwrap(), VISCOUS, 5e-3),
        ("bristles' stiffness", bristles.stiffness, STIFFNESS, 0.02),
        ("bristles' damping", bristles.damping, DAMPING, 0.05),
        ("travel", bristles.travel, COULOMB / STIFFNESS, 0.02),
        ("friction at rest", near_rest.torque, AT_REST, 0.03),
        ("speed near rest", near_rest.speed, FALLS, 0.03),
    ] {
        let error = figure.value - truth;
        assert!(
            error.abs() < 5.0 * figure.std && error.abs() < within * truth,
            "{name} {figure:?}"
        );
    }
    let law = found.findings.iter().find(|f| f.code == "friction-law").unwrap();
    assert!(law.severity == Severity::Warning && law.message.contains("bristles"), "{law:?}");
}
