//! Logs that are used, and what is said of them.

use lissom::identify::{Options, identify};
use lissom_io::{CampaignReader, ReadOptions};

use crate::bench::{Bench, Row, csv, good, motion, sticking, text};

/// Relative error of Coulomb friction on an ideal log: its numbers have six decimals.
const COULOMB_ERROR: f64 = 1e-4;

/// The good log with every row changed by `change`, which gets its number.
fn changed(change: impl Fn(usize, &mut Row)) -> Bench {
    let mut rows = good();
    rows.iter_mut().enumerate().for_each(|(k, row)| change(k, row));
    Bench::log(csv(&rows))
}

#[test]
fn the_good_log_is_used_without_a_warning() {
    let result = Bench::new().result();
    let coulomb = result["friction"]["coulomb"]["value"].as_f64().unwrap();
    assert!((coulomb / 0.05 - 1.0).abs() < COULOMB_ERROR, "{coulomb}");
    let findings = result["findings"].as_array().unwrap();
    let warnings: Vec<_> = findings.iter().filter(|f| f["severity"] == "warning").collect();
    assert!(warnings.is_empty(), "{warnings:?}");
}

#[test]
fn runs_of_different_sampling_are_used_together() {
    let bench = Bench::adding("[[runs]]\nfile = \"slow.csv\"\n")
        .file("slow.csv", csv(&motion(2.0, 0.008, 40.0)));
    let result = bench.result();
    let runs = result["runs"].as_array().unwrap();
    let times: Vec<_> = runs.iter().map(|run| run["sample_time_s"].as_f64().unwrap()).collect();
    assert_eq!(times, [0.005, 0.008]);
    let coulomb = result["friction"]["coulomb"]["value"].as_f64().unwrap();
    assert!((coulomb / 0.05 - 1.0).abs() < COULOMB_ERROR, "{coulomb}");
    let output = bench.identify(&["campaign.toml"]);
    assert_eq!(
        text(&output.stdout).lines().next().unwrap(),
        "2 runs, 9000 samples every 5 to 8 ms, current measured, 1 tip"
    );
}

#[test]
fn gaps_cut_a_log_into_runs() {
    let mut rows = good();
    rows.drain(1520..1600);
    rows.drain(1400..1500);
    let bench = Bench::log(csv(&rows));
    assert_eq!(
        bench.findings("log-cut"),
        [
            "run.csv [1/2]: the log has 2 gaps, the longest of 0.5050 s after 6.9950 s: it is cut there into separate runs"
        ]
    );
    assert_eq!(
        bench.findings("left-out"),
        [
            "run.csv [1/2]: the piece of the log from 7.5000 s on, between two cuts, has only 20 samples: it is not used"
        ]
    );
}

#[test]
fn a_long_log_is_thinned() {
    let bench = Bench::new();
    let options = ReadOptions { max_rows: 1500, ..ReadOptions::default() };
    let file = CampaignReader::of_file(&bench.path().join("campaign.toml"))
        .options(options)
        .read()
        .unwrap();
    assert_eq!(file.campaign.runs[0].len(), 1000);
    let identified = identify(&file.campaign, &Options::default(), |_| {}).unwrap();
    let thinned: Vec<_> = identified.findings.iter().filter(|f| f.code() == "thinned").collect();
    let [finding] = &thinned[..] else { panic!("{thinned:?}") };
    assert_eq!(
        finding.message(),
        "the log has too many rows and is thinned: one sample for every 4 rows"
    );
    assert_eq!(finding.run.as_deref(), Some("run.csv"));
}

#[test]
fn a_head_is_skipped() {
    let bench = Bench::adding("skip = \"2 s\"\n");
    assert_eq!(
        bench.findings("left-out"),
        ["run.csv: the first 2 s are left out, as the campaign asks"]
    );
}

#[test]
fn late_stamps_are_counted() {
    let off = |k: usize| ((k * 7919 % 11) as f64 / 5.0 - 1.0) * 1e-3;
    let found = changed(|k, row| row[0] += off(k)).findings("uneven-stamps");
    let [found] = found.as_slice() else { panic!("{found:?}") };
    let start = "run.csv: time stamps are uneven by 13 % of a step (rms), and the motion contradicts them (with the stamps the \
                 prediction error of the angle is";
    assert!(found.starts_with(start), "{found}");
    let end = "times that with even times): the samples are taken as evenly spaced, with a sample time of 5.00000 ms";
    assert!(found.ends_with(end), "{found}");
}

#[test]
fn jitter_is_measured_where_the_angle_does_not_show_the_clock() {
    let off = |k: usize| ((k * 7919 % 11) as f64 / 5.0 - 1.0) * 1e-3;
    let coarse = |k: usize, row: &mut Row| {
        row[0] += off(k);
        row[2] = (row[2] / 0.1).round() * 0.1;
    };
    let found = changed(coarse).findings("uneven-stamps");
    let [found] = found.as_slice() else { panic!("{found:?}") };
    assert!(found.starts_with("run.csv: time stamps differ from an even grid by 12."), "{found}");
}

#[test]
fn saturation_is_seen_with_and_without_a_known_limit() {
    let bench = changed(|_, row| row[1] = row[1].clamp(-0.5, 0.5));
    let campaign = crate::bench::CAMPAIGN.replace("[drive]", "[drive]\ncurrent_limit = \"0.5 A\"");
    assert_eq!(
        bench.findings("saturation"),
        [
            "run.csv: the measured command stays at its largest value for 50.2 % of the run: if the sensor ends there and \
             the drive does not, torque is missing and all estimates are wrong"
        ]
    );
    assert_eq!(
        bench.file("campaign.toml", campaign).findings("saturation"),
        [
            "run.csv: the command is at its limit for 50.2 % of the run: the limit adds harmonics, which the \
          third-harmonic method and the corrected response take for friction"
        ]
    );
}

#[test]
fn periods_are_counted() {
    assert_eq!(
        Bench::log(csv(&motion(1.0, 0.005, 26.0))).findings("not-periodic"),
        ["run.csv: only 4 periods are in steady state: standard errors of the harmonics are rough"]
    );
    let slow = Bench::adding("omega_rad_s = 0.5\n").file("run.csv", csv(&motion(0.5, 0.005, 20.0)));
    assert_eq!(
        slow.findings("not-sinusoidal"),
        [
            "run.csv: at the given 0.5000 rad/s the log has 1 of the 3 blocks of whole periods that a steady state needs. \
          The run is used as a general motion, not as a sine"
        ]
    );
}

#[test]
fn another_frequency_than_the_stated_one_is_seen() {
    assert_eq!(
        Bench::adding("omega_rad_s = 5\n").findings("not-sinusoidal"),
        [
            "run.csv: the motion is not a sinusoid of the given 5.0000 rad/s: 100 % of the motor's power is not explained, \
          and the harmonics are 76 % of the fundamental; the motor itself moves at 4.0000 rad/s (0.6366 Hz). The run is \
          used as a general motion, not as a sine"
        ]
    );
}

#[test]
fn a_dead_channel_is_named() {
    let dead = |column: usize| {
        let mut rows = good();
        for row in &mut rows {
            row[column] = 0.25;
        }
        Bench::adding("[[runs]]\nfile = \"dead.csv\"\n").file("dead.csv", csv(&rows))
    };
    assert_eq!(
        dead(3).findings("dead-channel"),
        ["dead.csv: tip tip is constant at 0.25 rad: the regression does not use this run"]
    );
    assert_eq!(
        dead(2).findings("dead-channel"),
        ["dead.csv: the motor channel is constant at 0.25 rad: this run is not used"]
    );
    assert_eq!(
        dead(1).findings("dead-channel"),
        ["dead.csv: the command channel is constant at 0.25 A: this run is not used"]
    );
}

#[test]
fn a_clipped_motor_is_seen() {
    assert_eq!(
        changed(|_, row| row[2] = row[2].clamp(-0.8, 0.8)).findings("clipped-channel"),
        [
            "run.csv: the motor channel stays at its largest or smallest value for 41.2 % of the run: the log does not \
          contain the motion beyond it, and estimates from this run are affected"
        ]
    );
}

#[test]
fn a_lone_reading_is_replaced_and_many_are_reported() {
    let spiked = |i: usize, row: &mut Row| {
        if i == 400 {
            row[2] += 3.0;
        }
    };
    let bench = changed(spiked);
    let found = bench.findings("readings-corrected");
    let [told] = &found[..] else { panic!("{found:?}") };
    assert!(told.contains("the motor reads 3."), "{told}");
    assert!(told.contains("far from the readings before and after it"), "{told}");
    assert!(bench.findings("wrong-readings").is_empty());
    let many = |i: usize, row: &mut Row| {
        if i % 200 == 100 {
            row[2] += 3.0;
        }
    };
    let found = changed(many).findings("wrong-readings");
    let [told] = &found[..] else { panic!("{found:?}") };
    assert!(told.contains("the motor channel has a spike"), "{told}");
}

#[test]
fn drift_is_measured() {
    let drifting = |_: usize, row: &mut Row| {
        row[2] += 0.02 * row[0];
        row[3] += 0.02 * row[0];
    };
    assert_eq!(
        changed(drifting).findings("drift"),
        [
            "run.csv: the motor drifts by 38 % of its amplitude over the periods used: the offset and the corrected response \
          are affected"
        ]
    );
}

#[test]
fn a_third_harmonic_above_nyquist_is_seen() {
    assert_eq!(
        Bench::log(csv(&motion(4.0, 0.3, 300.0))).findings("harmonic-above-nyquist"),
        [
            "run.csv: the third harmonic (12.0 rad/s) is not below 0.9 of the Nyquist frequency (10.5 rad/s): it is not \
          measured"
        ]
    );
}

#[test]
fn sticking_is_measured() {
    assert_eq!(
        Bench::log(csv(&sticking())).findings("sticking"),
        [
            "run.csv: the joint sticks for about 9 % of the cycle: the estimate of the third-harmonic method is too low, \
             because it assumes friction without sticking. Other methods are not affected"
        ]
    );
}

#[test]
fn a_motor_that_comes_to_rest_is_no_sinusoid() {
    let bench = changed(|k, row| {
        if k > 2000 {
            row[1..].fill(0.0);
        }
    });
    assert_eq!(
        bench.findings("mostly-at-rest"),
        ["run.csv: the motor stands still for 48 % of the run: this part gives little information"]
    );
    let result = bench.result();
    assert!(!result.to_string().contains("NaN"), "{:#}", result["findings"]);
    assert_eq!(bench.findings("transient-dropped"), [""; 0]);
}
