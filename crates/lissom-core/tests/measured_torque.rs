//! A measured torque between its samples.

use lissom::arm::Arm;
use lissom::beam::Beam;
use lissom::drive::{Coulomb, Motor};
use lissom::record::{Axis, Campaign, Channels, Command, CommandQuantity, Hold, Run, TimeBase};
use lissom::replay::{ModalArm, Window, predict};

/// A free motor under a measured torque `sin ωt` with ωT = 0.3, against `θ = (v + 1/Jω)·t − sin(ωt)/Jω²`. Lines through the
/// samples would take (ωT)²/12 = 0.75 % from the torque, the cubic takes `11·(ωT)⁴/720` = 0.012 %: over four periods the angle
/// drifts by 8π times as much of 1/Jω².
#[test]
fn a_measured_torque_is_a_cubic_between_samples() {
    let (inertia, omega, t) = (2e-3, 300.0, 1e-3);
    let rate = 1.0 / (inertia * omega);
    let speed = 2.0 * rate;
    let at = |s: f64| (speed + rate) * s - rate / omega * (omega * s).sin();
    let times: Vec<f64> = (0..90).map(|k| t * f64::from(k)).collect();
    let torque = times.iter().map(|s| (omega * s).sin()).collect();
    let motor = times.iter().map(|s| at(*s)).collect();
    let command = Command {
        quantity: CommandQuantity::Current,
        hold: Hold::Measured,
        torque_per_command: Some(1.0),
        back_emf_viscous: 0.0,
        limit: None,
    };
    let run = Run::new("run", TimeBase::uniform(0.0, t), torque, motor, vec![]).unwrap();
    let channels = Channels { axis: Axis::Rotary, command, tips: vec![] };
    let campaign = Campaign::new(channels, vec![run]).unwrap();
    let motor = Motor::new(inertia, 0.0, 1.0).unwrap();
    let free = Arm::new(Beam::Rigid, motor, Coulomb::symmetric(0.0).unwrap()).unwrap();
    let arm = ModalArm::of_arm(&free).unwrap();
    let first = 2.0 * t;
    let start = vec![at(first), speed + rate * (1.0 - (omega * first).cos())];
    let window = Window { run: 0, samples: 2..=86, start, zeros: vec![] };
    let shown = predict(&arm, &campaign, &window).unwrap();
    let apart = shown.channels[0].iter().zip(&times[2..]).map(|(a, s)| (a - at(*s)).abs());
    let drift = apart.fold(0.0, f64::max) / (rate / omega);
    let told = 8.0 * std::f64::consts::PI * 11.0 / 720.0 * (omega * t).powi(4);
    assert!(drift < 1.5 * told, "{drift} {told}");
}
