//! Kinds of logs that users have, each with its truth: what must be given, and what a finding must say.

#![expect(clippy::unwrap_used, reason = "tests")]

use lissom::identify::findings::rows;
use lissom::identify::{
    Effort, Estimate, Finding, GravityPartner, Identified, Method, MissingKind, Options, Severity,
    identify,
};
use lissom::record::{Axis, Campaign, Channels, Command, CommandQuantity, Hold, Run, TimeBase};
use lissom_testmodels::{RigidJoint, RigidLog, two_sines};

const TAU: f64 = std::f64::consts::TAU;

fn channels(hold: Hold) -> Channels {
    let command = Command {
        quantity: CommandQuantity::Current,
        hold,
        torque_per_command: None,
        back_emf_viscous: 0.0,
        limit: None,
    };
    Channels { axis: Axis::Rotary, command, tips: vec![] }
}

fn run(name: &str, joint: &RigidJoint, command: Vec<f64>, angle: Vec<f64>) -> Run {
    Run::new(name, TimeBase::uniform(0.0, joint.sample_time_s), command, angle, vec![]).unwrap()
}

fn measured(joint: &RigidJoint, log: RigidLog) -> Campaign {
    let one = run("log", joint, log.measured, log.angle);
    Campaign::new(channels(Hold::Measured), vec![one]).unwrap()
}

fn quick(campaign: &Campaign) -> Identified {
    let options = Options { effort: Effort::Quick, ..Options::default() };
    identify(campaign, &options, |_| ()).unwrap()
}

#[track_caller]
fn within(name: &str, found: Option<Estimate>, truth: f64, share: f64) {
    let found = found.unwrap_or_else(|| panic!("{name} is refused")).value;
    assert!((found / truth - 1.0).abs() < share, "{name}: {found}, in truth {truth}");
}

fn codes(found: &Identified) -> Vec<&'static str> {
    codes_of(&found.findings)
}

fn codes_of(findings: &[Finding]) -> Vec<&'static str> {
    findings.iter().map(Finding::code).collect()
}

/// Uniform noise of a standard deviation.
fn noisy(values: &mut [f64], std: f64) {
    let mut state = 7_u32;
    for value in values {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        *value += std * 12.0_f64.sqrt() * (f64::from(state >> 8) / f64::from(1 << 24) - 0.5);
    }
}

/// A vertical axis: six times Coulomb friction as a constant load.
#[test]
fn a_load_larger_than_friction() {
    let joint = RigidJoint { load: |_| 1.0, ..RigidJoint::default() };
    let log = joint.follow(10_000, two_sines);
    let one = run("log", &joint, log.held, log.angle);
    let found = quick(&Campaign::new(channels(Hold::Sampled), vec![one]).unwrap());
    within("Coulomb", found.friction.coulomb, 0.15, 0.01);
    within("viscous", found.friction.viscous, 0.02, 0.01);
    within("inertia", found.inertia, 0.01, 0.01);
    within("offset", found.friction.offset, 1.0, 0.01);
    within("backward", found.friction.backward, -0.85, 0.01);
    let load = |row: &rows::Offset| row.share > 1.0;
    assert!(found.findings.iter().any(|f| f.get().is_some_and(load)), "{:?}", codes(&found));
    assert!(found.arm.is_some());
}

fn pendulum() -> RigidJoint {
    RigidJoint { load: |q| 0.6 * (q + 0.4).sin(), ..RigidJoint::default() }
}

fn wide(time_s: f64) -> f64 {
    1.2 * (0.2 * TAU * time_s).sin() + 0.6 * (0.55 * TAU * time_s + 0.7).sin()
}

#[test]
fn gravity_of_an_unbalanced_load() {
    let joint = pendulum();
    let mut log = joint.follow(20_000, wide);
    noisy(&mut log.measured, 0.02);
    let found = quick(&measured(&joint, log.clone()).with_gravity().unwrap());
    within("Coulomb", found.friction.coulomb, 0.15, 0.02);
    within("viscous", found.friction.viscous, 0.02, 0.05);
    within("inertia", found.inertia, 0.01, 0.02);
    let gravity = found.gravity.unwrap();
    within("gravity", Some(gravity.amplitude()), 0.6, 0.02);
    within("its phase", Some(gravity.phase_rad()), 0.4, 0.02);
    // The line has it, too.
    let line = &found.least_squares.unwrap().estimates;
    within("gravity of the line", line.gravity.map(|g| g.amplitude()), 0.6, 0.02);
    // Where it is not asked for, the first finding names it.
    let without = quick(&measured(&joint, log));
    let names = |rows::MissingTerm { term, .. }: &rows::MissingTerm| {
        term.kind == MissingKind::Gravity && (term.value / 0.6 - 1.0).abs() < 0.2
    };
    let warnings = without.findings.iter().filter(|f| f.hint().contains("gravity = true"));
    assert!(warnings.clone().any(|f| f.get().is_some_and(names)), "{:?}", codes(&without));
}

/// Replayed with the load as a known input: the estimates are those of the output error, which describes the whole run.
#[test]
fn gravity_in_a_replay() {
    let joint = RigidJoint { steps: 100, ..pendulum() };
    let mut log = joint.follow(8_000, wide);
    noisy(&mut log.angle, 5e-4);
    let one = run("log", &joint, log.held, log.angle);
    let campaign = Campaign::new(channels(Hold::Sampled), vec![one]).unwrap();
    let campaign = campaign.with_known_gravity(1.2).unwrap();
    let found = identify(&campaign, &Options::default(), |_| ()).unwrap();
    assert_eq!(found.method, Some(Method::OutputError), "{:?}", codes(&found));
    within("Coulomb", found.friction.coulomb, 0.15, 0.01);
    within("viscous", found.friction.viscous, 0.02, 0.02);
    within("inertia", found.inertia, 0.01, 0.01);
    within("gravity", found.gravity.map(|g| g.amplitude()), 0.6, 0.005);
    within("its phase", found.gravity.map(|g| g.phase_rad()), 0.4, 0.01);
    within("torque constant", found.torque_constant, 2.0, 0.005);
    let load = found.arm.unwrap().arm.gravity.unwrap();
    assert!((load.torque_nm(1.0) / (0.6 * 1.4_f64.sin()) - 1.0).abs() < 0.005, "{load:?}");
    let codes = codes_of(&found.findings);
    assert!(!codes.contains(&"replay-departs"), "{codes:?}");
}

/// A torque constant that the load's m·g·l contradicts.
#[test]
fn gravity_contradicts_a_torque_constant() {
    let joint = pendulum();
    let log = joint.follow(10_000, wide);
    let mut campaign = measured(&joint, log).with_known_gravity(1.2).unwrap();
    campaign.channels.command.torque_per_command = Some(2.5);
    let doubts = |found: &Identified| codes(found).contains(&"torque-constant");
    let found = quick(&campaign);
    assert!(doubts(&found), "{:?}", codes(&found));
    within("torque constant", found.torque_constant, 2.0, 0.01);
    campaign.channels.command.torque_per_command = Some(2.0);
    assert!(!doubts(&quick(&campaign)));
    assert!(campaign.with_known_gravity(-1.0).is_err());
}

/// Bearings or gears whose friction grows with the load that they carry.
#[test]
fn friction_that_grows_with_the_load() {
    for per_load in [0.0, 0.05, 0.2] {
        let joint = RigidJoint { per_load, ..pendulum() };
        let mut log = joint.follow(20_000, wide);
        noisy(&mut log.measured, 0.02);
        let found = quick(&measured(&joint, log).with_gravity().unwrap());
        within("viscous", found.friction.viscous, 0.02, 0.05);
        within("inertia", found.inertia, 0.01, 0.02);
        within("gravity", found.gravity.map(|g| g.amplitude()), 0.6, 0.01);
        let coulomb = found.friction.coulomb;
        let Some(law) = found.friction.law else {
            within("Coulomb", coulomb, 0.15, 0.02);
            assert!(per_load < 0.01, "{per_load}");
            continue;
        };
        within("per load", law.with_load, per_load, 0.05);
        within("Coulomb without a load", law.coulomb, 0.15, 0.02);
        // The line of all friction is at the mean load, which is between none and the largest.
        let mean = (coulomb.unwrap().value - 0.15) / (per_load * 0.6);
        assert!((0.1..0.9).contains(&mean), "{mean}");
    }
}

/// Over a short arc gravity is a constant load, and in a sine its slope is inertia.
#[test]
fn gravity_in_one_small_sine() {
    let joint = pendulum();
    let mut log = joint.follow(10_000, |t| 0.15 * (TAU * t).sin());
    noisy(&mut log.measured, 0.02);
    let found = quick(&measured(&joint, log).with_gravity().unwrap());
    let pair = |f: &Finding| f.get().map(|row: &rows::GravityUnseparated| row.with);
    let pairs: Vec<GravityPartner> = found.findings.iter().filter_map(pair).collect();
    assert!(pairs.contains(&GravityPartner::Offset), "{pairs:?} {:?}", codes(&found));
}

/// A voltage with an offset: the motor never turns back, and its speed varies.
#[test]
fn one_direction() {
    let joint = RigidJoint { viscous: 0.05, coulomb: 0.5, inertia: 0.02, ..RigidJoint::default() };
    let voltage = |t: f64| 4.0 + 2.0 * (0.7 * TAU * t).sin() + (2.3 * TAU * t).sin();
    let log = joint.drive(10_000, |t, _, _| voltage(t));
    let one = run("log", &joint, log.held, log.angle);
    let found = quick(&Campaign::new(channels(Hold::Sampled), vec![one]).unwrap());
    within("inertia", found.inertia, 0.02, 0.02);
    within("viscous", found.friction.viscous, 0.05, 0.02);
    within("friction with the load", found.friction.forward, 0.5, 0.02);
    assert_eq!((found.friction.coulomb, found.friction.backward), (None, None));
    assert!(codes(&found).contains(&"friction-with-load"), "{:?}", codes(&found));
}

#[test]
fn two_strokes() {
    let joint = RigidJoint { sample_time_s: 1e-3, ..RigidJoint::default() };
    let step = |x: f64| {
        let x = x.clamp(0.0, 1.0);
        x * x * x * (10.0 - 15.0 * x + 6.0 * x * x)
    };
    let out_and_back = |t: f64| 6.0 * (step((t - 0.5) / 4.0) - step((t - 5.0) / 4.0));
    let mut log = joint.follow(9_500, out_and_back);
    noisy(&mut log.measured, 0.01);
    let found = quick(&measured(&joint, log));
    within("Coulomb", found.friction.coulomb, 0.15, 0.03);
    within("viscous", found.friction.viscous, 0.02, 0.05);
    within("inertia", found.inertia, 0.01, 0.03);
    assert!(codes(&found).contains(&"few-phases"), "{:?}", codes(&found));
}

/// A slow ramp and a step each way, from rest: four logs, each in one direction.
#[test]
fn ramps_and_steps() {
    let joint = RigidJoint { viscous: 0.05, coulomb: 0.5, inertia: 0.02, ..RigidJoint::default() };
    let mut runs = Vec::new();
    for (name, sign) in [("forward", 1.0), ("backward", -1.0)] {
        let ramp = joint.drive(4_000, |t, _, _| sign * 0.7 * t);
        runs.push(run(&format!("ramp {name}"), &joint, ramp.held, ramp.angle));
        let step = joint.drive(1_500, |_, _, _| sign * 5.0);
        runs.push(run(&format!("step {name}"), &joint, step.held, step.angle));
    }
    let found = quick(&Campaign::new(channels(Hold::Sampled), runs).unwrap());
    within("Coulomb", found.friction.coulomb, 0.5, 0.02);
    within("viscous", found.friction.viscous, 0.05, 0.02);
    within("inertia", found.inertia, 0.02, 0.03);
    assert!(!codes(&found).contains(&"dead-channel"), "{:?}", codes(&found));
}

/// Friction that grows ever more slowly with speed, as a harmonic drive's does: no law goes beyond the speeds driven.
#[test]
fn concave_friction() {
    let friction = |speed: f64| 1.2 + 3.0 * speed - 0.8 * speed * speed;
    let joint = RigidJoint { inertia: 0.55, friction: Some(friction), ..RigidJoint::default() };
    let mut log =
        joint.follow(30_000, |t| 0.6 * (0.1 * TAU * t).sin() + 0.3 * (0.31 * TAU * t).sin());
    noisy(&mut log.measured, 0.1);
    let largest = log.measured.iter().fold(0.0, |m: f64, u| m.max(u.abs()));
    let fastest = log.speed.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let found = quick(&measured(&joint, log));
    within("inertia", found.inertia, 0.55, 0.03);
    let line = found.least_squares.as_ref().unwrap();
    let [from, to] = line.speed_range;
    assert!(from > 0.04 * fastest && to < 1.05 * fastest, "{from} to {to} of {fastest}");
    // The best straight line over these speeds, each as often as it was driven, lies between chord and tangent.
    let c = line.estimates.friction.coulomb.unwrap().value;
    assert!((1.2..1.5).contains(&c), "{c}");
    let law = found.friction_law.as_ref().unwrap();
    let coulomb = law.chosen.coulomb.unwrap().value;
    assert!(coulomb < largest, "{coulomb} in a log of {largest}");
    for share in [0.1, 0.3, 0.6, 0.95] {
        let speed = share * fastest;
        let by_law = law.chosen.friction(speed, 1.0).unwrap();
        assert!((by_law / friction(speed) - 1.0).abs() < 0.05, "{by_law} at {speed}");
    }
    for point in law.curve.iter().filter(|p| p.speed > 0.05 * fastest) {
        let truth = friction(point.speed);
        assert!((point.friction.value / truth - 1.0).abs() < 0.05, "{point:?}: {truth}");
    }
}

/// Between moves friction holds the motor, and its angle drifts by 1e-9 rad/s.
#[test]
fn creep_at_rest_is_rest() {
    let joint = RigidJoint { sample_time_s: 1e-3, ..RigidJoint::default() };
    let step = |x: f64| {
        let x = x.clamp(0.0, 1.0);
        x * x * x * (10.0 - 15.0 * x + 6.0 * x * x)
    };
    let places = [0.0, 1.0, -0.6, 0.8, -1.2, 0.4];
    let moves = |t: f64| {
        let k = t as usize;
        let [from, to] = [places[k % 6], places[(k + 1) % 6]];
        from + (to - from) * step((t - k as f64) / 0.5)
    };
    let log = joint.follow(18_000, moves);
    let drifts = log.angle.iter().zip(&log.time_s).map(|(q, t)| q - 1e-9 * t).collect();
    let one = run("log", &joint, log.held, drifts);
    let found = quick(&Campaign::new(channels(Hold::Sampled), vec![one]).unwrap());
    within("Coulomb", found.friction.coulomb, 0.15, 0.01);
    within("viscous", found.friction.viscous, 0.02, 0.01);
    within("inertia", found.inertia, 0.01, 0.01);
    let warned = found.findings.iter().any(|f| f.severity() > lissom::identify::Severity::Info);
    assert!(!warned, "{:?}", codes(&found));
}

/// An angle behind a filter, and a current behind one: both are found and counted.
#[test]
fn a_lag_of_either_channel_is_counted() {
    let low_pass = |of: &[f64], time_s: f64, joint: &RigidJoint| -> Vec<f64> {
        let share = 1.0 - (-joint.sample_time_s / time_s).exp();
        let mut state = of[0];
        let next = |x: &f64| {
            state += share * (x - state);
            state
        };
        of.iter().map(next).collect()
    };
    let joint = RigidJoint { sample_time_s: 1e-3, ..RigidJoint::default() };
    let log = joint.follow(20_000, two_sines);
    for late_current in [false, true] {
        let (mut current, mut angle) = (log.measured.clone(), log.angle.clone());
        let filtered = if late_current { &mut current } else { &mut angle };
        *filtered = low_pass(filtered, 5e-3, &joint);
        noisy(&mut current, 2e-3);
        let one = run("log", &joint, current, angle);
        let found = quick(&Campaign::new(channels(Hold::Measured), vec![one]).unwrap());
        within("Coulomb", found.friction.coulomb, 0.15, 0.03);
        within("viscous", found.friction.viscous, 0.02, 0.05);
        within("inertia", found.inertia, 0.01, 0.01);
        assert_eq!(codes(&found).first(), Some(&"angle-lag"), "late current: {late_current}");
        let time_s = found.friction_law.unwrap().lag.unwrap().time_s;
        let truth = if late_current { -5e-3 } else { 5e-3 };
        assert!((time_s / truth - 1.0).abs() < 0.15, "{time_s}");
    }
}

/// A held command that is said to be measured: half a sample.
#[test]
fn half_a_sample_is_the_wrong_hold() {
    let joint = RigidJoint { sample_time_s: 4e-3, steps: 40, ..RigidJoint::default() };
    let log = joint.follow(10_000, two_sines);
    let one = run("log", &joint, log.held, log.angle);
    let found = quick(&Campaign::new(channels(Hold::Measured), vec![one]).unwrap());
    let lag = found.findings.iter().find(|f| f.code() == "angle-lag");
    let lag =
        lag.unwrap_or_else(|| panic!("{:?} {:?}", codes(&found), found.findings[0].message()));
    assert!(lag.hint().contains("hold"), "{}", lag.hint());
    within("viscous", found.friction.viscous, 0.02, 0.01);
}

/// Friction of another slope each way behind a coarse encoder, whose noise fills short windows.
#[test]
fn slopes_that_differ_by_direction() {
    let joint = RigidJoint {
        sample_time_s: 1e-3,
        coulomb: 0.11,
        viscous: 0.026,
        backward: Some([0.07, 0.014]),
        ..RigidJoint::default()
    };
    let mut log = joint.follow(20_000, two_sines);
    let step = TAU / 16_384.0;
    log.angle.iter_mut().for_each(|q| *q = (*q / step).round() * step);
    noisy(&mut log.measured, 5e-3);
    let found = quick(&measured(&joint, log));
    let law = found.friction.law.unwrap();
    within("forward", law.forward, 0.11, 0.02);
    within("backward", law.backward, 0.07, 0.03);
    let (forward, backward) = law.viscous_by_direction.unwrap();
    within("viscous forward", Some(forward), 0.026, 0.03);
    within("viscous backward", Some(backward), 0.014, 0.05);
}

/// One way all the time, from one speed to the next under control: the changes show inertia.
#[test]
fn steps_of_speed_one_way() {
    let joint = RigidJoint { coulomb: 0.5, inertia: 0.02, viscous: 0.05, ..RigidJoint::default() };
    let speed = |t: f64| 3.0 + 2.0 * (0.15 * TAU * t).sin().signum();
    let log = joint.drive(12_000, |t, _, w| 0.5 + 0.05 * w + 0.1 * (speed(t) - w));
    let one = run("log", &joint, log.held, log.angle);
    let found = quick(&Campaign::new(channels(Hold::Sampled), vec![one]).unwrap());
    within("inertia", found.inertia, 0.02, 0.02);
    within("viscous", found.friction.viscous, 0.05, 0.03);
    within("friction with the load", found.friction.forward, 0.5, 0.02);
}

/// A measured current with noise, to which slip phases are no less certain: the estimates of both modes are the regression's.
#[test]
fn a_noisy_current_is_no_reason_to_replay() {
    let joint = RigidJoint::default();
    let mut log = joint.follow(10_000, two_sines);
    noisy(&mut log.measured, 0.02);
    let campaign = measured(&joint, log);
    let found = identify(&campaign, &Options::default(), |_| ()).unwrap();
    assert!(found.output_error.as_ref().is_some_and(|oe| oe.command_noise > 0.0 && !oe.stands()));
    let warned = |f: &&Finding| f.severity() > Severity::Info;
    assert_eq!(found.findings.iter().find(warned), None);
    assert_eq!(found.inertia, quick(&campaign).inertia);
}

/// A spindle in an open loop, whose friction wanders: what wanders accelerates it, and inertia comes out small.
#[test]
fn wandering_friction_in_an_open_loop() {
    let joint = RigidJoint { coulomb: 0.04, inertia: 1e-3, viscous: 1e-3, ..RigidJoint::default() };
    let mut state = 7_u32;
    let mut wander = 0.0;
    let drift: Vec<f64> = (0..30_000)
        .map(|_| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            wander += -2e-3 * wander + 1e-3 * (f64::from(state >> 8) / f64::from(1 << 23) - 1.0);
            wander
        })
        .collect();
    let held = |t: f64| 0.08 + 0.02 * (0.05 * TAU * t).sin().signum();
    let at = |t: f64| drift[(t / joint.sample_time_s) as usize];
    let log = joint.drive(30_000, |t, _, _| held(t) - at(t));
    let command = log.time_s.iter().map(|t| held(*t)).collect();
    let one = run("log", &joint, command, log.angle);
    let found = quick(&Campaign::new(channels(Hold::Sampled), vec![one]).unwrap());
    let short = Finding::is::<rows::InertiaShort>;
    assert!(found.findings.iter().any(short), "{:?}", codes(&found));
    let short_by = found.regression.unwrap().inertia_short_by.unwrap();
    let inertia = found.inertia.unwrap().value;
    // Friction moves the speed as well, so that the share is a bound.
    assert!(inertia < 0.8e-3 && inertia * (1.0 + short_by) > 1e-3, "{inertia} {short_by}");
}

/// The current's sign is wrong in every run: one finding says so, nothing is given, and nothing else is accused.
#[test]
fn a_reversed_command() {
    let joint = pendulum();
    let mut log = joint.follow(20_000, wide);
    log.measured.iter_mut().for_each(|i| *i = -*i);
    let found = quick(&measured(&joint, log).with_gravity().unwrap());
    assert_eq!(codes(&found)[0], "reversed-sign");
    let others = ["negative-estimate", "others-doubtful", "missing-term", "unexplained-torque"];
    assert!(!codes(&found).iter().any(|code| others.contains(code)), "{:?}", codes(&found));
    assert!(found.friction.coulomb.is_none() && found.inertia.is_none());
    assert!(found.gravity.is_none());
}

/// Friction that wanders by a few percent from stroke to stroke: its mean is given, and nothing warns of it.
#[test]
fn friction_that_varies_is_named() {
    let joint = RigidJoint { sample_time_s: 2e-3, ..RigidJoint::default() };
    let log = joint.follow(20_000, two_sines);
    let share = 0.05;
    let varied = |(k, (current, speed)): (usize, (&f64, &f64))| {
        let wave = (0.37 * 2e-3 * k as f64).sin() + (1.03 * 2e-3 * k as f64).sin();
        current + share * wave * joint.coulomb * speed.signum()
    };
    let current: Vec<f64> = log.measured.iter().zip(&log.speed).enumerate().map(varied).collect();
    let one = run("log", &joint, current, log.angle);
    let campaign = Campaign::new(channels(Hold::Measured), vec![one]).unwrap();
    for effort in [Effort::Quick, Effort::Normal] {
        let options = Options { effort, ..Options::default() };
        let found = identify(&campaign, &options, |_| ()).unwrap();
        assert_eq!(codes(&found).first(), Some(&"friction-varies"), "{:?}", codes(&found));
        let warnings = found.findings.iter().filter(|f| f.severity() != Severity::Info);
        assert_eq!(warnings.count(), 0, "{:?}", found.findings);
        // Two waves of that size each.
        let by = found.regression.as_ref().unwrap().left.varies_by;
        assert!((by / share - 1.0).abs() < 0.2, "{by}");
        within("Coulomb", found.friction.coulomb, 0.15, 0.02);
        within("inertia", found.inertia, 0.01, 0.01);
    }
}
