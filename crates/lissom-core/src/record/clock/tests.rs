use std::time::Instant;

use lissom_testmodels::{RigidJoint, RigidLog, two_sines};
use proptest::prelude::*;

use super::*;
use crate::finding::Finding;
use crate::record::Hold;

/// A 2 ms log of 40 s.
fn joint() -> RigidLog {
    RigidJoint::default().follow(20_000, two_sines)
}

/// Rows of a log, with other stamps.
fn rows(log: &RigidLog, kept: &[usize], stamp: impl Fn(usize) -> f64) -> LogRows {
    let pick = |channel: &[f64]| kept.iter().map(|&k| channel[k]).collect();
    LogRows {
        stamps_s: kept.iter().map(|&k| stamp(k)).collect(),
        sample_time_s: None,
        stamp_step_s: 1e-6,
        command: pick(&log.measured),
        hold: Hold::Measured,
        motor: pick(&log.angle),
        tips: Vec::new(),
    }
}

/// Largest distance of the angle of a part from that of the log at its times, linear between samples.
fn angle_error(part: &EvenPart, log: &RigidLog, from_s: f64) -> f64 {
    let error = |(k, q): (usize, &f64)| {
        let at = (from_s + k as f64 * part.time.sample_time_s) / 2e-3;
        let i = (at as usize).min(log.angle.len() - 2);
        (q - log.angle[i] - (at - i as f64) * (log.angle[i + 1] - log.angle[i])).abs()
    };
    part.motor.iter().enumerate().map(error).fold(0.0, f64::max)
}

fn uniform(k: usize) -> f64 {
    let mut x = (k as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    x ^= x >> 31;
    x = x.wrapping_mul(0xBF58_476D_1CE4_E5B9);
    (x >> 40) as f64 / f64::from(1 << 24)
}

fn gaps(note: &Finding) -> &note::Gap {
    note.get().unwrap()
}

/// Restarts of the clock that were joined, and those at which the log was cut, of the only note.
fn restarts(notes: &[Finding]) -> (usize, usize) {
    let [note] = notes else { panic!("{notes:?}") };
    let note: &note::ClockRestart = note.get().unwrap();
    (note.joined, note.cut)
}

/// Angles are interpolated this well \[rad\] where the speed is about 2 rad/s.
const INTERPOLATED: f64 = 4e-4;

#[test]
fn even_stamps_are_used_as_they_are() {
    let log = joint();
    let all: Vec<usize> = (0..20_000).collect();
    let even = even_parts(rows(&log, &all, |k| log.time_s[k]), &Trim::default(), 50).unwrap();
    let [part] = even.parts.as_slice() else { panic!("{} parts", even.parts.len()) };
    assert_eq!(part.motor, log.angle);
    assert_eq!(
        part.time,
        TimeBase {
            jitter_max_s: part.time.jitter_max_s,
            jitter_rms_s: part.time.jitter_rms_s,
            ..TimeBase::uniform(0.0, 2e-3)
        }
    );
    assert_eq!(part.notes, []);
}

#[test]
fn stamps_that_agree_with_the_motion_are_used() {
    let log = joint();
    let mut kept = vec![0];
    while kept.last().unwrap() + 6 < 20_000 {
        kept.push(kept.last().unwrap() + [5, 5, 6][kept.len() % 3]);
    }
    let even = even_parts(rows(&log, &kept, |k| log.time_s[k]), &Trim::default(), 50).unwrap();
    let [part] = even.parts.as_slice() else { panic!("{} parts", even.parts.len()) };
    assert!((part.time.sample_time_s - 0.032 / 3.0).abs() < 1e-5, "{:?}", part.time);
    let [note] = &part.notes[..] else { panic!("{:?}", part.notes) };
    let resampled: &note::Resampled = note.get().unwrap();
    assert!(resampled.agreement.unwrap() > 5.0 && resampled.error_share < 0.01, "{note}");
    assert!(angle_error(part, &log, 0.0) < INTERPOLATED, "{}", angle_error(part, &log, 0.0));
}

#[test]
fn late_stamps_are_counted() {
    let log = joint();
    let all: Vec<usize> = (0..20_000).collect();
    let late: Vec<f64> =
        (0..20_000).map(|k| log.time_s[k] - 1e-3 * uniform(k).max(1e-3).ln()).collect();
    let mut stamps = late.clone();
    for k in 1..stamps.len() {
        stamps[k] = stamps[k].max(stamps[k - 1] + 1e-6);
    }
    let even = even_parts(rows(&log, &all, |k| stamps[k]), &Trim::default(), 50).unwrap();
    let [part] = even.parts.as_slice() else { panic!("{} parts", even.parts.len()) };
    assert!((part.time.sample_time_s / 2e-3 - 1.0).abs() < 1e-4, "{:?}", part.time);
    assert_eq!(part.motor, log.angle);
    assert!(
        matches!(&part.notes[..], [note] if note.is::<note::SampleCount>()),
        "{:?}",
        part.notes
    );
}

#[test]
fn a_counted_log_keeps_its_pause() {
    let log = joint();
    let all: Vec<usize> = (0..20_000).filter(|k| !(9000..9400).contains(k)).collect();
    let even =
        even_parts(rows(&log, &all, |k| log.time_s[k] + 1e-3 * uniform(k)), &Trim::default(), 50)
            .unwrap();
    assert_eq!(even.parts.iter().map(|part| part.motor.len()).collect::<Vec<_>>(), [9000, 10_600]);
    let notes = &even.parts[0].notes;
    assert!(
        matches!(&notes[..], [a, b] if a.is::<note::SampleCount>() && gaps(b).count == 1),
        "{notes:?}"
    );
}

#[test]
fn a_sample_time_that_drifts_is_followed() {
    let log = joint();
    // 2 ms to 2.12 ms and back: rows of a 40 µs simulation.
    let fine = RigidJoint { sample_time_s: 4e-5, steps: 1, ..RigidJoint::default() }
        .follow(1_000_000, two_sines);
    let mut kept = vec![0_usize];
    while kept.last().unwrap() + 60 < 1_000_000 {
        let drift = 1.5 * (1.0 + (kept.len() as f64 * 6e-4).sin());
        kept.push(kept.last().unwrap() + 50 + drift.round() as usize);
    }
    let even = even_parts(rows(&fine, &kept, |k| fine.time_s[k]), &Trim::default(), 50).unwrap();
    let [part] = even.parts.as_slice() else { panic!("{} parts", even.parts.len()) };
    assert!(matches!(&part.notes[..], [note] if note.is::<note::Resampled>()), "{:?}", part.notes);
    let samples = fine.time_s.iter().step_by(50).zip(fine.angle.iter().step_by(50));
    let coarse = RigidLog { angle: samples.map(|(_, q)| *q).collect(), ..log };
    assert!(angle_error(part, &coarse, 0.0) < INTERPOLATED, "{}", angle_error(part, &coarse, 0.0));
}

#[test]
fn lost_rows_are_filled_in() {
    let log = joint();
    let kept: Vec<usize> =
        (0..20_000).filter(|&k| k == 0 || k == 19_999 || uniform(k) > 0.01).collect();
    let even = even_parts(rows(&log, &kept, |k| log.time_s[k]), &Trim::default(), 50).unwrap();
    let [part] = even.parts.as_slice() else { panic!("{} parts", even.parts.len()) };
    assert_eq!(part.motor.len(), 20_000);
    let lost = 20_000 - kept.len();
    assert!(
        matches!(&part.notes[..], [note] if note.get::<note::RowsFilled>().unwrap().count == lost),
        "{:?}",
        part.notes
    );
    assert!(angle_error(part, &log, 0.0) < 0.1 * INTERPOLATED, "{}", angle_error(part, &log, 0.0));
}

#[test]
fn long_gaps_cut_and_are_one_note() {
    let log = joint();
    let kept: Vec<usize> =
        (0..20_000).filter(|k| k % 1000 < 900 && !(5010..5900).contains(k)).collect();
    let even = even_parts(rows(&log, &kept, |k| log.time_s[k]), &Trim::default(), 50).unwrap();
    assert_eq!((even.cuts, even.parts.len()), (19, 19));
    let notes = &even.parts[0].notes;
    let [gap, piece] = &notes[..] else { panic!("{notes:?}") };
    let (gap, piece): (_, &note::PieceDropped) = (gaps(gap), piece.get().unwrap());
    assert_eq!((gap.count, piece.count, piece.samples), (19, 1, 10));
    let length_s = gap.length_s;
    assert!((length_s - 1.982).abs() < 1e-9, "{length_s}");
    assert!(even.parts[1..].iter().all(|part| part.notes.is_empty()));
}

#[test]
fn a_clock_that_starts_again_goes_on_with_the_motion() {
    let log = joint();
    let all: Vec<usize> = (0..20_000).collect();
    let even =
        even_parts(rows(&log, &all, |k| log.time_s[k % 2500]), &Trim::default(), 50).unwrap();
    let [part] = even.parts.as_slice() else { panic!("{} parts", even.parts.len()) };
    assert_eq!(part.motor, log.angle);
    assert!(restarts(&part.notes) == (7, 0), "{:?}", part.notes);
}

#[test]
fn two_recordings_in_one_log_are_cut() {
    let log = joint();
    let kept: Vec<usize> = (0..5000).chain(8000..12_000).collect();
    let first = |k: usize| if k < 5000 { 0 } else { 8000 };
    let even =
        even_parts(rows(&log, &kept, |k| log.time_s[k - first(k)]), &Trim::default(), 50).unwrap();
    assert_eq!(even.parts.iter().map(|part| part.motor.len()).collect::<Vec<_>>(), [5000, 4000]);
    let notes = &even.parts[0].notes;
    assert!(restarts(notes) == (0, 1), "{notes:?}");
}

#[test]
fn rows_out_of_order_are_refused() {
    let log = joint();
    let mut kept: Vec<usize> = (0..1000).collect();
    kept.swap(500, 501);
    let result = even_parts(rows(&log, &kept, |k| log.time_s[k]), &Trim::default(), 50);
    assert_eq!(result, Err(ClockError::NotIncreasing { row: 501 }));
    kept.swap(500, 501);
    let far = kept.remove(900);
    kept.insert(200, far);
    let result = even_parts(rows(&log, &kept, |k| log.time_s[k]), &Trim::default(), 50);
    assert_eq!(result, Err(ClockError::NotIncreasing { row: 201 }));
}

#[test]
fn another_sample_time_makes_another_run() {
    let log = joint();
    let kept: Vec<usize> = (0..10_000).step_by(2).chain(10_000..20_000).collect();
    let even = even_parts(rows(&log, &kept, |k| log.time_s[k]), &Trim::default(), 50).unwrap();
    let times: Vec<f64> = even.parts.iter().map(|part| part.time.sample_time_s).collect();
    assert_eq!(times, [4e-3, 2e-3]);
    let samples: usize = even.parts.iter().map(|part| part.motor.len()).sum();
    assert_eq!(samples, kept.len());
    let notes = &even.parts[0].notes;
    assert!(
        matches!(&notes[..], [note] if note.get::<note::RateChange>().unwrap().rates == 2),
        "{notes:?}"
    );
}

#[test]
fn repeated_readings_are_removed() {
    let log = joint();
    let kept: Vec<usize> = (0..20_000).flat_map(|k| [k, k]).collect();
    let mut polled = rows(&log, &kept, |_| 0.0);
    polled.stamps_s = (0..40_000).map(|k| k as f64 * 1e-3).collect();
    let without_stamps = LogRows { sample_time_s: Some(1e-3), ..polled.clone() };
    for polled in [polled, without_stamps] {
        let even = even_parts(polled, &Trim::default(), 50).unwrap();
        let [part] = even.parts.as_slice() else { panic!("{} parts", even.parts.len()) };
        assert_eq!((part.time.sample_time_s, part.motor.len()), (2e-3, 20_000));
        assert!(
            matches!(&part.notes[..], [note] if note.get::<note::RepeatedReadings>().unwrap().removed == 20_000),
            "{:?}",
            part.notes
        );
    }
}

#[test]
fn readings_that_are_repeated_two_or_three_times_are_counted() {
    let log = joint();
    let kept: Vec<usize> = (0..40_000).map(|k| k * 2 / 5).collect();
    let mut polled = rows(&log, &kept, |_| 0.0);
    polled.stamps_s = (0..40_000).map(|k| k as f64 * 0.8e-3).collect();
    let even = even_parts(polled, &Trim::default(), 50).unwrap();
    let [part] = even.parts.as_slice() else { panic!("{} parts", even.parts.len()) };
    assert!((part.time.sample_time_s / 2e-3 - 1.0).abs() < 1e-3, "{:?}", part.time);
    assert_eq!(part.motor.len(), 16_000);
}

#[test]
fn a_coarse_encoder_is_not_a_repeated_reading() {
    let log = joint();
    let all: Vec<usize> = (0..20_000).collect();
    let mut coarse = rows(&log, &all, |k| log.time_s[k]);
    for (k, q) in coarse.motor.iter_mut().enumerate() {
        *q = (*q / 0.02).round() * 0.02;
        // A command that changes every second row, and one that does not.
        coarse.command[k] = if k % 4 < 2 { 1.0 } else { -1.0 };
    }
    let constant = LogRows { command: vec![1.0; 20_000], ..coarse.clone() };
    for coarse in [coarse, constant] {
        let even = even_parts(coarse, &Trim::default(), 50).unwrap();
        assert_eq!((even.parts[0].motor.len(), even.parts[0].notes.len()), (20_000, 0));
    }
}

#[test]
fn the_even_grid_is_used_where_the_encoder_hides_the_difference() {
    let log = joint();
    let all: Vec<usize> = (0..20_000).collect();
    let mut coarse = rows(&log, &all, |k| log.time_s[k] + 4e-4 * uniform(k));
    coarse.motor.iter_mut().for_each(|q| *q = (*q / 0.05).round() * 0.05);
    let even = even_parts(coarse, &Trim::default(), 50).unwrap();
    let [part] = even.parts.as_slice() else { panic!("{} parts", even.parts.len()) };
    assert_eq!((part.motor.len(), part.notes.len()), (20_000, 0));
    assert!((part.time.sample_time_s / 2e-3 - 1.0).abs() < 1e-3, "{:?}", part.time);
    assert!(part.time.jitter_rms_s > 1e-4);
}

#[test]
fn the_head_is_left_out_after_the_clock_is_continued() {
    let log = joint();
    let all: Vec<usize> = (0..20_000).collect();
    let even = even_parts(rows(&log, &all, |k| log.time_s[k % 2500]), &head(6.0), 50).unwrap();
    assert_eq!(even.parts[0].motor, log.angle[3000..]);
    let nothing = even_parts(rows(&log, &all[..100], |k| log.time_s[k]), &head(6.0), 50);
    assert!(matches!(nothing, Err(ClockError::NothingLeft { left: 0, .. })), "{nothing:?}");
}

fn head(skip_s: f64) -> Trim {
    Trim { skip_s, ..Trim::default() }
}

#[test]
fn stretches_that_are_left_out_cut_the_log() {
    let log = joint();
    let all: Vec<usize> = (0..2500).collect();
    let trim =
        Trim { skip_s: 0.099, until_s: Some(4.0), left_out_s: vec![[0.999, 2.001], [3.899, 9.0]] };
    for sample_time_s in [None, Some(2e-3)] {
        let rows = LogRows { sample_time_s, ..rows(&log, &all, |k| 5.0 + log.time_s[k]) };
        let even = even_parts(rows, &trim, 50).unwrap();
        assert_eq!((even.cuts, even.parts.len()), (1, 2));
        assert_eq!(even.parts[0].motor, log.angle[50..500]);
        assert_eq!(even.parts[1].motor, log.angle[1001..1950]);
    }
    let nothing = Trim { left_out_s: vec![[0.0, 9.0]], ..Trim::default() };
    let result = even_parts(rows(&log, &all, |k| log.time_s[k]), &nothing, 50);
    assert!(matches!(result, Err(ClockError::NothingLeft { left: 0, .. })), "{result:?}");
}

#[test]
fn stamps_that_are_no_clock_are_refused() {
    let log = joint();
    let all: Vec<usize> = (0..1000).collect();
    for stamp in [0.0, f64::NAN] {
        let result = even_parts(rows(&log, &all, |_| stamp), &Trim::default(), 50);
        assert_eq!(result, Err(ClockError::NotIncreasing { row: 1 }));
    }
    let two = even_parts(rows(&log, &[0, 1], |k| log.time_s[k]), &Trim::default(), 50).unwrap();
    assert_eq!(two.parts[0].motor.len(), 2);
}

#[test]
fn a_million_uneven_rows_take_seconds() {
    let n = 1_000_000;
    let started = Instant::now();
    let mut stamp = 0.0;
    let stamps_s: Vec<f64> = (0..n)
        .map(|k| {
            stamp += 1e-3 * (0.05 + uniform(k)) * if k % 10_000 == 0 { 1e3 } else { 1.0 };
            stamp
        })
        .collect();
    let motor: Vec<f64> = stamps_s.iter().map(|t| t.sin()).collect();
    let log = LogRows {
        stamps_s,
        sample_time_s: None,
        stamp_step_s: 1e-6,
        command: motor.clone(),
        hold: Hold::Sampled,
        motor,
        tips: Vec::new(),
    };
    let even = even_parts(log, &Trim::default(), 50).unwrap();
    assert!(even.parts.len() > 90, "{}", even.parts.len());
    assert!(even.parts[0].notes.len() <= 3, "{:?}", even.parts[0].notes);
    assert!(started.elapsed().as_secs_f64() < 20.0, "{:?}", started.elapsed());
}

proptest! {
    #[test]
    fn no_steps_panic(
        steps in proptest::collection::vec(prop_oneof![Just(1.0), Just(2.0), Just(-40.0), Just(1e9), 1e-12..3.0f64], 1..300),
        seed in 0..1000_usize,
        held in any::<bool>(),
        skip_s in prop_oneof![Just(0.0), 0.0..20.0f64],
    ) {
        let mut stamp = 0.0;
        let mut stamps_s: Vec<f64> = steps.iter().map(|step| { stamp += step; stamp }).collect();
        stamps_s.insert(0, 0.0);
        let channel = |k: usize| (0..stamps_s.len()).map(|i| uniform(i * 7 + k + seed)).collect::<Vec<f64>>();
        let log = LogRows {
            sample_time_s: None,
            stamp_step_s: 0.0,
            command: channel(0),
            hold: if held { Hold::Sampled } else { Hold::Measured },
            motor: channel(1),
            tips: vec![channel(2)],
            stamps_s: stamps_s.clone(),
        };
        if let Ok(even) = even_parts(log, &head(skip_s), 5) {
            for part in even.parts {
                let n = part.motor.len();
                prop_assert_eq!((part.command.len(), part.tips[0].len()), (n, n));
                let all = part.motor.iter().chain(&part.command).chain(&part.tips[0]);
                prop_assert!(all.into_iter().all(|x| x.is_finite()));
                prop_assert!(n < 12 * stamps_s.len() + 12);
            }
        }
    }
}
