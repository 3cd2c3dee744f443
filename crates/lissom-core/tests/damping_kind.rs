//! Damping within the beam and damping against the frame: told apart where the runs tell them, said where they do
//! not, and both in the models that a result gives.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use lissom::arm::Arm;
use lissom::beam::{Damping, LumpedBeam, Span};
use lissom::identify::{Estimate, Identified, ModelSource, Options, identify};
use lissom::record::{
    Axis, Campaign, Channels, Command, CommandQuantity, Hold, Run, Tip, TipQuantity,
};
use lissom::replay::ModalArm;
use lissom::rig::{Drive, Experiment, Reference, Rig, Settle, Sweep};

fn sine(rig: &Rig, omega_rad_s: f64, amplitude_rad: f64) -> Run {
    let sine = Experiment::sine(omega_rad_s, amplitude_rad, 12.0).unwrap();
    rig.run("sine", &sine.settling(Settle::Wait { wait_s: 60.0 }), 0).unwrap().run
}

fn identified(runs: Vec<Run>) -> Identified {
    let command = Command {
        quantity: CommandQuantity::Current,
        hold: Hold::Sampled,
        torque_per_command: Some(lissom_testmodels::report_arm().motor.torque_constant_nm_per_a()),
        back_emf_viscous: 0.0,
        limit: Some(4.12),
    };
    let tip = Tip { name: "tip".to_owned(), quantity: TipQuantity::Angle, calibrated: true };
    let channels = Channels { axis: Axis::Rotary, command, tips: vec![tip] };
    identify(&Campaign::new(channels, runs).unwrap(), &Options::default(), |_| ()).unwrap()
}

fn standard_errors(found: Estimate, truth: f64) -> f64 {
    (found.value - truth).abs() / found.std
}

/// The arm's damper stands against the frame. One steady sine leaves the same with damping within the beam, and a
/// damping ratio of half the size; with a second sine there is no doubt.
#[test]
fn one_steady_sine_does_not_tell_the_dampings_apart() {
    let rig = lissom_testmodels::report_rig(Some(12));
    let truth = ModalArm::of_arm(&rig.arm).unwrap();
    let (ratio, viscous) = (truth.damping_ratios()[0], truth.viscous_nm_s_per_rad[0]);
    let one = vec![sine(&rig, 25.0, 0.2)];
    let two = vec![sine(&rig, 25.0, 0.2), sine(&rig, 9.3, 0.5)];
    for (runs, doubtful) in [(one, true), (two, false)] {
        let found = identified(runs);
        assert!(found.output_error.as_ref().unwrap().whole_runs);
        let said = found.findings.iter().any(|f| f.code() == "damping-kind");
        assert_eq!(said, doubtful, "{:?}", found.findings);
        let damping = found.beam.modes[0].damping_ratio;
        assert!(standard_errors(damping, ratio) < 4.0, "{damping:?}, true {ratio}");
        assert_eq!(damping.std > 0.2 * ratio, doubtful, "{damping:?}");
        let friction = found.friction.viscous.unwrap();
        assert!(standard_errors(friction, viscous) < 4.0, "{friction:?}, true {viscous}");
    }
}

/// The report's arm with its damping within the beam: the models respond as the arm does, where rational functions
/// with damping against the frame cannot. Their standard errors are those of the response.
#[test]
fn models_have_the_damping_that_the_arm_has() {
    let mut rig = lissom_testmodels::report_rig(Some(14));
    let report = lissom_testmodels::report_arm();
    let span = Span { damping_n_s_per_m: 0.0, ..undamped_span() };
    let damping = Damping::Proportional { mass_per_s: 0.0, stiffness_s: 4e-3 };
    let beam = LumpedBeam::new(&[span]).unwrap().with_damping(damping).unwrap();
    rig.arm = Arm::new(beam, report.motor, report.coulomb).unwrap();
    let sweep = Reference::chirp(Sweep::Logarithmic, (1.0, 40.0), 0.3, 20.0).unwrap();
    let sweep = Experiment::new(Drive::Angle(sweep), 20.0).unwrap();
    let sweep = rig.run("sweep", &sweep.settling(Settle::AtOnce), 0).unwrap().run;
    let found = identified(vec![sweep, sine(&rig, 3.1, 0.7)]);
    let models = &found.models;
    assert_eq!(models.source, ModelSource::Arm);
    for omega_rad_s in [1.0, 4.0, 6.6, 10.0, 13.0, 30.0] {
        let exact = rig.arm.motor_response(omega_rad_s);
        let model = models.motor.as_ref().unwrap().response(omega_rad_s);
        assert!((model / exact - 1.0).norm() < 3e-3, "{omega_rad_s}: {model}, exact {exact}");
        let error = models.motor_covariance.as_ref().unwrap();
        let error = error.of_response(models.motor.as_ref().unwrap(), omega_rad_s).unwrap();
        let departs = (models.motor_response(omega_rad_s).unwrap() / exact).ln();
        let sizes = [departs.re / error.relative_magnitude, departs.im / error.phase_rad];
        assert!(sizes.iter().all(|z| z.abs() < 4.0), "{omega_rad_s}: {sizes:?} of {error:?}");
        assert!(error.relative_magnitude < 3e-3 && error.phase_rad < 3e-3, "{error:?}");
        let exact_tip = rig.arm.tip_response(omega_rad_s)[0];
        let tip = models.tips[0].function.response(omega_rad_s);
        assert!((tip / exact_tip - 1.0).norm() < 3e-3, "{omega_rad_s}: {tip}, exact {exact_tip}");
        let whole = models.state_space.as_ref().unwrap().response(omega_rad_s).unwrap();
        assert!((whole[0] / exact - 1.0).norm() < 3e-3, "{omega_rad_s}");
        assert!((whole[1] / (exact * exact_tip) - 1.0).norm() < 3e-3, "{omega_rad_s}");
    }
}

/// A beam of two masses of which the outer one is measured, with damping of both kinds: the search for the second mode keeps the
/// damping against the frame that it found with one mode. Without it no second mode describes the tip.
#[test]
fn a_further_mode_leaves_the_damping_against_the_frame() {
    let mut rig = lissom_testmodels::report_rig(Some(14));
    let report = lissom_testmodels::report_arm();
    let whole = undamped_span();
    let half = |mass_share: f64| Span {
        length_m: 0.5 * whole.length_m,
        mass_kg: mass_share * whole.mass_kg,
        damping_n_s_per_m: 0.0,
        ..whole
    };
    let damping = Damping::Proportional { mass_per_s: 0.3, stiffness_s: 1e-3 };
    let beam = LumpedBeam::new(&[half(0.4), half(0.8)]).unwrap().with_damping(damping).unwrap();
    rig.arm = Arm::new(beam, report.motor, report.coulomb).unwrap();
    rig.instruments.tips = vec![rig.instruments.motor; 2];
    let truth = rig.arm.beam().natural_frequencies_rad_s();
    let sweep = Reference::chirp(Sweep::Logarithmic, (1.0, 60.0), 0.3, 20.0).unwrap();
    let sweep = Experiment::new(Drive::Angle(sweep), 20.0).unwrap().settling(Settle::AtOnce);
    let run = rig.run("sweep", &sweep, 0).unwrap().run;
    let outer = vec![run.tips()[1].clone()];
    let (command, motor) = (run.command().to_vec(), run.motor().to_vec());
    let found = identified(vec![Run::new("sweep", run.time(), command, motor, outer).unwrap()]);
    assert_eq!(found.beam.modes.len(), 2, "{:?}", found.findings);
    for (mode, omega_rad_s) in found.beam.modes.iter().zip(&truth) {
        let ratio = 0.5 * (0.3 / omega_rad_s + 1e-3 * omega_rad_s);
        let (damping, omega) = (mode.damping_ratio, mode.natural_frequency_rad_s);
        assert!(standard_errors(damping, ratio) < 5.0, "{damping:?}, true {ratio}");
        assert!(standard_errors(omega, *omega_rad_s) < 5.0, "{omega:?}, true {omega_rad_s}");
    }
}

/// The report's span.
fn undamped_span() -> Span {
    let beam = lissom_testmodels::report_arm();
    match beam.beam() {
        lissom::beam::Beam::Lumped(beam) => beam.spans()[0],
        lissom::beam::Beam::Modal(_) | lissom::beam::Beam::Rigid => {
            panic!("the arm of the report has a point mass")
        }
    }
}
