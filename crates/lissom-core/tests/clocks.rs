//! One motion on clocks that logs have: inertia and friction are those of the joint on each of them.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use lissom::identify::findings::rows;
use lissom::identify::{Effort, Finding, Identified, Options, identify};
use lissom::record::clock::{LogRows, Trim, even_parts};
use lissom::record::{Axis, Campaign, Channels, Command, CommandQuantity, Hold, Run};
use lissom_testmodels::{RigidJoint, two_sines};

/// Relative errors of inertia and Coulomb friction, and of viscous friction.
const ERROR: f64 = 0.01;
const VISCOUS_ERROR: f64 = 0.02;

fn uniform(k: usize) -> f64 {
    let mut x = (k as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    x ^= x >> 31;
    x = x.wrapping_mul(0xBF58_476D_1CE4_E5B9);
    (x >> 40) as f64 / f64::from(1 << 24)
}

/// The rows `kept` of a log of 40 s, with other stamps.
#[track_caller]
fn identified<Row: 'static>(kept: &[usize], stamps_s: Vec<f64>, hold: Hold) -> Identified {
    let joint = RigidJoint::default();
    let log = joint.follow(20_000, two_sines);
    let pick = |channel: &[f64]| kept.iter().map(|&k| channel[k]).collect::<Vec<f64>>();
    let command = if hold == Hold::Sampled { &log.held } else { &log.measured };
    let log_rows = LogRows {
        stamps_s,
        sample_time_s: None,
        stamp_step_s: 1e-6,
        command: pick(command),
        hold,
        motor: pick(&log.angle),
        tips: Vec::new(),
    };
    let even = even_parts(log_rows, &Trim::default(), 50).unwrap();
    let runs = even.parts.into_iter().enumerate().map(|(index, part)| {
        let run =
            Run::new(format!("log [{index}]"), part.time, part.command, part.motor, part.tips);
        part.notes.into_iter().fold(run.unwrap(), Run::with_note)
    });
    let command = Command {
        quantity: CommandQuantity::Current,
        hold,
        torque_per_command: Some(1.0),
        back_emf_viscous: 0.0,
        limit: None,
    };
    let channels = Channels { axis: Axis::Rotary, command, tips: vec![] };
    let campaign = Campaign::new(channels, runs.collect()).unwrap();
    let options = Options { effort: Effort::Quick, ..Options::default() };
    let found = identify(&campaign, &options, |_| ()).unwrap();
    let codes: Vec<&str> = found.findings.iter().map(Finding::code).collect();
    assert_eq!(found.findings.iter().filter(|f| f.is::<Row>()).count(), 1, "{codes:?}");
    let off = |found: f64, exact: f64| (found / exact - 1.0).abs();
    let inertia = found.inertia.unwrap().value;
    assert!(off(inertia, joint.inertia) < ERROR, "inertia {inertia}");
    let coulomb = found.friction.coulomb.unwrap().value;
    assert!(off(coulomb, joint.coulomb) < ERROR, "Coulomb {coulomb}");
    let viscous = found.friction.viscous.unwrap().value;
    assert!(off(viscous, joint.viscous) < VISCOUS_ERROR, "viscous {viscous}");
    found
}

fn time_s(k: usize) -> f64 {
    k as f64 * 2e-3
}

#[test]
fn a_clock_read_every_10_or_12_ms() {
    let mut kept = vec![0];
    while kept.last().unwrap() + 6 < 20_000 {
        kept.push(kept.last().unwrap() + [5, 5, 6][kept.len() % 3]);
    }
    let stamps_s = kept.iter().map(|&k| time_s(k)).collect();
    identified::<rows::Resampled>(&kept, stamps_s, Hold::Measured);
}

#[test]
fn a_loop_that_is_late_now_and_then() {
    // 4 ms, and 6 ms where something else needed the computer; the command is held for as long.
    let mut kept = vec![0];
    while kept.last().unwrap() + 3 < 20_000 {
        kept.push(kept.last().unwrap() + if uniform(kept.len()) < 0.2 { 3 } else { 2 });
    }
    let stamps_s = kept.iter().map(|&k| time_s(k)).collect();
    identified::<rows::Resampled>(&kept, stamps_s, Hold::Measured);
}

#[test]
fn lost_rows() {
    for hold in [Hold::Measured, Hold::Sampled] {
        let kept: Vec<usize> = (0..20_000).filter(|&k| uniform(k) > 0.01).collect();
        let stamps_s = kept.iter().map(|&k| time_s(k)).collect();
        identified::<rows::RowsFilled>(&kept, stamps_s, hold);
    }
}

#[test]
fn late_stamps() {
    let kept: Vec<usize> = (0..20_000).collect();
    let mut stamps_s: Vec<f64> =
        kept.iter().map(|&k| time_s(k) - (1e-3 * uniform(k).max(3e-3).ln())).collect();
    for k in 1..stamps_s.len() {
        stamps_s[k] = stamps_s[k].max(stamps_s[k - 1] + 1e-6);
    }
    identified::<rows::SampleCount>(&kept, stamps_s, Hold::Sampled);
}

#[test]
fn a_clock_that_starts_again() {
    let kept: Vec<usize> = (0..20_000).collect();
    let stamps_s = kept.iter().map(|&k| time_s(k % 2500)).collect();
    identified::<rows::ClockRestart>(&kept, stamps_s, Hold::Sampled);
}

#[test]
fn a_sample_time_that_changes() {
    let kept: Vec<usize> = (0..10_000).step_by(2).chain(10_000..20_000).collect();
    let stamps_s = kept.iter().map(|&k| time_s(k)).collect();
    identified::<rows::RateChange>(&kept, stamps_s, Hold::Measured);
}

#[test]
fn repeated_readings() {
    let kept: Vec<usize> = (0..20_000).flat_map(|k| [k, k]).collect();
    let stamps_s = (0..40_000).map(|k| k as f64 * 1e-3).collect();
    identified::<rows::RepeatedReadings>(&kept, stamps_s, Hold::Measured);
}
