//! Simulate, identify, recover: arms, channels and motions unlike the demo's.
#![expect(clippy::unwrap_used, reason = "tests")]

use lissom::arm::Arm;
use lissom::beam::{Damping, LumpedBeam, Span};
use lissom::drive::{Coulomb, Motor};
use lissom::identify::{
    Effort, Estimate, Identified, LagShape, MissingKind, MissingTerm, Options, identify,
};
use lissom::record::{
    Axis, Campaign, Channels, Command, CommandQuantity, Hold, Run, TimeBase, Tip, TipQuantity,
};
use lissom::rig::{Amplifier, Experiment, Hybrid, Instruments, Pd, Quantiser, Rig, Sensor, Settle};

/// Two unequal masses, friction by direction: modes at 7.9 and 41 rad/s.
fn two_mass_arm() -> Arm {
    let span = |length_m, mass_kg| Span {
        length_m,
        flexural_rigidity_n_m2: 0.02,
        mass_kg,
        damping_n_s_per_m: 0.02 * mass_kg,
    };
    let beam = LumpedBeam::new(&[span(0.15, 0.06), span(0.15, 0.04)]).unwrap();
    let motor = Motor::new(8e-4, 2e-3, 0.3).unwrap();
    Arm::new(beam, motor, Coulomb::by_direction(0.05, 0.04).unwrap()).unwrap()
}

fn rig(arm: Arm) -> Rig {
    let sensor = Sensor::from(Quantiser::new(14, std::f64::consts::TAU).unwrap());
    let mut instruments = Instruments::ideal(0.002).unwrap();
    instruments.motor = sensor;
    instruments.tips = vec![sensor];
    instruments.amplifier = Amplifier::ideal().with_limit(6.0).unwrap();
    Rig::new(arm, instruments, Pd::new(8.0, 0.15).unwrap().into())
}

fn runs(rig: &Rig) -> Vec<Run> {
    [1.5, 3.0, 4.5, 9.0, 12.0, 20.0, 36.0]
        .iter()
        .map(|&omega_rad_s| {
            let sine = Experiment::sine(omega_rad_s, 0.5, (40.0 / omega_rad_s).max(6.0)).unwrap();
            let sine = sine.settling(Settle::Wait { wait_s: 20.0 });
            rig.run(&format!("{omega_rad_s} rad/s"), &sine, 0).unwrap().run
        })
        .collect()
}

fn current(k: f64) -> Command {
    Command {
        quantity: CommandQuantity::Current,
        hold: Hold::Sampled,
        torque_per_command: Some(k),
        back_emf_viscous: 0.0,
        limit: None,
    }
}

fn tip(name: &str, quantity: TipQuantity) -> Tip {
    Tip { name: name.to_owned(), quantity, calibrated: true }
}

fn campaign(command: Command, runs: Vec<Run>) -> Campaign {
    Campaign::new(Channels { axis: Axis::Rotary, command, tips: vec![] }, runs).unwrap()
}

fn identified(command: Command, axis: Axis, tips: Vec<Tip>, runs: Vec<Run>) -> Identified {
    let campaign = Campaign::new(Channels { axis, command, tips }, runs).unwrap();
    identify(&campaign, &Options::default(), |_| {}).unwrap()
}

#[track_caller]
fn within(what: &str, found: Option<Estimate>, truth: f64, tolerance: f64) {
    let found = found.unwrap_or_else(|| panic!("{what} is refused"));
    let error = (found.value / truth - 1.0).abs();
    assert!(error < tolerance, "{what}: {found:?}, true {truth}");
}

#[test]
fn two_masses_with_friction_by_direction() {
    let arm = two_mass_arm();
    let tips = vec![tip("1", TipQuantity::Angle), tip("2", TipQuantity::Angle)];
    let id = identified(current(0.3), Axis::Rotary, tips, runs(&rig(arm.clone())));
    within("inertia", id.inertia, 8e-4, 0.01);
    within("viscous", id.friction.viscous, 2e-3, 0.05);
    within("forward", id.friction.forward, 0.05, 0.005);
    within("backward", id.friction.backward, 0.04, 0.005);
    within("offset", id.friction.offset, 0.005, 0.02);
    within("coupling", id.beam.coupling, arm.dynamics().coupling_motor, 0.01);
    for (i, h) in arm.dynamics().coupling.iter().enumerate() {
        within("coupling by tip", id.beam.coupling_by_tip[i], -h, 0.02);
    }
    let truth = arm.beam().natural_frequencies_rad_s();
    assert_eq!(id.beam.modes.len(), 2, "{:?}", id.beam.modes);
    for (mode, truth) in id.beam.modes.iter().zip(truth) {
        within("mode", Some(mode.natural_frequency_rad_s), truth, 0.002);
    }
}

/// Without a replay each mode has a damping ratio of its own.
#[test]
fn two_masses_have_a_ratio_each() {
    let span = |mass_kg| Span {
        length_m: 0.15,
        flexural_rigidity_n_m2: 0.02,
        mass_kg,
        damping_n_s_per_m: 0.0,
    };
    let ratios = [0.01, 0.02];
    let beam = LumpedBeam::new(&[span(0.06), span(0.04)]).unwrap();
    let beam = beam.with_damping(Damping::Modal { ratios: ratios.to_vec() }).unwrap();
    let motor = Motor::new(8e-4, 2e-3, 0.3).unwrap();
    let arm = Arm::new(beam, motor, Coulomb::symmetric(0.045).unwrap()).unwrap();
    let tips = vec![tip("1", TipQuantity::Angle), tip("2", TipQuantity::Angle)];
    let channels = Channels { axis: Axis::Rotary, command: current(0.3), tips };
    let campaign = Campaign::new(channels, runs(&rig(arm))).unwrap();
    let options = Options { effort: Effort::Quick, ..Options::default() };
    let id = identify(&campaign, &options, |_| ()).unwrap();
    for (mode, truth) in id.beam.modes.iter().zip(ratios) {
        let found = mode.damping_ratio;
        assert!((found.value - truth).abs() < 4.0 * found.std, "{found:?}");
        assert!(found.std < 0.05 * truth, "{found:?}");
    }
}

#[test]
fn deflections_say_the_same_as_angles() {
    let arm = two_mass_arm();
    let runs: Vec<Run> = runs(&rig(arm))
        .into_iter()
        .map(|r| {
            let minus = |tip: &Vec<f64>| tip.iter().zip(r.motor()).map(|(t, m)| t - m).collect();
            let tips = r.tips().iter().map(minus).collect();
            Run::new(r.name(), r.time(), r.command().to_vec(), r.motor().to_vec(), tips).unwrap()
        })
        .collect();
    let tips = vec![tip("1", TipQuantity::Deflection), tip("2", TipQuantity::Deflection)];
    let id = identified(current(0.3), Axis::Rotary, tips, runs);
    within("inertia", id.inertia, 8e-4, 0.01);
    let truth = two_mass_arm().beam().natural_frequencies_rad_s();
    for (mode, truth) in id.beam.modes.iter().zip(truth) {
        within("mode", Some(mode.natural_frequency_rad_s), truth, 0.002);
    }
}

/// An axis whose beam weighs nothing, with Coulomb friction under a held random-like command: no sine anywhere.
fn stiff_axis(constant: f64, back_emf: f64) -> Vec<Run> {
    let span = Span {
        length_m: 0.01,
        flexural_rigidity_n_m2: 1e-9,
        mass_kg: 1e-9,
        damping_n_s_per_m: 0.0,
    };
    let motor = Motor::new(2e-3, 0.01 + back_emf, constant).unwrap();
    let arm = Arm::new(LumpedBeam::new(&[span]).unwrap(), motor, Coulomb::symmetric(0.06).unwrap())
        .unwrap();
    let t = 0.005;
    (0..3)
        .map(|run| {
            let mut motion = Hybrid::at_rest(&arm);
            let (mut u, mut theta) = (Vec::new(), Vec::new());
            for k in 0..2400 {
                let s = f64::from(k) * t;
                let phase = f64::from(run);
                let drive = 0.9 * (1.1 * s + phase).sin()
                    + 0.7 * (2.9 * s + 2.0 * phase).cos()
                    + 0.5 * (7.3 * s + 3.0 * phase).sin();
                theta.push((motion.state()[0] / 1e-4).round() * 1e-4);
                u.push(drive);
                motion.advance(constant * drive, t);
            }
            Run::new(format!("run {run}"), TimeBase::uniform(0.0, t), u, theta, vec![]).unwrap()
        })
        .collect()
}

#[test]
fn any_motion_and_a_voltage_with_back_emf() {
    // τ = 0.2·v − 0.03·θ̇: the drive's own viscous friction is what is left of 0.04.
    let command =
        Command { quantity: CommandQuantity::Voltage, back_emf_viscous: 0.03, ..current(0.2) };
    let id = identified(command, Axis::Rotary, vec![], stiff_axis(0.2, 0.03));
    within("inertia", id.inertia, 2e-3, 0.01);
    within("viscous", id.friction.viscous, 0.01, 0.05);
    within("coulomb", id.friction.coulomb, 0.06, 0.01);
    assert!(id.third_harmonic.is_none());
}

/// The result without the output-error method.
fn quick(campaign: &Campaign) -> Identified {
    let options = Options { effort: Effort::Quick, ..Options::default() };
    identify(campaign, &options, |_| ()).unwrap()
}

#[test]
fn a_delay_is_noticed_and_measured() {
    // The command as logged acts two samples of 5 ms later.
    let late: Vec<Run> = stiff_axis(0.2, 0.0)
        .into_iter()
        .map(|r| {
            let n = r.len() - 2;
            let (command, motor) = (r.command()[2..].to_vec(), r.motor()[..n].to_vec());
            Run::new(r.name(), r.time(), command, motor, vec![]).unwrap()
        })
        .collect();
    let law = |runs| quick(&campaign(current(0.2), runs)).friction_law.unwrap();
    let in_time = law(stiff_axis(0.2, 0.0));
    assert!(in_time.missing.is_empty() && in_time.lag.is_none());
    let found = law(late.clone());
    let lag = found.lag.unwrap();
    assert_eq!(lag.shape, LagShape::Delay);
    assert!((lag.time_s / 0.010 - 1.0).abs() < 0.01 && (lag.samples - 2.0).abs() < 0.02, "{lag:?}");
    // Its estimates count it.
    within("inertia", found.chosen.inertia, 2e-3, 0.01);
    within("coulomb", found.chosen.coulomb, 0.06, 0.01);

    // The output error counts it in all estimates.
    let id = identified(current(0.2), Axis::Rotary, vec![], late);
    assert!(id.findings.iter().any(|f| f.code() == "command-lag"));
    let lag_s = id.arm.as_ref().unwrap().arm.command_lag_s;
    assert!((lag_s - 0.010).abs() < 1e-4, "{lag_s}");
    within("inertia", id.inertia, 2e-3, 1e-3);
    within("coulomb", id.friction.coulomb, 0.06, 1e-3);
}

#[test]
fn an_amplifier_that_is_stronger_one_way_is_noticed_and_measured() {
    // Positive commands are logged as less than they do.
    let as_logged = |share: f64| -> Vec<Run> {
        let runs = stiff_axis(0.2, 0.0).into_iter();
        let of_run = |r: Run| {
            let command = r.command().iter().map(|u| if *u > 0.0 { u * share } else { *u });
            Run::new(r.name(), r.time(), command.collect(), r.motor().to_vec(), vec![]).unwrap()
        };
        runs.map(of_run).collect()
    };
    for share in [0.95, 0.99] {
        let law = quick(&campaign(current(0.2), as_logged(share))).friction_law.unwrap();
        let by_sign = |m: &&MissingTerm| m.kind == MissingKind::CommandBySign;
        let found = law.missing.iter().find(by_sign).unwrap();
        // 1/share one way beside 1 the other: (1 + ε)/(1 − ε).
        let asked = (1.0 / share - 1.0) / (1.0 / share + 1.0);
        assert!((found.value / asked - 1.0).abs() < 0.05, "{found:?} {asked}");
    }
}

#[test]
fn friction_that_changes_over_the_campaign_is_noticed_and_measured() {
    // J = 0.02, V = 0.05, CF = 0.3 in the middle: a sine and one of another frequency after it.
    let t = 0.002;
    let with = |coulomb: f64, viscous: f64| {
        let run = |name: &str, w: f64, from: f64| {
            let angle = |s: f64| (w * s).sin();
            let torque = |s: f64| {
                let (speed, over) = (w * (w * s).cos(), (s + from) / 40.0 - 0.5);
                -0.02 * w * w * angle(s)
                    + (0.05 + viscous * over) * speed
                    + (0.3 + coulomb * over) * speed.signum()
            };
            let wave = |f: &dyn Fn(f64) -> f64| (0..10_000).map(|k| f(t * f64::from(k))).collect();
            Run::new(name, TimeBase::uniform(0.0, t), wave(&torque), wave(&angle), vec![]).unwrap()
        };
        let runs = vec![run("slow", 3.0, 0.0), run("fast", 7.0, 20.0)];
        let command = Command { hold: Hold::Measured, ..current(1.0) };
        quick(&campaign(command, runs)).friction_law.unwrap().missing
    };
    assert_eq!(with(0.0, 0.0), []);
    for (coulomb, viscous, kind, asked) in [
        (-0.06, 0.0, MissingKind::CoulombDrift, -0.06),
        (0.0, -0.03, MissingKind::ViscousDrift, -0.03),
    ] {
        let found = with(coulomb, viscous);
        let found = found.iter().find(|m| m.kind == kind).unwrap();
        assert!((found.value / asked - 1.0).abs() < 0.01, "{found:?} {asked}");
    }
}

#[test]
fn unknown_constant_gives_figures_per_unit_of_command() {
    let command =
        Command { quantity: CommandQuantity::Arbitrary, torque_per_command: None, ..current(1.0) };
    let id = identified(command, Axis::Linear, vec![], stiff_axis(0.2, 0.0));
    within("inertia", id.inertia, 2e-3 / 0.2, 0.01);
    within("coulomb", id.friction.coulomb, 0.06 / 0.2, 0.01);
    assert!(id.findings.iter().any(|f| f.code() == "per-unit-of-command"));
}

#[test]
fn one_direction_tells_friction_with_the_load_only() {
    let runs: Vec<Run> = stiff_axis(0.2, 0.0)
        .into_iter()
        .flat_map(|r| {
            // A constant push large enough that the axis never turns back, its angle a ramp more.
            let t = r.sample_time_s();
            let ramp = |k: usize| 40.0 * k as f64 * t;
            let motor: Vec<f64> = r.motor().iter().enumerate().map(|(k, x)| x + ramp(k)).collect();
            assert!(motor.windows(2).all(|w| w[1] > w[0]), "{} turns back", r.name());
            // The torque that goes with the ramp: V·40 at 0.01, and friction always forward.
            let command: Vec<f64> = r.command().iter().map(|u| u + 2.0).collect();
            // Halves, each one slip phase: three would be too few to tell a scatter.
            let half = r.len() / 2;
            [0..half, half..r.len()].map(|part| {
                let name = format!("{} from {}", r.name(), part.start);
                let (command, motor) = (command[part.clone()].to_vec(), motor[part].to_vec());
                Run::new(name, TimeBase::uniform(0.0, t), command, motor, vec![]).unwrap()
            })
        })
        .collect();
    let id = identified(current(0.2), Axis::Rotary, vec![], runs);
    assert!(id.friction.coulomb.is_none() && id.friction.offset.is_none());
    let refused = id
        .findings
        .iter()
        .any(|f| f.code() == "friction-with-load" && f.affects().contains(&"friction.coulomb"));
    assert!(refused, "{:?}", id.findings);
    assert!(id.friction.forward.is_some() && id.friction.backward.is_none());
}

#[test]
fn a_tip_dead_in_every_run_is_left_out() {
    let runs: Vec<Run> = stiff_axis(0.2, 0.0)
        .into_iter()
        .map(|r| {
            let still = vec![vec![0.0; r.len()]];
            Run::new(r.name(), r.time(), r.command().to_vec(), r.motor().to_vec(), still).unwrap()
        })
        .collect();
    let id = identified(current(0.2), Axis::Rotary, vec![tip("gauge", TipQuantity::Angle)], runs);
    within("inertia", id.inertia, 2e-3, 0.01);
    assert!(id.beam.coupling.is_none() && id.beam.modes.is_empty());
    assert!(id.findings.iter().any(|f| f.code() == "dead-channel" && f.run.is_none()));
}

#[test]
fn a_motor_that_never_moves_is_an_error() {
    let still = Run::new("a", TimeBase::uniform(0.0, 0.01), vec![1.0; 100], vec![2.0; 100], vec![]);
    let channels = Channels { axis: Axis::Rotary, command: current(1.0), tips: vec![] };
    let campaign = Campaign::new(channels, vec![still.unwrap()]).unwrap();
    let error = identify(&campaign, &Options::default(), |_| {}).unwrap_err();
    assert_eq!(
        error.to_string(),
        "every run has a constant channel: motor in 1 of 1, command in 1 of 1"
    );
}
