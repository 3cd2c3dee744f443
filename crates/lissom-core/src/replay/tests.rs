//! The replay against the event engine, and its derivatives against differences.

use std::f64::consts::TAU;

use nalgebra::DVector;

use super::*;
use crate::arm::Arm;
use crate::beam::{LumpedBeam, Span};
use crate::drive::{Coulomb, DryFriction, Falloff, Motor};
use crate::load::{GravityLoad, TorqueRipple};
use crate::record::{
    Axis, Campaign, Channels, Command, CommandQuantity, Hold, Run, TimeBase, Tip, TipQuantity,
};
use crate::rig::Hybrid;

pub(super) const T: f64 = 0.002;
pub(super) const SAMPLES: usize = 1500;

pub(super) fn arm() -> Arm {
    arm_of(crate::beam::Damping::Modal { ratios: vec![0.02, 0.01] }, 0.0)
}

/// Two masses with damping within and dampers of `rate_per_s` and twice that at the masses.
fn arm_of(damping: crate::beam::Damping, rate_per_s: f64) -> Arm {
    let span = |length_m, mass_kg, rate: f64| Span {
        length_m,
        flexural_rigidity_n_m2: 0.02,
        mass_kg,
        damping_n_s_per_m: rate * mass_kg,
    };
    let spans = [span(0.15, 0.06, rate_per_s), span(0.15, 0.04, 2.0 * rate_per_s)];
    let beam = LumpedBeam::new(&spans).unwrap().with_damping(damping).unwrap();
    let motor = Motor::new(8e-4, 2e-3, 0.3).unwrap();
    Arm::new(beam, motor, Coulomb::by_direction(0.05, 0.04).unwrap()).unwrap()
}

/// A command that sticks, slips and reverses.
pub(super) fn command() -> Vec<f64> {
    (0..SAMPLES)
        .map(|k| k as f64 * T)
        .map(|s| 0.4 * (3.0 * s + 0.3).sin() + 0.25 * (11.0 * s).cos() + 0.05 * (150.0 * s).sin())
        .collect()
}

/// The event engine's own log of that command, from rest, beginning once the motor turns.
fn campaign(arm: &Arm, hold: Hold, quantity: TipQuantity) -> (Campaign, Vec<Vec<f64>>, f64) {
    log_of(Hybrid::at_rest(arm), hold, quantity)
}

fn log_of(motion: Hybrid<'_>, hold: Hold, quantity: TipQuantity) -> (Campaign, Vec<Vec<f64>>, f64) {
    late_log_of(motion, hold, quantity, 0.0)
}

/// The same, each tip read `late` of a sample before the motor.
pub(super) fn late_log_of(
    mut motion: Hybrid<'_>,
    hold: Hold,
    quantity: TipQuantity,
    late: f64,
) -> (Campaign, Vec<Vec<f64>>, f64) {
    let (mut motor, mut tips, mut states) = (Vec::new(), vec![Vec::new(); 2], Vec::new());
    let command = command();
    for u in &command {
        motion.advance(0.3 * u, (1.0 - late) * T);
        let x = motion.state();
        let minus = if quantity == TipQuantity::Deflection { x[0] } else { 0.0 };
        for (i, tip) in tips.iter_mut().enumerate() {
            tip.push(x[2 + i] - minus);
        }
        motion.advance(0.3 * u, late * T);
        let x = motion.state();
        motor.push(x[0]);
        states.push(x.to_vec());
    }
    // Sample k is seen before command k acts: the state after command k − 1.
    let logged = [&command[1..], &command[..1]].concat();
    let channels = Channels {
        axis: Axis::Rotary,
        command: Command {
            quantity: CommandQuantity::Current,
            hold,
            torque_per_command: Some(0.3),
            back_emf_viscous: 0.0,
            limit: None,
        },
        tips: ["1", "2"].map(|n| Tip { name: n.into(), quantity, calibrated: true }).to_vec(),
    };
    let run = Run::new("run", TimeBase::uniform(0.0, T), logged, motor, tips).unwrap();
    (Campaign::new(channels, vec![run]).unwrap(), states, motion.stuck_s())
}

/// The modal state of an arm's own.
fn modal(model: &ModalArm, x: &[f64]) -> Vec<f64> {
    let r = nalgebra::DMatrix::from_fn(2, 2, |i, j| model.shapes[i][j]);
    let angles = r.clone().lu().solve(&DVector::from_column_slice(&x[2..4])).unwrap();
    let rates = r.lu().solve(&DVector::from_column_slice(&x[4..6])).unwrap();
    vec![x[0], x[1], angles[0], rates[0], angles[1], rates[1]]
}

pub(super) fn window(model: &ModalArm, states: &[Vec<f64>], from: usize, to: usize) -> Window {
    Window { run: 0, samples: from..=to, start: modal(model, &states[from]), zeros: vec![0.0; 2] }
}

/// Dampers that differ along the beam couple its modes: their poles are those of the beam, not of
/// oscillators side by side.
#[test]
fn clamped_modes_are_the_poles_of_the_beam() {
    let arm = arm_of(crate::beam::Damping::None, 4.0);
    let mut poles: Vec<_> = arm.beam().poles().s.into_iter().filter(|s| s.im > 0.0).collect();
    poles.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
    let model = ModalArm::of_arm(&arm).unwrap();
    let modes = model.clamped_modes();
    assert_eq!(modes.len(), poles.len());
    for ((omega, ratio), s) in modes.iter().zip(&poles) {
        assert!((omega / s.norm() - 1.0).abs() < 1e-12, "{omega} {s}");
        assert!((ratio + s.re / s.norm()).abs() < 1e-12, "{ratio} {s}");
    }
    let apart = modes[0].0 / model.modes[0].omega_rad_s - 1.0;
    assert!(apart.abs() > 1e-4, "{apart}");
}

#[test]
fn replays_what_the_event_engine_does() {
    let dampers = arm_of(crate::beam::Damping::None, 1.0);
    for (arm, quantity) in [(arm(), TipQuantity::Angle), (dampers, TipQuantity::Deflection)] {
        let model = ModalArm::of_arm(&arm).unwrap();
        let (campaign, states, stuck_s) = campaign(&arm, Hold::Sampled, quantity);
        let from = states.iter().position(|x| x[1] != 0.0).unwrap();
        let found =
            predict(&model, &campaign, &window(&model, &states, from, SAMPLES - 1)).unwrap();
        let run = &campaign.runs[0];
        for (k, s) in found.channels[0].iter().enumerate() {
            assert!((s - run.motor()[from + k]).abs() < 1e-10, "{k}");
            for tip in 0..2 {
                let error = found.channels[1 + tip][k] - run.tips()[tip][from + k];
                assert!(error.abs() < 1e-10, "{k} {error}");
            }
        }
        // It sticks again and again, for a good part of the time.
        assert!(
            found.stuck_s > 0.1 && (stuck_s - found.stuck_s) < 0.1,
            "{} {stuck_s}",
            found.stuck_s
        );
    }
}

const PARAMETERS: [Parameter; 15] = [
    Parameter::Shape(0, 0),
    Parameter::Inertia,
    Parameter::CommandLag,
    Parameter::Viscous,
    Parameter::ViscousDifference,
    Parameter::Coulomb,
    Parameter::Frequency(0),
    Parameter::Frequency(1),
    Parameter::Stiffness(0),
    Parameter::Stiffness(1),
    Parameter::DampingWithin(0),
    Parameter::DampingGrounded(1),
    Parameter::DampingAtPoint(0),
    Parameter::Offset,
    Parameter::Shape(1, 0),
];

fn derivatives_hold(hold: Hold, quantity: TipQuantity, lag_s: f64) {
    let mut model = ModalArm::of_arm(&arm()).unwrap();
    model.command_lag_s = lag_s;
    model.at_points_per_s[1] = 0.4;
    derivatives_of(&model, &PARAMETERS, hold, quantity, 1e-6, [2e-6, 1e-3]);
}

/// Derivatives of every channel at every sample: the replay's, and by central differences.
fn derivatives_of(
    model: &ModalArm,
    parameters: &[Parameter],
    hold: Hold,
    quantity: TipQuantity,
    relative: f64,
    tolerance: [f64; 2],
) {
    let (campaign, states, _) = campaign(&arm(), hold, quantity);
    let from = states.iter().position(|x| x[1].abs() > 0.05).unwrap();
    let window = window(model, &states, from, SAMPLES - 1);
    let campaign = own_log(model, campaign, &window);
    let sampling = Sampling {
        noise: &[SensorNoise::gaussian(1.0); 3],
        blocks: &[Blocks { samples: 1.0, period: None }],
        masks: &[vec![None; 3]],
        command_noise: 0.0,
    };
    let base = predict(model, &campaign, &window).unwrap();
    // With blocks of one sample and residuals put in one channel at a time, scores are derivatives.
    let moved = |model: &ModalArm, window: &Window| predict(model, &campaign, window).unwrap();
    let rows = derivative_rows((model, parameters), &campaign, &window, &base, sampling);
    let compare = |what: &str, column: usize, step: f64, above: &Prediction, below: &Prediction| {
        let mut largest: f64 = 0.0;
        let mut errors = Vec::new();
        for (k, row) in rows.iter().enumerate() {
            for (channel, derivatives) in row.iter().enumerate() {
                let difference =
                    (above.channels[channel][k] - below.channels[channel][k]) / (2.0 * step);
                largest = largest.max(difference.abs());
                errors.push((difference - derivatives[column]).abs());
            }
        }
        errors.sort_by(f64::total_cmp);
        let (worst, usual) = (errors[errors.len() - 1], errors[errors.len() / 2]);
        // Differences across an event that moves past a sample are off there, and only there.
        assert!(usual < tolerance[0] * largest, "{what}: median {usual} of {largest}");
        assert!(worst < tolerance[1] * largest, "{what}: worst {worst} of {largest}");
    };
    for (column, p) in parameters.iter().enumerate() {
        let at = p.of(model);
        let usual = match p {
            Parameter::DampingWithin(_)
            | Parameter::DampingGrounded(_)
            | Parameter::DampingAtPoint(_) => 1.0,
            _ => 1e-3,
        };
        let step = relative * at.abs().max(usual);
        let with = |value: f64| {
            let mut model = model.clone();
            p.set(&mut model, value);
            moved(&model, &window)
        };
        compare(&format!("{p:?}"), column, step, &with(at + step), &with(at - step));
    }
    for i in 0..6 {
        let with = |change: f64| {
            let mut window = window.clone();
            window.start[i] += change;
            moved(model, &window)
        };
        compare(&format!("state {i}"), parameters.len() + i, 1e-6, &with(1e-6), &with(-1e-6));
    }
}

/// The campaign with the angles that the model itself shows, which gravity needs: of the logged angle the replay takes its
/// torque. What is not yet the model's own angle shrinks by each replay.
fn own_log(model: &ModalArm, mut campaign: Campaign, window: &Window) -> Campaign {
    for _ in 0..if model.gravity.is_some() { 30 } else { 0 } {
        let shown = predict(model, &campaign, window).unwrap().channels.swap_remove(0);
        let run = &campaign.runs[0];
        let mut motor = run.motor().to_vec();
        motor[window.samples.clone()].copy_from_slice(&shown);
        let tips = run.tips().to_vec();
        campaign.runs[0] = Run::new("r", run.time(), run.command().to_vec(), motor, tips).unwrap();
    }
    campaign
}

/// ∂ŷ of each sample and channel: a residual in that channel alone leaves its row as score. The residual is a whole turn,
/// of which gravity's torque feels nothing.
fn derivative_rows(
    (model, parameters): (&ModalArm, &[Parameter]),
    campaign: &Campaign,
    window: &Window,
    base: &Prediction,
    sampling: Sampling<'_>,
) -> Vec<Vec<Vec<f64>>> {
    let mut rows = vec![Vec::new(); window.len()];
    for channel in 0..3 {
        let run = &campaign.runs[0];
        let shifted = |c: usize, logged: &[f64]| {
            let mut out = logged.to_vec();
            for (k, y) in base.channels[c].iter().enumerate() {
                out[window.samples.start() + k] = y + if c == channel { TAU } else { 0.0 };
            }
            out
        };
        let tips = (0..2).map(|i| shifted(i + 1, &run.tips()[i])).collect();
        let run = Run::new("r", run.time(), run.command().to_vec(), shifted(0, run.motor()), tips);
        let campaign = Campaign::new(campaign.channels.clone(), vec![run.unwrap()]).unwrap();
        let sums = sums(model, parameters, &campaign, std::slice::from_ref(window), sampling);
        for (row, block) in rows.iter_mut().zip(&sums[0].blocks) {
            let last = block.ncols() - 1;
            row.push(block.column(last).iter().take(last).map(|v| v / TAU).collect());
        }
    }
    rows
}

#[test]
fn derivatives_are_exact_through_stick_and_slip() {
    derivatives_hold(Hold::Sampled, TipQuantity::Angle, 0.0);
}

#[test]
fn derivatives_are_exact_with_a_lag() {
    derivatives_hold(Hold::Sampled, TipQuantity::Deflection, 0.0013);
    derivatives_hold(Hold::Measured, TipQuantity::Angle, 0.0013);
}

#[test]
fn derivatives_are_exact_with_gravity() {
    let mut model = ModalArm::of_arm(&arm()).unwrap();
    model.command_lag_s = 0.0013;
    model.gravity = Some(GravityLoad { sine_nm: 0.03, cosine_nm: -0.02 });
    let parameters = [
        Parameter::GravitySine,
        Parameter::Inertia,
        Parameter::GravityCosine,
        Parameter::Coulomb,
        Parameter::CommandLag,
    ];
    for hold in [Hold::Sampled, Hold::Measured] {
        derivatives_of(&model, &parameters, hold, TipQuantity::Angle, 1e-5, [2e-6, 1e-3]);
    }
    let accelerations = TipQuantity::Acceleration;
    derivatives_of(&model, &parameters, Hold::Measured, accelerations, 1e-5, [2e-6, 2e-3]);
    let with_terms = with_terms(&model);
    let within = [1e-3, 0.03];
    derivatives_of(&with_terms, &parameters, Hold::Sampled, TipQuantity::Angle, 1e-4, within);
}

/// Of its own angle a replay is the pendulum `J·θ̈ = τ − V·θ̇ − F·sign θ̇ − g_s·sin θ − g_c·cos θ`, here by a method of
/// fourth order in steps of a hundredth of a sample, with a torque ripple `B·cos kθ + C·sin kθ` taken off as well. The difference is that the replay takes the load between samples for
/// linear.
#[test]
fn replays_a_pendulum() {
    let load = GravityLoad { sine_nm: 0.05, cosine_nm: 0.02 };
    let mut model = ModalArm::of_arm(&arm()).unwrap();
    (model.modes, model.shapes, model.at_points_per_s) = (vec![], vec![], vec![]);
    (model.gravity, model.inertia_kg_m2) = (Some(load), 4e-3);
    model.coulomb_nm = 0.01;
    model.torque_ripples = vec![TorqueRipple { per_rad: 4.0, cosine_nm: 0.004, sine_nm: -0.006 }];
    let position = model.position_torque();
    let torque = |t: f64| 0.1 * (3.0 * t + 0.3).sin();
    let (mut q, mut v, mut motor) = (0.1, 0.5, Vec::new());
    let (parts, [forward, backward]) = (100, model.viscous_nm_s_per_rad);
    let h = T / f64::from(parts);
    for k in 0..SAMPLES {
        motor.push(q);
        let held = torque(k as f64 * T);
        let accelerates = |q: f64, v: f64| {
            let viscous = if v > 0.0 { forward } else { backward };
            let dry = v.signum() * model.coulomb_nm + model.offset_nm;
            (held - viscous * v - dry - position.torque_nm(q)) / model.inertia_kg_m2
        };
        for _ in 0..parts {
            let a1 = accelerates(q, v);
            let (q2, v2) = (q + 0.5 * h * v, v + 0.5 * h * a1);
            let a2 = accelerates(q2, v2);
            let (q3, v3) = (q + 0.5 * h * v2, v + 0.5 * h * a2);
            let a3 = accelerates(q3, v3);
            let (q4, v4) = (q + h * v3, v + h * a3);
            q += h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4);
            v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + accelerates(q4, v4));
        }
    }
    let command = Command {
        quantity: CommandQuantity::Current,
        hold: Hold::Sampled,
        torque_per_command: Some(1.0),
        back_emf_viscous: 0.0,
        limit: None,
    };
    let channels = Channels { axis: Axis::Rotary, command, tips: vec![] };
    let command = (0..SAMPLES).map(|k| torque(k as f64 * T)).collect();
    let run = Run::new("run", TimeBase::uniform(0.0, T), command, motor.clone(), vec![]).unwrap();
    let campaign = Campaign::new(channels, vec![run]).unwrap();
    let window = Window { run: 0, samples: 0..=SAMPLES - 1, start: vec![0.1, 0.5], zeros: vec![] };
    let shown = predict(&model, &campaign, &window).unwrap();
    let apart = shown.channels[0].iter().zip(&motor).map(|(a, b)| (a - b).abs());
    let apart = apart.fold(0.0, f64::max);
    assert!(motor.iter().any(|q| *q > 1.0) && motor.iter().any(|q| *q < -1.0));
    assert!(apart < 3e-4, "{apart}");
}

/// Friction that rises towards rest and changes over the travel.
fn with_terms(model: &ModalArm) -> ModalArm {
    let mut model = model.clone();
    let (share, per_rad, phase) = (0.2, 9.0, 0.4_f64);
    let size = share * model.coulomb_nm;
    model.dry_terms = DryTerms {
        near_rest: Some(NearRest {
            torque_nm: 0.02,
            offset_nm: 0.0,
            speed_rad_s: 0.15,
            falloff: Falloff::Exponential,
        }),
        ripples: vec![Ripple {
            per_rad,
            cosine_nm: size * phase.cos(),
            sine_nm: -size * phase.sin(),
        }],
        ..DryTerms::default()
    };
    model
}

#[test]
fn derivatives_are_exact_under_further_terms_of_friction() {
    let mut model = with_terms(&ModalArm::of_arm(&arm()).unwrap());
    model.command_lag_s = 0.0013;
    let parameters = [
        Parameter::Inertia,
        Parameter::Friction(FrictionNumber::NearRest(NearRestNumber::Torque)),
        Parameter::Coulomb,
        Parameter::Frequency(0),
        Parameter::Friction(FrictionNumber::NearRest(NearRestNumber::Speed)),
        Parameter::Friction(FrictionNumber::Ripple(0, RippleNumber::Sine)),
        Parameter::Offset,
        Parameter::Friction(FrictionNumber::Ripple(0, RippleNumber::Cosine)),
        Parameter::Friction(FrictionNumber::Ripple(0, RippleNumber::Rate)),
        Parameter::CommandLag,
    ];
    // Steps over which friction is linear end elsewhere when parameters move, and the lag moves all of
    // them: what tangents leave out is of the size of what such steps miss.
    let within = [1e-3, 0.03];
    derivatives_of(&model, &parameters, Hold::Sampled, TipQuantity::Angle, 1e-4, within);
    derivatives_of(&model, &parameters, Hold::Measured, TipQuantity::Acceleration, 1e-4, within);
}

#[test]
fn derivatives_are_exact_under_friction_that_grows_with_speed_and_load() {
    let mut model = ModalArm::of_arm(&arm()).unwrap();
    model.dry_terms.root = Some(Root { torque_nm_per_root_rad_s: 0.03 });
    let load = GravityLoad { sine_nm: 0.1, cosine_nm: 0.05 };
    model.dry_terms.with_load = Some(WithLoad { coefficient: 0.2, load });
    let parameters = [
        Parameter::Inertia,
        Parameter::Friction(FrictionNumber::Root),
        Parameter::Coulomb,
        Parameter::Friction(FrictionNumber::WithLoad),
    ];
    let within = [5e-3, 0.05];
    derivatives_of(&model, &parameters, Hold::Sampled, TipQuantity::Angle, 1e-4, within);
}

/// Against the event engine's own series of such friction: what is left is the step over which the
/// replay takes friction for linear.
#[test]
fn replays_further_terms_of_friction_as_the_event_engine_does() {
    let arm = arm_of(crate::beam::Damping::Modal { ratios: vec![0.02, 0.01] }, 0.0);
    let plain = ModalArm::of_arm(&arm).unwrap();
    let sliding = Coulomb::symmetric(0.045).unwrap();
    let rest = Coulomb::by_direction(0.069, 0.061).unwrap();
    let stribeck = DryFriction::from(sliding).with_rest(rest, 0.15, Falloff::Exponential).unwrap();
    let ripple = DryFriction::from(sliding).with_ripple(0.2, 9.0, 0.4).unwrap();
    let whole = with_terms(&plain);
    let by_direction = |n: NearRest| NearRest { offset_nm: 0.004, ..n };
    let near_rest = whole.dry_terms.near_rest.map(by_direction);
    let near = DryTerms { near_rest, ..DryTerms::default() };
    let waves = DryTerms { near_rest: None, ..whole.dry_terms };
    let by_speed = DryFriction::from(sliding).with_root(0.03).unwrap();
    let load = GravityLoad { sine_nm: 0.1, cosine_nm: 0.05 };
    let by_load = DryFriction::from(sliding).with_load(0.2, load).unwrap();
    let [speed, loaded] = [&by_speed, &by_load].map(|law| law.terms().clone());
    for (friction, dry_terms) in
        [(stribeck, near), (ripple, waves), (by_speed, speed), (by_load, loaded)]
    {
        let model = ModalArm { offset_nm: 0.0, dry_terms, ..plain.clone() };
        let motion = Hybrid::at_rest(&arm).with_friction(friction);
        let (campaign, states, _) = log_of(motion, Hold::Sampled, TipQuantity::Angle);
        let from = states.iter().position(|x| x[1] != 0.0).unwrap();
        let apart = |model: &ModalArm| {
            let window = window(model, &states, from, SAMPLES - 1);
            let found = predict(model, &campaign, &window).unwrap();
            let logged = &campaign.runs[0].motor()[from..];
            let apart = found.channels[0].iter().zip(logged).map(|(a, b)| (a - b).abs());
            apart.fold(0.0, f64::max)
        };
        let (with, without) = (apart(&model), apart(&ModalArm { offset_nm: 0.0, ..plain.clone() }));
        assert!(with < 2e-5 * without, "{with} {without}");
    }
}

/// Friction under a load that also acts on the motor, against the event engine.
#[test]
fn replays_friction_under_the_load_that_it_grows_with() {
    let load = GravityLoad { sine_nm: 2.0, cosine_nm: 0.6 };
    let sliding = Coulomb::symmetric(0.25).unwrap();
    let motor = Motor::new(0.012, 0.05, 1.0).unwrap();
    let arm = Arm::new(crate::beam::Beam::Rigid, motor, sliding).unwrap();
    let by_load = DryFriction::from(sliding).with_load(0.12, load).unwrap();
    let plain = ModalArm { gravity: Some(load), ..ModalArm::of_arm(&arm).unwrap() };
    let model = ModalArm { dry_terms: by_load.terms().clone(), ..plain.clone() };
    let mut motion = Hybrid::at_rest(&arm).with_friction(by_load).with_gravity(load);
    let (mut command, mut states) = (vec![], vec![]);
    for k in 0..6000 {
        let s = 1e-3 * f64::from(k);
        let torque = 2.2 * (3.0 * s).sin() + 1.2 * (7.0 * s).sin();
        states.push(motion.state().to_vec());
        command.push(torque);
        motion.advance(torque, 1e-3);
    }
    let angle: Vec<f64> = states.iter().map(|x| x[0]).collect();
    let run = Run::new("log", TimeBase::uniform(0.0, 1e-3), command, angle, vec![]).unwrap();
    let command = Command {
        quantity: CommandQuantity::Current,
        hold: Hold::Sampled,
        torque_per_command: None,
        back_emf_viscous: 0.0,
        limit: None,
    };
    let channels = Channels { axis: Axis::Rotary, command, tips: vec![] };
    let campaign = Campaign::new(channels, vec![run]).unwrap();
    let from = states.iter().position(|x| x[1] != 0.0).unwrap();
    let start = states[from][..2].to_vec();
    let window = Window { run: 0, samples: from..=5999, start, zeros: vec![0.0] };
    let apart = |model: &ModalArm| {
        let found = predict(model, &campaign, &window).unwrap();
        let logged = &campaign.runs[0].motor()[from..];
        let apart = found.channels[0].iter().zip(logged).map(|(a, b)| (a - b).abs());
        apart.fold(0.0, f64::max)
    };
    let (with, without) = (apart(&model), apart(&plain));
    assert!(with < 1e-4 * without, "{with} {without}");
}
