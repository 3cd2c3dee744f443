//! A load behind a spring that no tip shows: the motor's motion alone gives the mode, and friction and inertia with it.

#![expect(clippy::unwrap_used, reason = "tests")]

use lissom::identify::findings::rows;
use lissom::identify::{Effort, Estimate, Finding, Identified, Options, identify};
use lissom::record::{Axis, Campaign, Channels, Command, CommandQuantity, Hold, Run, TimeBase};

const MOTOR_KG_M2: f64 = 0.006;
const LOAD_KG_M2: f64 = 0.004;
const VISCOUS: f64 = 0.02;
const COULOMB_NM: f64 = 0.15;
/// Frequency of the load on its spring with the motor clamped \[rad/s\].
const OMEGA_RAD_S: f64 = 50.0;
const DAMPING_RATIO: f64 = 0.02;
const SAMPLE_S: f64 = 2e-3;
/// Steps of the simulation in a sample.
const STEPS: usize = 400;

/// Torque and motor angle of a position loop that follows two sines, by small steps of midpoints.
fn log(samples: usize) -> (Vec<f64>, Vec<f64>) {
    let h = SAMPLE_S / STEPS as f64;
    let stiffness = LOAD_KG_M2 * OMEGA_RAD_S * OMEGA_RAD_S;
    let damping = 2.0 * DAMPING_RATIO * OMEGA_RAD_S * LOAD_KG_M2;
    let (mut q, mut v, mut q2, mut v2) = (0.0_f64, 0.0_f64, 0.0_f64, 0.0_f64);
    let (mut torques, mut angles) = (Vec::new(), Vec::new());
    for k in 0..samples {
        let t = SAMPLE_S * k as f64;
        let reference = 0.8 * (1.9 * t).sin() + 0.3 * (6.1 * t).sin();
        let torque = 20.0 * (reference - q) - 0.5 * v;
        // A sensor of 2¹⁷ counts a turn.
        let count = std::f64::consts::TAU / f64::from(1 << 17);
        angles.push((q / count).round() * count);
        torques.push(torque);
        for _ in 0..STEPS {
            let middle = (q - q2) + 0.5 * h * (v - v2);
            let spring = stiffness * middle + damping * (v - v2);
            let drive = torque - spring;
            let sign = if v == 0.0 { drive.signum() } else { v.signum() };
            if v != 0.0 || drive.abs() > COULOMB_NM {
                let acceleration = |v: f64| (drive - VISCOUS * v - sign * COULOMB_NM) / MOTOR_KG_M2;
                let next = v + h * acceleration(v + 0.5 * h * acceleration(v));
                // Where the sign changes the motor comes to rest, and the next step says whether it goes on.
                let next = if next * sign < 0.0 { 0.0 } else { next };
                q += 0.5 * h * (v + next);
                v = next;
            }
            let next = v2 + h * spring / LOAD_KG_M2;
            q2 += 0.5 * h * (v2 + next);
            v2 = next;
        }
    }
    (torques, angles)
}

fn campaign() -> Campaign {
    let command = Command {
        quantity: CommandQuantity::Current,
        hold: Hold::Sampled,
        torque_per_command: Some(1.0),
        back_emf_viscous: 0.0,
        limit: None,
    };
    let (torque, angle) = log(8000);
    let run = Run::new("log", TimeBase::uniform(0.0, SAMPLE_S), torque, angle, vec![]).unwrap();
    let channels = Channels { axis: Axis::Rotary, command, tips: vec![] };
    Campaign::new(channels, vec![run]).unwrap()
}

fn identified() -> Identified {
    identify(&campaign(), &Options::default(), |_| ()).unwrap()
}

#[track_caller]
fn near(name: &str, found: f64, truth: f64, within: f64) {
    assert!((found / truth - 1.0).abs() < within, "{name}: {found}, in truth {truth}");
}

/// The equation of slip phases counts it by itself: without it viscous friction comes out 4 % too large.
#[test]
fn slip_phases_show_the_mode_and_count_it() {
    let campaign = campaign();
    let options = Options { effort: Effort::Quick, ..Options::default() };
    let found = identify(&campaign, &options, |_| ()).unwrap().regression.unwrap();
    let mode = found.mode.unwrap();
    near("mode", mode.omega_rad_s.value, OMEGA_RAD_S, 0.01);
    near("damping ratio", mode.damping_ratio.value, DAMPING_RATIO, 0.3);
    let all = MOTOR_KG_M2 + LOAD_KG_M2;
    near("share", mode.inertia_share.value, MOTOR_KG_M2 / all, 0.03);
    for (name, estimate, truth) in [
        ("inertia", found.inertia, all),
        ("viscous", found.viscous, VISCOUS),
        ("Coulomb", found.coulomb, COULOMB_NM),
    ] {
        let estimate: Estimate = estimate.unwrap();
        near(name, estimate.value, truth, 2e-3);
        assert!((estimate.value - truth).abs() < 5.0 * estimate.std, "{name}: {estimate:?}");
    }
    let [_, viscous, coulomb] = mode.moves;
    assert!(viscous.share < -0.03 && coulomb.share > 0.01, "{:?}", mode.moves);
}

#[test]
fn a_mode_that_no_tip_shows_is_found() {
    let found = identified();
    let codes: Vec<_> = found.findings.iter().map(Finding::code).collect();
    assert!(found.findings[0].is::<rows::ModesByTheMotor>(), "{codes:?}");
    let near = |name: &str, found: f64, truth: f64| near(name, found, truth, 0.01);
    let mode = found.beam.modes[0].natural_frequency_rad_s;
    near("mode", mode.value, OMEGA_RAD_S);
    near("inertia", found.inertia.unwrap().value, MOTOR_KG_M2);
    near("Coulomb", found.friction.coulomb.unwrap().value, COULOMB_NM);
    near("viscous", found.friction.viscous.unwrap().value, VISCOUS);
    let text = found.findings[0].message();
    assert!(text.contains("8.0 Hz") && text.contains("60 %"), "{text}");
}
