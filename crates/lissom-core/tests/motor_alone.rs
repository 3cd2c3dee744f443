//! A flexible arm of which the motor alone is measured.
#![expect(clippy::unwrap_used, clippy::print_stdout, reason = "tests")]

use lissom::arm::Arm;
use lissom::beam::{LumpedBeam, Span};
use lissom::drive::{Coulomb, Motor};
use lissom::identify::findings::{Finding, rows};
use lissom::identify::{
    ArmSource, Effort, Estimate, Identified, Interrupt, Options, OutputErrorStart, Prepared,
    identify, output_error,
};
use lissom::record::{Campaign, Run};
use lissom::replay::{ModalArm, Oscillator, Parameter};
use lissom::rig::{Amplifier, Experiment, Instruments, Noise, Pd, Quantiser, Rig, Sensor, Settle};

/// Further from the truth than this is no estimate of it.
const DEVIATIONS: f64 = 4.0;

/// One mass at the end of a beam.
fn rig(length_m: f64, mass_kg: f64) -> Rig {
    let damping_n_s_per_m = 0.02 * mass_kg;
    let span = Span { length_m, flexural_rigidity_n_m2: 0.02, mass_kg, damping_n_s_per_m };
    let motor = Motor::new(8e-4, 2e-3, 0.3).unwrap();
    let coulomb = Coulomb::symmetric(0.04).unwrap();
    let arm = Arm::new(LumpedBeam::new(&[span]).unwrap(), motor, coulomb).unwrap();
    let quantiser = Quantiser::new(13, std::f64::consts::TAU).unwrap();
    let noise = Some(Noise::new(0.5 * quantiser.step()).unwrap());
    let mut instruments = Instruments::ideal(0.002).unwrap();
    instruments.motor = Sensor { noise, quantiser: Some(quantiser) };
    instruments.amplifier = Amplifier::ideal().with_limit(6.0).unwrap();
    Rig::new(arm, instruments, Pd::new(8.0, 0.15).unwrap().into())
}

fn sines(rig: &Rig) -> Vec<Run> {
    let sine = |&omega_rad_s: &f64| {
        let sine = Experiment::sine(omega_rad_s, 0.5, (40.0 / omega_rad_s).max(6.0)).unwrap();
        let sine = sine.settling(Settle::Wait { wait_s: 20.0 });
        rig.run(&format!("{omega_rad_s} rad/s"), &sine, 5).unwrap().run
    };
    [1.5, 3.0, 4.5, 9.0, 12.0, 20.0, 36.0].iter().map(sine).collect()
}

/// Without the tips' readings.
fn alone(rig: &Rig, runs: &[Run]) -> Campaign {
    let alone = |run: &Run| {
        let (command, motor) = (run.command().to_vec(), run.motor().to_vec());
        Run::new(run.name(), run.time(), command, motor, vec![]).unwrap()
    };
    Campaign::new(rig.channels(0..0).unwrap(), runs.iter().map(alone).collect()).unwrap()
}

fn found(rig: &Rig, runs: &[Run]) -> Identified {
    identify(&alone(rig, runs), &Options::default(), |_| ()).unwrap()
}

/// Within some standard errors, and within a share of the truth.
fn is(name: &str, found: Option<Estimate>, truth: f64, share: f64) {
    let found = found.unwrap();
    let off = found.value - truth;
    println!("{name} {truth:.6e} off by {:.1e}, {:.1} deviations", off / truth, off / found.std);
    assert!(off.abs() < DEVIATIONS * found.std && off.abs() < share * truth, "{name} {found:?}");
}

fn are_the_arms(id: &Identified, rig: &Rig) {
    let arm = ModalArm::of_arm(&rig.arm).unwrap();
    assert_eq!(id.arm.as_ref().unwrap().source, ArmSource::OutputError);
    assert_eq!(id.beam.modes.len(), arm.modes.len());
    is("Coulomb", id.friction.coulomb, arm.coulomb_nm, 1e-3);
    is("inertia", id.inertia, arm.inertia_kg_m2, 1e-2);
    is("coupling", id.beam.coupling, arm.coupling_nm_per_rad(), 1e-2);
    is("viscous", id.friction.viscous, arm.viscous_nm_s_per_rad[0], 5e-2);
    for (found, truth) in id.beam.modes.iter().zip(&arm.modes) {
        is("frequency", Some(found.natural_frequency_rad_s), truth.omega_rad_s, 2e-3);
    }
    assert!(id.findings.iter().any(Finding::is::<rows::ModesByTheMotor>), "{:?}", id.findings);
}

#[test]
fn sines_tell_one_mode() {
    let rig = rig(0.3, 0.08);
    are_the_arms(&found(&rig, &sines(&rig)), &rig);
}

#[test]
fn a_stiff_axis_has_no_modes() {
    let rig = rig(0.005, 1e-6);
    let id = found(&rig, &sines(&rig));
    assert!(id.beam.modes.is_empty(), "{:?}", id.beam.modes);
    is("Coulomb", id.friction.coulomb, 0.04, 1e-3);
    is("inertia", id.inertia, 8e-4, 1e-2);
}

/// An axis that is stiff, begun with a mode that is none: a lag, as overdamped as one can be.
#[test]
fn a_mode_that_is_none_goes() {
    let rig = rig(0.005, 1e-6);
    let campaign = alone(&rig, &sines(&rig));
    let mut arm = ModalArm::of_arm(&rig.arm).unwrap();
    arm.shapes.clear();
    arm.at_points_per_s.clear();
    arm.modes = vec![Oscillator {
        omega_rad_s: 40.0,
        stiffness_nm_per_rad: 0.02,
        within_per_s: 80.0,
        grounded_per_s: 0.0,
    }];
    let start = OutputErrorStart {
        shown_rad_s: Vec::new(),
        further_terms: Vec::new(),
        most_evaluations: Effort::Thorough.most_evaluations(),
        interrupt: Interrupt::default(),
        arms: vec![arm],
        omega_rad_s: vec![None; campaign.runs.len()],
        first_window_s: None,
    };
    let found = output_error(&Prepared::of(&campaign), &start).unwrap();
    assert!(found.arm.modes.is_empty(), "{:?}", found.arm.modes);
    let truth = 8e-4;
    let inertia = found.estimate(Parameter::Inertia).unwrap();
    assert!((inertia.value - truth).abs() < DEVIATIONS * inertia.std + 1e-3 * truth, "{inertia:?}");
}
