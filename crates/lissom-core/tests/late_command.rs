//! A drive whose command acts some samples after it is logged, simulated by short steps of its own equation.
//! Slip phases take the lateness for friction that changes with speed: what they ask for must go again once
//! the lag is in the arm.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::f64::consts::TAU;

use lissom::identify::{Finding, Options, Severity, identify};
use lissom::record::{Axis, Campaign, Channels, Command, CommandQuantity, Hold, Run, TimeBase};
use lissom::replay::Parameter;

const INERTIA: f64 = 2e-3;
const VISCOUS: f64 = 4e-3;
const COULOMB: f64 = 0.08;
const CONSTANT: f64 = 0.2;
const T: f64 = 2e-3;
/// Short steps of a sample.
const SHORT: usize = 100;

/// One run of a PD loop after a sine, read by an encoder of 12 bits.
fn run(name: &str, omega: f64, amplitude: f64, load_nm: f64, late: usize) -> Run {
    let step = TAU / 4096.0;
    let (mut angle, mut speed, mut before) = (0.0_f64, 0.0_f64, None);
    let (mut command, mut motor) = (Vec::new(), Vec::new());
    for k in 0..10_000 {
        let t = f64::from(k) * T;
        let read = step * (angle / step).round();
        let rate = before.map_or(0.0, |b| (read - b) / T);
        let (sine, cosine) = (omega * t).sin_cos();
        let error = amplitude * sine - read;
        command.push(6.0 * error + 0.25 * (amplitude * omega * cosine - rate));
        motor.push(read);
        before = Some(read);
        let acts = command.len().checked_sub(1 + late).map_or(0.0, |i| command[i]);
        let torque = CONSTANT * acts + load_nm;
        let h = T / SHORT as f64;
        for _ in 0..SHORT {
            let against = if speed == 0.0 {
                COULOMB.min(torque.abs()) * torque.signum()
            } else {
                COULOMB * speed.signum()
            };
            let net = torque - against;
            let halfway = speed + 0.5 * h * (net - VISCOUS * speed) / INERTIA;
            let next = speed + h * (net - VISCOUS * halfway) / INERTIA;
            if next * speed < 0.0 {
                angle += 0.5 * h * speed * (speed / (speed - next));
                speed = 0.0;
            } else {
                angle += 0.5 * h * (speed + next);
                speed = next;
            }
        }
    }
    Run::new(name, TimeBase::uniform(0.0, T), command, motor, Vec::new()).unwrap()
}

#[test]
fn a_lag_of_samples_is_no_law_of_friction() {
    for (late, load_nm) in [(2, 0.02), (3, 0.0)] {
        let sines = [(2.0, 0.8), (4.0, 0.6), (6.0, 0.5), (12.0, 0.3)];
        let runs = sines.map(|(w, a)| run(&format!("{w}"), w, a, load_nm, late));
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
        let lag = found.output_error.as_ref().unwrap().estimate(Parameter::CommandLag);
        for (name, estimate, truth) in [
            ("Coulomb friction", found.friction.coulomb, COULOMB),
            ("viscous friction", found.friction.viscous, VISCOUS),
            ("inertia", found.inertia, INERTIA),
            ("lag", lag, late as f64 * T),
        ] {
            let estimate = estimate.unwrap();
            let error = estimate.value - truth;
            assert!(
                error.abs() < 4.0 * estimate.std && estimate.std < 2e-3 * truth,
                "{late} {name} {estimate:?}"
            );
        }
        let warned = found.findings.iter().filter(|f| f.severity() != Severity::Info);
        let codes: Vec<&str> = warned.map(Finding::code).collect();
        assert!(!codes.contains(&"friction-law"), "{late} {codes:?}");
        // The replay has found the axis rigid: so is the model, whatever noise in responses looks like.
        assert!(!codes.contains(&"flexible-without-tip"), "{late} {codes:?}");
        assert!(found.motor_model.unwrap().poles.is_empty());
    }
}
