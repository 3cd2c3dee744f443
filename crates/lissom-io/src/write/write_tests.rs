#![expect(clippy::float_cmp, reason = "these numbers are exact")]

use std::path::Path;

use lissom_core::plan::{
    ArmParameter, Expected, Plan, PlanNote, PlannedMotion, PlannedParameter, PlannedRun as Motion,
};
use lissom_core::record::{Hold, TipQuantity};
use proptest::prelude::*;

use super::{
    Batch, CampaignPlan, PLAN_HEAD, PlannedCommand, PlannedRun, campaign_text, csv_text, plan_text,
    write_campaign, write_csv, write_json, write_text, write_whole,
};
use crate::PlanFile;
use crate::log::{ColumnRef, LogColumn, LogOptions, read_log_from};

#[test]
fn a_file_is_written_whole_or_not_at_all() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    write_text(&path, "first").unwrap();
    let error = write_whole(&path, |out| {
        out.write_all(b"half")?;
        Err(std::io::Error::other("the source broke"))
    })
    .unwrap_err();
    assert_eq!(
        error.to_string(),
        format!("{}: cannot be written: the source broke", path.display())
    );
    assert_eq!(error.hint().as_deref(), Some("check the path"));
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "first");
    write_text(&path, "second").unwrap();
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "second");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[cfg(unix)]
#[test]
fn links_and_devices_stay_what_they_are() {
    let folder = tempfile::tempdir().unwrap();
    let (target, link) = (folder.path().join("a.txt"), folder.path().join("link"));
    write_text(&target, "first").unwrap();
    std::os::unix::fs::symlink(&target, &link).unwrap();
    write_text(&link, "second").unwrap();
    let mut batch = Batch::new();
    batch.file(&link, b"third").unwrap();
    assert_eq!(std::fs::read_to_string(&target).unwrap(), "second");
    batch.commit().unwrap();
    assert!(std::fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(std::fs::read_to_string(&target).unwrap(), "third");

    // A device by another name, which may be replaced without harm if this fails.
    let device = folder.path().join("device");
    std::os::unix::fs::symlink("/dev/null", &device).unwrap();
    write_text(&device, "lost").unwrap();
    let mut batch = Batch::new();
    batch.file(&device, b"lost").unwrap();
    batch.commit().unwrap();
    assert!(!std::fs::metadata(&device).unwrap().is_file());
}

#[test]
fn a_batch_appears_together_or_not_at_all() {
    let root = tempfile::tempdir().unwrap();
    let inside = |name: &str| root.path().join(name);
    let mut batch = Batch::new();
    batch.folder(&inside("new/plots")).unwrap();
    batch.file(&inside("new/plots/a.svg"), b"a").unwrap();
    batch.file(&inside("b.json"), b"b").unwrap();
    assert!(!inside("b.json").exists());
    let error = batch.file(&inside("new"), b"c").unwrap_err();
    assert_eq!(error.hint().as_deref(), Some("give a file name, not a folder"));
    drop(batch);
    assert_eq!(std::fs::read_dir(root.path()).unwrap().count(), 0);

    let mut batch = Batch::new();
    batch.folder(&inside("new/plots")).unwrap();
    batch.file(&inside("new/plots/a.svg"), b"a").unwrap();
    batch.file(&inside("b.json"), b"b").unwrap();
    batch.commit().unwrap();
    assert_eq!(std::fs::read(inside("new/plots/a.svg")).unwrap(), b"a");
    assert_eq!(std::fs::read(inside("b.json")).unwrap(), b"b");
    assert_eq!(std::fs::read_dir(root.path()).unwrap().count(), 2);
}

#[test]
fn a_missing_folder_is_named() {
    let error = write_text(Path::new("no/such/a.txt"), "").unwrap_err();
    assert_eq!(
        error.to_string(),
        "no/such/a.txt: cannot be written: No such file or directory (os error 2)"
    );
    assert_eq!(error.hint().as_deref(), Some("create the folder first"));
    let error = write_text(Path::new(".."), "").unwrap_err();
    assert_eq!(error.to_string(), "..: cannot be written: is a directory");
    assert_eq!(error.hint().as_deref(), Some("give a file name, not a folder"));
}

#[test]
fn numbers_are_short_and_exact() {
    let text = csv_text(&[("t, s", &[0.0, 0.1, 1e-9]), ("x", &[-1.5, 1e300, 0.25])]).unwrap();
    assert_eq!(text, "\"t, s\",x\n0,-1.5\n0.1,1e300\n1e-9,0.25\n");
    let error = csv_text(&[("t", &[0.0]), ("x", &[])]).unwrap_err();
    assert_eq!(error.to_string(), "column \"x\" has 0 rows, but \"t\" has 1");
    assert_eq!(csv_text(&[]).unwrap(), "\n");
}

#[test]
fn json_is_indented_and_ends_with_a_newline() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.json");
    write_json(&path, &[1.5]).unwrap();
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "[\n  1.5\n]\n");
    let keys = std::collections::BTreeMap::from([((1, 2), 3)]);
    let error = write_json(&path, &keys).unwrap_err();
    assert_eq!(
        error.to_string(),
        format!("{}: cannot be written as JSON: key must be a string", path.display())
    );
}

fn plan() -> CampaignPlan {
    CampaignPlan {
        title: "Stepped sines\nof a virtual arm".to_owned(),
        time_column: "t".to_owned(),
        command: PlannedCommand { column: "i \"set\"".to_owned(), hold: Hold::Sampled },
        motor_column: "theta_m".to_owned(),
        tips: vec![("tip".to_owned(), "theta_t".to_owned(), TipQuantity::Angle)],
        torque_constant_nm_per_a: Some(0.25),
        current_limit_a: Some(4.12),
        gravity: false,
        arm: None,
        runs: vec![
            PlannedRun { file: "run-01.csv".to_owned(), omega_rad_s: Some(3.0) },
            PlannedRun { file: "run-02.csv".to_owned(), omega_rad_s: None },
        ],
    }
}

#[test]
fn a_campaign_is_written_as_its_contract_says() {
    assert_eq!(
        campaign_text(&plan()),
        r#"# Stepped sines
# of a virtual arm
[signals]
time = { column = "t", unit = "s" }
current = { column = 'i "set"', unit = "A", hold = "sampled" }
motor = { column = "theta_m", unit = "rad" }
tips = [
    { name = "tip", column = "theta_t", unit = "rad", quantity = "angle" },
]

[drive]
torque_constant = "0.25 N*m/A"
current_limit = "4.12 A"

[[runs]]
file = "run-01.csv"
omega_rad_s = 3.0

[[runs]]
file = "run-02.csv"
"#
    );
}

#[test]
fn gravity_is_written_into_a_campaign() {
    let text = campaign_text(&CampaignPlan { gravity: true, ..plan() });
    assert!(text.contains("\n[load]\ngravity = true\n\n[[runs]]\n"), "{text}");
}

#[test]
fn what_is_written_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let mut plan = plan();
    plan.command.column = "i".to_owned();
    let stamps: Vec<f64> = (0..100).map(|k| f64::from(k) * 0.003).collect();
    let signal: Vec<f64> = stamps.iter().map(|t| (3.0 * t).sin()).collect();
    let tip: Vec<f64> = signal.iter().map(|angle| 1.1 * angle).collect();
    for run in &plan.runs {
        let columns: [(&str, &[f64]); 4] =
            [("t", &stamps), ("i", &signal), ("theta_m", &signal), ("theta_t", &tip)];
        write_csv(&folder.path().join(&run.file), &columns).unwrap();
    }
    let path = folder.path().join("campaign.toml");
    write_campaign(&path, &plan).unwrap();
    let read = crate::read_campaign(&path).unwrap().campaign;
    assert_eq!(read.channels.command.torque_per_command, Some(0.25));
    assert_eq!(read.runs.len(), 2);
    assert_eq!(read.runs[0].omega_rad_s(), Some(3.0));
    for run in &read.runs {
        assert_eq!(run.motor(), signal);
        assert_eq!(run.tips(), std::slice::from_ref(&tip));
        assert_eq!(run.sample_time_s(), 0.003);
    }
}

proptest! {
    #[test]
    fn every_number_survives(values in proptest::collection::vec(proptest::num::f64::NORMAL, 2..40)) {
        let text = csv_text(&[("x", &values)]).unwrap();
        let column = LogColumn { column: ColumnRef::Number(1), hold: Hold::Measured };
        let log =
            read_log_from(text.as_bytes(), "a.csv", None, &[column], &LogOptions::default()).unwrap();
        prop_assert_eq!(&log.columns[0], &values);
    }
}

/// Every kind of run, read back as the experiment that it is.
#[test]
fn a_written_plan_is_read_as_it_was_made() {
    let run = |motion: PlannedMotion, record_s: f64| Motion {
        motion,
        amplitude_rad: 0.152,
        record_s,
        waited_s: 72.3,
        peak_current_a: 0.51,
        moved_rad: 0.14,
        stuck_share: 0.08,
        paired: false,
        without: Some((PlannedParameter::Arm(ArmParameter::Inertia), 0.02)),
    };
    let turns = |omega_rad_s: f64, periods: f64| periods * std::f64::consts::TAU / omega_rad_s;
    let plan = Plan {
        runs: vec![
            run(PlannedMotion::Sine { omega_rad_s: 55.8 }, turns(55.8, 89.0)),
            run(
                PlannedMotion::Multisine { omega_rad_s: 5.14, to_rad_s: 61.3, phases: 2 },
                turns(5.14, 9.0),
            ),
            run(PlannedMotion::Chirp { from_rad_s: 1.31, to_rad_s: 61.3, sweep_s: 20.0 }, 20.0),
        ],
        expected: vec![Expected {
            parameter: PlannedParameter::Arm(ArmParameter::Coulomb),
            value: 0.03,
            std: 0.001,
            wanted: 0.005,
        }],
        parameters: Vec::new(),
        time_s: 123.0,
        notes: vec![PlanNote::NoPair],
        longest_wait_s: 300.0,
    };
    let text = plan_text(&plan);
    assert!(
        text.starts_with(PLAN_HEAD)
            && text.contains("without it, the standard error of inertia would be 2.0 %")
    );
    let read = PlanFile::from_text(Path::new("plan.toml"), &text).unwrap();
    assert_eq!(read.runs.len(), 3);
    for (made, read) in plan.runs.iter().zip(&read.runs) {
        let asked =
            made.motion.experiment(made.amplitude_rad, made.record_s, plan.longest_wait_s).unwrap();
        assert_eq!(read.experiment.drive, asked.drive);
        assert_eq!(read.experiment.settle, asked.settle);
        assert!((read.experiment.record_s / asked.record_s - 1.0).abs() < 1e-12);
    }
}
