use super::*;
use crate::arm::Arm;
use crate::beam::Beam;
use crate::drive::{Coulomb, DryFriction, Motor};
use crate::identify::findings::{Severity, rows};
use crate::identify::found_arm::{ArmSource, TorqueUsed};
use crate::identify::methods::friction_law::LagShape;
use crate::identify::validation::thresholds::GOOD_PREDICTION;
use crate::load::{GravityLoad, TorqueRipple};
use crate::record::{
    Axis, Channels, Command, CommandQuantity, Hold, Run, TimeBase, Tip, TipQuantity,
};
use crate::replay::{DryTerms, ModalArm, Oscillator, Root, Window, WithLoad};
use crate::rig::Hybrid;

/// Sample time of the logs \[s\].
const T: f64 = 0.002;
/// Step of the motor's sensor \[rad\].
const STEP: f64 = 1e-4;

fn rigid() -> ModalArm {
    ModalArm {
        inertia_kg_m2: 0.02,
        viscous_nm_s_per_rad: [0.05, 0.05],
        coulomb_nm: 0.3,
        offset_nm: 0.02,
        modes: Vec::new(),
        shapes: Vec::new(),
        at_points_per_s: Vec::new(),
        dry_terms: DryTerms::default(),
        gravity: None,
        torque_ripples: Vec::new(),
        command_lag_s: 0.0,
        tip_lags_s: Vec::new(),
    }
}

fn found(arm: ModalArm) -> FoundArm {
    let torque_used = Some(TorqueUsed { relative_error: 0.01, window_s: 0.04 });
    FoundArm {
        lag_shape: LagShape::Delay,
        arm,
        coupling_alone_nm_per_rad: Vec::new(),
        source: ArmSource::Regression,
        torque_used,
    }
}

fn channels() -> Channels {
    let command = Command {
        quantity: CommandQuantity::Current,
        hold: Hold::Sampled,
        torque_per_command: Some(0.5),
        back_emf_viscous: 0.0,
        limit: None,
    };
    Channels { axis: Axis::Rotary, command, tips: Vec::new() }
}

/// What `arm` shows under a command of two sines, replayed, with sensor steps.
fn log_of(arm: &ModalArm) -> Campaign {
    log_at(arm, [3.0, 11.0])
}

/// The same, the sines at other frequencies \[rad/s\].
fn log_at(arm: &ModalArm, [slow, fast]: [f64; 2]) -> Campaign {
    let n = 8000;
    let tips = arm.shapes.len();
    let command: Vec<f64> = (0..n)
        .map(|k| T * f64::from(k))
        .map(|s| 1.6 * (slow * s).sin() + 0.8 * (fast * s).sin())
        .collect();
    let run = |mut shown: Vec<Vec<f64>>| {
        let motor = shown.remove(0);
        Run::new("two sines", TimeBase::uniform(0.0, T), command.clone(), motor, shown).unwrap()
    };
    let channels = Channels { tips: vec![tip(); tips], ..channels() };
    let blank = run(vec![vec![0.0; n as usize]; 1 + tips]);
    let blank = Campaign::new(channels.clone(), vec![blank]).unwrap();
    let mut start = vec![0.0; 2 * (1 + arm.modes.len())];
    start[1] = 0.5;
    let window = Window { run: 0, samples: 0..=n as usize - 1, start, zeros: vec![0.0; tips] };
    let motion = crate::replay::predict(arm, &blank, &window).unwrap();
    let steps = |x: &Vec<f64>| x.iter().map(|x| (x / STEP).round() * STEP).collect();
    Campaign::new(channels, vec![run(motion.channels.iter().map(steps).collect())]).unwrap()
}

fn tip() -> Tip {
    Tip { name: "tip".to_owned(), quantity: TipQuantity::Angle, calibrated: true }
}

fn by_options(arm: &ModalArm, truth: &ModalArm) -> Validation {
    validate(&found(arm.clone()), &log_of(truth), &ValidationOptions::default()).unwrap()
}

#[test]
fn the_true_arm_leaves_what_the_sensor_adds() {
    for viscous in [[0.05, 0.05], [0.02, 0.12]] {
        let arm = ModalArm { viscous_nm_s_per_rad: viscous, ..rigid() };
        leaves_what_the_sensor_adds(&arm);
    }
}

fn leaves_what_the_sensor_adds(arm: &ModalArm) {
    let v = by_options(arm, arm);
    let torque = v.torque.unwrap();
    // 1 % by the choice of the window; the rest is the velocity's sign, known to a window's part.
    assert!(torque.relative_error < 0.03, "{}", torque.relative_error);
    assert!(v.horizons[0].whole_runs && v.chosen == 0);
    let rms = v.residuals[0].rms;
    assert!(rms < 1.2 * STEP / 12.0_f64.sqrt(), "{rms}");
    assert!((v.residuals[0].sensor_step / STEP - 1.0).abs() < 1e-6);
    assert!(v.residuals[0].outside() < 0.2, "{}", v.residuals[0].outside());
}

/// Each estimate off by a known amount is named as the cause, with that amount.
#[test]
fn what_is_wrong_is_named() {
    let delayed = ModalArm { command_lag_s: 0.004, ..rigid() };
    let stiff = ModalArm { coulomb_nm: 0.36, ..rigid() };
    let heavy = ModalArm { inertia_kg_m2: 0.026, ..rigid() };
    for (truth, kind, expected) in [
        (delayed, CauseKind::Delay, 0.004),
        (stiff, CauseKind::Coulomb, 0.06),
        (heavy, CauseKind::Inertia, 0.006),
    ] {
        let v = by_options(&rigid(), &truth);
        let cause = v.torque.as_ref().unwrap().causes[0];
        assert_eq!(cause.kind, kind, "{:?}", v.torque.unwrap().causes);
        assert!((cause.value / expected - 1.0).abs() < 0.15, "{cause:?}");
        let torque = v.torque.unwrap();
        let errors = (torque.relative_error, torque.expected_error);
        assert!(v.findings.iter().any(|f| f.code() == "residual-torque"), "{errors:?} {cause:?}");
        assert!(v.findings.iter().any(|f| f.code() == "prediction-worse"), "{errors:?}");
    }
}

/// Fast motion reverses within a window: much is left of a right arm's torque, and nothing is wrong.
#[test]
fn a_right_arm_has_no_warning_where_reversals_leave_much() {
    let log = log_at(&rigid(), [17.0, 29.0]);
    let v = validate(&found(rigid()), &log, &ValidationOptions::default()).unwrap();
    let torque = v.torque.unwrap();
    assert!(torque.relative_error > GOOD_PREDICTION, "{}", torque.relative_error);
    let beside = torque.relative_error / torque.expected_error.unwrap();
    assert!((beside - 1.0).abs() < 0.05, "{beside}");
    assert!(v.findings.iter().all(|f| f.severity() == Severity::Info), "{:?}", v.findings);
    // An arm that is wrong is told from it.
    let heavy = ModalArm { inertia_kg_m2: 0.024, ..rigid() };
    let v = validate(&found(heavy), &log, &ValidationOptions::default()).unwrap();
    let named = v.findings.iter().find(|f| f.code() == "residual-torque").unwrap();
    assert!(named.message().contains("another inertia"), "{named:?}");
}

/// A tip that is read late is taken as much later; read as if it were in time its coupling torque is not
/// the arm's.
#[test]
fn torque_takes_a_late_tip_as_late() {
    let mode = Oscillator {
        omega_rad_s: 9.0,
        stiffness_nm_per_rad: 1.2,
        within_per_s: 0.1,
        grounded_per_s: 0.2,
    };
    for lag_s in [0.0233, -0.0117] {
        let late = ModalArm {
            modes: vec![mode],
            shapes: vec![vec![1.0]],
            at_points_per_s: vec![0.0],
            tip_lags_s: vec![lag_s],
            ..rigid()
        };
        let log = log_of(&late);
        let left = |arm: &ModalArm| {
            let v = validate(&found(arm.clone()), &log, &ValidationOptions::default()).unwrap();
            v.torque.unwrap().relative_error
        };
        let in_time = ModalArm { tip_lags_s: Vec::new(), ..late.clone() };
        let (by_late, by_in_time) = (left(&late), left(&in_time));
        assert!(by_late < GOOD_PREDICTION && by_in_time > 3.0 * by_late, "{by_late} {by_in_time}");
    }
}

fn flexible() -> ModalArm {
    let mode = Oscillator {
        omega_rad_s: 9.0,
        stiffness_nm_per_rad: 1.2,
        within_per_s: 0.1,
        grounded_per_s: 0.2,
    };
    ModalArm { modes: vec![mode], shapes: vec![vec![1.0]], at_points_per_s: vec![0.0], ..rigid() }
}

#[test]
fn a_softer_beam_is_named() {
    let mut truth = flexible();
    let soft = 0.9_f64;
    truth.modes[0].stiffness_nm_per_rad *= soft;
    truth.modes[0].omega_rad_s *= soft.sqrt();
    let v = by_options(&flexible(), &truth);
    let cause = v.torque.as_ref().unwrap().causes[0];
    assert_eq!(cause.kind, CauseKind::Coupling, "{:?}", v.torque.unwrap().causes);
    assert!((cause.value - (soft - 1.0)).abs() < 0.02, "{cause:?}");
    let moved = v.moved_mode.unwrap();
    assert_eq!(moved.by, MovedBy::Stiffness, "{moved:?}");
    assert!((moved.of_log_rad_s / (9.0 * soft.sqrt()) - 1.0).abs() < 0.005, "{moved:?}");
    // Another estimate that is off is not taken for the beam.
    let heavy = ModalArm { inertia_kg_m2: 1.01 * flexible().inertia_kg_m2, ..flexible() };
    assert_eq!(by_options(&flexible(), &heavy).moved_mode, None);
    assert!(v.findings.iter().any(|f| f.code() == "residual-torque"), "{:?}", v.findings);
}

/// The load at the tip is another one, and the tip shows another angle undeflected: the motor's equation is the
/// same, and its torque is predicted as well over any time of the motion.
#[test]
fn torque_does_not_depend_on_the_load_behind_the_tip() {
    let arm = flexible();
    let mode = arm.modes[0];
    let omega_rad_s = 9.0 / 1.5_f64.sqrt();
    let loaded = Oscillator {
        omega_rad_s,
        within_per_s: mode.within_per_s / 1.5,
        grounded_per_s: mode.grounded_per_s / 1.5,
        ..mode
    };
    let truth = ModalArm { modes: vec![loaded], ..arm.clone() };
    let mut log = log_of(&truth);
    let run = &log.runs[0];
    let shifted = run.tips()[0].iter().map(|y| y + 0.21).collect();
    let (command, motor) = (run.command().to_vec(), run.motor().to_vec());
    log.runs = vec![Run::new(run.name(), run.time(), command, motor, vec![shifted]).unwrap()];
    let left = |horizon_s: Option<f64>| {
        let options = ValidationOptions { horizon_s, ..Default::default() };
        validate(&found(arm.clone()), &log, &options).unwrap()
    };
    let all = left(None);
    assert!(all.horizons[0].channels[1].fit_percent < 80.0, "{:?}", all.horizons[0]);
    let moved = all.moved_mode.unwrap();
    assert!((moved.of_log_rad_s / omega_rad_s - 1.0).abs() < 0.01, "{moved:?}");
    assert!(moved.mode == 0 && moved.residual_ratio < 0.05, "{moved:?}");
    assert_eq!(moved.by, MovedBy::Load);
    assert!(all.findings.iter().any(|f| f.code() == "mode-moved"), "{:?}", all.findings);
    let error = all.torque.unwrap().relative_error;
    let own = validate(&found(truth), &log, &ValidationOptions::default()).unwrap();
    assert_eq!(own.moved_mode, None);
    let right = own.torque.unwrap().relative_error;
    assert!((error / right - 1.0).abs() < 0.05, "{error} beside {right}");
    for horizon_s in [0.1, 1.0, 5.0] {
        let other = left(Some(horizon_s)).torque.unwrap().relative_error;
        assert!((other / error - 1.0).abs() < 1e-9, "{horizon_s}: {other} {error}");
    }
}

/// Inertia, friction and coupling are known, the mode is not: the torque is predicted as by the whole arm, motion is not.
#[test]
fn coupling_alone_predicts_torque() {
    let mut truth = flexible();
    // Coupling by the rate of deflection is no part of what is known.
    truth.modes[0].within_per_s = 0.0;
    let log = log_of(&truth);
    let whole = found(truth.clone());
    let coupling = truth.coupling_by_tip().unwrap();
    let arm = ModalArm { modes: Vec::new(), shapes: vec![Vec::new()], ..truth };
    let alone = FoundArm { coupling_alone_nm_per_rad: coupling, ..found(arm.clone()) };
    let [whole, alone, rigid] = [whole, alone, found(arm)]
        .map(|found| validate(&found, &log, &ValidationOptions::default()).unwrap());
    let error = |v: &Validation| v.torque.as_ref().unwrap().relative_error;
    let errors = (error(&alone), error(&whole));
    assert!((errors.0 / errors.1 - 1.0).abs() < 0.02, "{errors:?}");
    assert!(error(&rigid) > 3.0 * error(&alone), "{}", error(&rigid));
    assert!(alone.horizons.is_empty() && alone.residuals.is_empty());
    assert!(alone.findings.is_empty(), "{:?}", alone.findings);
}

#[test]
fn a_wrong_arm_departs_and_its_residual_is_not_white() {
    let wrong = ModalArm { inertia_kg_m2: 0.026, coulomb_nm: 0.2, ..rigid() };
    let v = by_options(&wrong, &rigid());
    let first = v.horizons[0].channels[0];
    let last = v.horizons.last().unwrap().channels[0];
    assert!(first.fit_percent < last.fit_percent && first.residual_rms > last.residual_rms);
    assert!(v.residuals[0].white_probability < 1e-6);
    assert!(v.findings.iter().any(|f| f.code() == "residual-not-white"));
}

/// What the arm's own motion leaves is known whatever time motion is predicted over.
#[test]
fn a_short_horizon_says_nothing_against_a_right_arm() {
    let log = log_of(&rigid());
    let by = |horizon_s: Option<f64>| {
        let options = ValidationOptions { horizon_s, ..Default::default() };
        validate(&found(rigid()), &log, &options).unwrap()
    };
    let expected = by(None).torque.unwrap().expected_error;
    for horizon_s in [1e-9, 0.02, 0.1] {
        let v = by(Some(horizon_s));
        assert_eq!(v.torque.unwrap().expected_error, expected);
        assert!(v.findings.iter().all(|f| f.severity() == Severity::Info), "{:?}", v.findings);
    }
}

/// An arm that sticks where the log moves leaves much of its own motion's torque, too: that is no excuse.
#[test]
fn an_arm_that_does_not_move_has_failed() {
    let stuck = ModalArm { coulomb_nm: 20.0 * rigid().coulomb_nm, ..rigid() };
    let v = by_options(&stuck, &rigid());
    assert!(
        v.findings.iter().any(|f| f.get().is_some_and(|row: &rows::PredictionPoor| row.failed)),
        "{:?}",
        v.findings
    );
}

#[test]
fn an_arm_of_another_scale_is_refused() {
    let damped = ModalArm { viscous_nm_s_per_rad: [1e6, 0.05], ..rigid() };
    let error = validate(&found(damped), &log_of(&rigid()), &ValidationOptions::default());
    assert!(matches!(error, Err(ValidationError::TooFast { .. })), "{error:?}");
    let driven = ModalArm { viscous_nm_s_per_rad: [-20.0; 2], ..rigid() };
    let error = validate(&found(driven), &log_of(&rigid()), &ValidationOptions::default());
    assert_eq!(error, Err(ValidationError::RunsAway));
}

#[test]
fn an_arm_of_other_tips_is_refused() {
    let other = ModalArm { shapes: vec![Vec::new()], ..rigid() };
    let error = validate(&found(other), &log_of(&rigid()), &ValidationOptions::default());
    assert_eq!(error, Err(ValidationError::Tips { expected: 1, found: 0 }));
}

#[test]
fn a_window_longer_than_the_log_has_no_torque() {
    let arm = rigid();
    for window_s in [20.0, 1e17, 1e300] {
        let options = ValidationOptions { window_s: Some(window_s), ..Default::default() };
        let v = validate(&found(arm.clone()), &log_of(&arm), &options).unwrap();
        assert!(v.torque.is_none(), "{window_s}");
    }
}

#[test]
fn a_prediction_for_plots_has_the_values_of_the_validation() {
    let mut arm = rigid();
    arm.coulomb_nm *= 1.5;
    for log in [log_of(&rigid()), log_of(&arm)] {
        let judged = validate(&found(rigid()), &log, &ValidationOptions::default()).unwrap();
        let shown = predict_logs(&found(rigid()), &log).unwrap();
        assert_eq!(shown.stretches, judged.stretches);
        assert_eq!(shown.residuals, judged.residuals);
        let [shown, judged] = [shown.torque.unwrap(), judged.torque.unwrap()];
        // Where nothing is predicted both are NaN.
        assert_eq!(format!("{:?}", shown.runs), format!("{:?}", judged.runs));
    }
}

/// Friction that grows with speed and load, and torque ripple, are in the predicted torque; without the ripple it is worse.
#[test]
fn every_term_of_an_arm_is_in_the_predicted_torque() {
    let load = GravityLoad { sine_nm: 0.4, cosine_nm: 0.1 };
    let mut arm = rigid();
    arm.gravity = Some(load);
    arm.dry_terms.root = Some(Root { torque_nm_per_root_rad_s: 0.1 });
    arm.dry_terms.with_load = Some(WithLoad { coefficient: 0.2, load });
    arm.torque_ripples = vec![TorqueRipple { per_rad: 5.0, cosine_nm: 0.1, sine_nm: 0.05 }];
    let motor = Motor::new(arm.inertia_kg_m2, 0.05, 1.0).unwrap();
    let sliding = Coulomb::by_direction(0.32, 0.28).unwrap();
    let joint = Arm::new(Beam::Rigid, motor, sliding).unwrap();
    let friction =
        DryFriction::from(sliding).with_root(0.1).and_then(|law| law.with_load(0.2, load)).unwrap();
    let mut motion = Hybrid::at_rest(&joint)
        .with_friction(friction)
        .with_gravity(load)
        .with_torque_ripples(&arm.torque_ripples);
    let torque = |k: u32| {
        let s = T * f64::from(k);
        1.6 * (3.0 * s).sin() + 0.8 * (11.0 * s).sin()
    };
    let (command, motor): (Vec<f64>, Vec<f64>) = (0..8000)
        .map(|k| {
            let angle = (motion.state()[0] / STEP).round() * STEP;
            motion.advance(torque(k), T);
            (torque(k) / 0.5, angle)
        })
        .unzip();
    let run = Run::new("two sines", TimeBase::uniform(0.0, T), command, motor, vec![]).unwrap();
    let campaign = Campaign::new(channels(), vec![run]).unwrap();
    let error = |arm: &ModalArm| {
        let options = ValidationOptions::default();
        validate(&found(arm.clone()), &campaign, &options).unwrap().torque.unwrap().relative_error
    };
    let plain = ModalArm { torque_ripples: Vec::new(), ..arm.clone() };
    assert!(error(&arm) < 0.03 && error(&plain) > 0.06, "{} {}", error(&arm), error(&plain));
}
