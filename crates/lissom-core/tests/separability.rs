//! The verdict: what logs separate, which run spoils what, and which to add.
#![expect(clippy::unwrap_used, clippy::print_stdout, reason = "tests")]

use lissom::arm::Arm;
use lissom::beam::{LumpedBeam, Span};
use lissom::drive::{Coulomb, Motor};
use lissom::identify::{ArmSource, Identified, Options, RunToAdd, Separability, identify};
use lissom::information::ArmParameter;
use lissom::record::{Axis, Campaign, Run, TimeBase};
use lissom::rig::{Amplifier, Experiment, Instruments, Noise, Pd, Quantiser, Rig, Sensor};

/// Little beside Coulomb friction \[N·m·s/rad\].
const VISCOUS: f64 = 1e-3;
/// Longest wait for a transient \[s\].
const LONGEST_S: f64 = 60.0;

fn instruments(bits: u32) -> Instruments {
    let quantiser = Quantiser::new(bits, std::f64::consts::TAU).unwrap();
    let noise = Some(Noise::new(0.5 * quantiser.step()).unwrap());
    let sensor = Sensor { noise, quantiser: Some(quantiser) };
    let mut instruments = Instruments::ideal(0.003).unwrap();
    instruments.motor = sensor;
    instruments.tips = vec![sensor];
    instruments.amplifier = Amplifier::ideal().with_limit(4.12).unwrap();
    instruments
}

fn rig(friction_nm: f64) -> Rig {
    let span = Span {
        length_m: 0.25,
        flexural_rigidity_n_m2: 0.02,
        mass_kg: 0.05,
        damping_n_s_per_m: 0.01,
    };
    let beam = LumpedBeam::new(&[span]).unwrap();
    let motor = Motor::new(2e-3, VISCOUS, 0.2).unwrap();
    let arm = Arm::new(beam, motor, Coulomb::symmetric(friction_nm).unwrap()).unwrap();
    Rig::new(arm, instruments(12), Pd::new(8.0, 0.25).unwrap().into())
}

fn sine(rig: &Rig, name: &str, omega_rad_s: f64, amplitude_rad: f64) -> Run {
    let experiment = Experiment::sine(omega_rad_s, amplitude_rad, 15.0).unwrap();
    rig.run(name, &experiment, 3).unwrap().run
}

fn found(rig: &Rig, runs: Vec<Run>) -> Identified {
    let campaign = Campaign::new(rig.channels(0..1).unwrap(), runs).unwrap();
    let id = identify(&campaign, &Options::default(), |_| ()).unwrap();
    for line in verdict(&id).words(Axis::Rotary) {
        println!("{line}");
    }
    id
}

fn verdict(id: &Identified) -> &Separability {
    id.separability.as_ref().unwrap()
}

fn std(verdict: &Separability, parameter: ArmParameter) -> f64 {
    verdict.parameters.iter().find(|f| f.parameter == parameter).unwrap().std
}

fn made(rig: &Rig, add: &RunToAdd) -> Run {
    let experiment = add.motion.experiment(add.amplitude_rad, add.record_s, LONGEST_S).unwrap();
    rig.run("added", &experiment, 7).unwrap().run
}

/// Without its tip: a rigid axis to who looks at the motor.
fn motor_alone(run: &Run) -> Run {
    let (command, motor) = (run.command().to_vec(), run.motor().to_vec());
    Run::new(run.name(), run.time(), command, motor, vec![]).unwrap()
}

fn rigid() -> Rig {
    let mut rig = rig(0.06);
    rig.instruments = instruments(10);
    let speck =
        Span { length_m: 0.01, flexural_rigidity_n_m2: 1.0, mass_kg: 1e-6, damping_n_s_per_m: 0.0 };
    rig.arm = Arm::new(LumpedBeam::new(&[speck]).unwrap(), rig.arm.motor, rig.arm.coulomb).unwrap();
    rig
}

/// One sine: friction that grows with speed is hardly told from friction that does not. The run that is
/// called for, made on the rig, keeps at least half of what was promised.
#[test]
fn the_run_to_add_tells_what_one_sine_does_not() {
    let rig = rigid();
    let one = |runs: &[Run]| {
        let runs = runs.iter().map(motor_alone).collect();
        let campaign = Campaign::new(rig.channels(0..0).unwrap(), runs).unwrap();
        let id = identify(&campaign, &Options::default(), |_| ()).unwrap();
        for line in verdict(&id).words(Axis::Rotary) {
            println!("{line}");
        }
        id
    };
    let mut runs = vec![sine(&rig, "one", 4.0, 0.3)];
    let before = one(&runs);
    let before = verdict(&before);
    assert_eq!(before.source, ArmSource::OutputError);
    let worst: Vec<ArmParameter> = before.directions[0].parts.iter().map(|p| p.parameter).collect();
    assert_eq!(
        worst[..2],
        [ArmParameter::Viscous, ArmParameter::Coulomb],
        "{:?}",
        before.directions[0]
    );
    let parts = &before.directions[0].parts;
    assert!(parts[0].weight * parts[1].weight < 0.0);
    let add = before.run_to_add.unwrap();
    assert_eq!(add.parameter, ArmParameter::Viscous);
    assert!((add.std_now / std(before, ArmParameter::Viscous) - 1.0).abs() < 1e-9);
    runs.push(made(&rig, &add));
    let after = one(&runs);
    let achieved = std(verdict(&after), ArmParameter::Viscous);
    println!("{:.3e} promised {:.3e} achieved {achieved:.3e}", add.std_now, add.std_then);
    assert!(add.std_now - achieved > 0.5 * (add.std_now - add.std_then));
}

#[test]
fn the_run_that_spoils_is_named() {
    let (sound, rubs) = (rig(0.06), rig(0.12));
    let at = [(2.0, 0.8), (4.0, 0.6), (9.0, 0.3), (12.0, 0.25)];
    let runs = |odd: &dyn Fn(usize, Run) -> Run| {
        let run = |(i, (omega, amplitude)): (usize, &(f64, f64))| {
            odd(i, sine(&sound, &format!("sine {i}"), *omega, *amplitude))
        };
        at.iter().enumerate().map(run).collect::<Vec<Run>>()
    };
    let spoilers = |id: &Identified| {
        let all = id.findings.iter().filter(|f| f.code() == "run-stands-out");
        all.map(|f| f.run.clone().unwrap()).collect::<Vec<String>>()
    };
    println!("sound");
    assert!(spoilers(&found(&sound, runs(&|_, run| run))).is_empty());
    println!("friction doubled");
    let doubled = |i: usize, run: Run| {
        if i == 1 { sine(&rubs, run.name(), at[1].0, at[1].1) } else { run }
    };
    assert_eq!(spoilers(&found(&sound, runs(&doubled))), ["sine 1"]);
    println!("a tip's scale off by 3 %");
    let scaled = |i: usize, run: Run| {
        if i != 2 {
            return run;
        }
        let tip = run.tips()[0].iter().map(|t| 1.03 * t).collect();
        let (command, motor) = (run.command().to_vec(), run.motor().to_vec());
        Run::new(run.name(), run.time(), command, motor, vec![tip]).unwrap()
    };
    assert_eq!(spoilers(&found(&sound, runs(&scaled))), ["sine 2"]);
}

/// A stroke forward alone does not tell friction from a load.
#[test]
fn what_one_direction_does_not_tell_is_named() {
    let rig = rigid();
    let stroke = |omega_rad_s: f64| {
        let run = motor_alone(&sine(&rig, &format!("{omega_rad_s}"), omega_rad_s, 0.8));
        // From 0.3π before a crest of the speed to as much after.
        let sample_time_s = run.sample_time_s();
        let speed = |k: &usize| run.motor()[k + 20] - run.motor()[k - 20];
        let half = (0.3 * std::f64::consts::PI / omega_rad_s / sample_time_s) as usize;
        let all = half..run.len() - half;
        let middle = all.max_by(|a, b| speed(a).total_cmp(&speed(b))).unwrap();
        let part = middle - half..middle + half;
        let (command, motor) = (run.command()[part.clone()].to_vec(), run.motor()[part].to_vec());
        Run::new(run.name(), TimeBase::uniform(0.0, sample_time_s), command, motor, vec![]).unwrap()
    };
    let runs = [0.9, 1.4, 2.0, 2.7].map(stroke).to_vec();
    let campaign = Campaign::new(rig.channels(0..0).unwrap(), runs).unwrap();
    let id = identify(&campaign, &Options::default(), |_| ()).unwrap();
    let verdict = verdict(&id);
    println!("{:#?}", verdict.words(Axis::Rotary));
    assert_eq!(verdict.source, ArmSource::Regression);
    assert!(verdict.condition.is_infinite() && verdict.run_to_add.is_none());
    let worst = &verdict.directions[0];
    assert!(worst.std.is_infinite());
    let parts: Vec<ArmParameter> = worst.parts.iter().map(|p| p.parameter).collect();
    assert!(
        parts.len() == 2
            && parts.contains(&ArmParameter::Coulomb)
            && parts.contains(&ArmParameter::Offset)
    );
    // Inertia is still reported, with the standard error of the table.
    let stated = id.inertia.unwrap();
    assert!((std(verdict, ArmParameter::Inertia) / (stated.std / stated.value) - 1.0).abs() < 1e-9);
}
