//! Short studies of drives: the drawn campaigns, and the results of easy ones.

use std::fs;
use std::time::Duration;

use lissom_io::read_campaign;
use lissom_study::{
    Cause, DriveCampaign, DriveOutcome, DriveParameter, DriveStudy, DriveStudyPlan, Effects,
    FrictionLine, LineOf, TorqueBound, drive_report, drive_rows, drive_study, write_logs,
};

const SEED: u64 = 1;

fn plan(study: DriveStudy, campaigns: usize) -> DriveStudyPlan {
    DriveStudyPlan { study, campaigns, seed: SEED, quick: true }
}

/// For a drive without effects the least-squares line is the law; inertia, Coulomb and viscous friction are found to
/// 0.1 %.
#[test]
fn a_clean_drive_is_identified() {
    for index in [0, 6] {
        let campaign = DriveCampaign::draw(DriveStudy::Causes, SEED, index).unwrap();
        assert_eq!(campaign.cause(), Some(Cause::Clean));
        let line = FrictionLine::of(&campaign, LineOf::LAW);
        assert!((line.coulomb_nm / campaign.numbers.coulomb_nm - 1.0).abs() < 1e-9);
        let viscous = campaign.numbers.viscous_nm_s_per_rad;
        assert!((line.viscous_nm_s_per_rad / viscous - 1.0).abs() < 1e-9);
        let outcome = DriveOutcome::of(&campaign, Duration::ZERO, true);
        let score = outcome.score.unwrap();
        assert!(!score.warns(), "{:?}", score.findings);
        for p in &score.parameters {
            let error = p.error().unwrap();
            assert!(error.abs() < 1e-3, "{index} {}: {error}", p.parameter);
        }
    }
}

/// Causes take turns, and each campaign has only its own.
#[test]
fn every_cause_has_its_turn() {
    for index in 0..12 {
        let campaign = DriveCampaign::draw(DriveStudy::Causes, SEED, index).unwrap();
        let names = campaign.effects.names();
        match campaign.cause().unwrap() {
            Cause::Clean => assert!(names.is_empty()),
            _ => assert_eq!(names.len(), 1, "{names:?}"),
        }
    }
    let drawn: Vec<Vec<&str>> = (0..24)
        .filter_map(|index| DriveCampaign::draw(DriveStudy::Real, SEED, index))
        .map(|campaign| campaign.effects.names())
        .collect();
    for name in Effects::NAMES.into_iter().filter(|name| *name != "lag") {
        assert!(drawn.iter().any(|names| names.contains(&name)), "{name}");
    }
}

/// More noise and more wander make the bounds larger.
#[test]
fn bounds_grow_with_noise_and_wander() {
    let campaign = (0..20)
        .filter_map(|index| DriveCampaign::draw(DriveStudy::Real, SEED, index))
        .find(|campaign| campaign.effects.wander.is_some())
        .unwrap();
    let bound = |campaign: &DriveCampaign, p| TorqueBound::of(campaign).unwrap().std(p).unwrap();
    let mut steady = campaign.clone();
    steady.effects.wander = None;
    for p in [DriveParameter::Coulomb, DriveParameter::Viscous, DriveParameter::Inertia] {
        assert!(bound(&steady, p) < bound(&campaign, p), "{p}");
    }
    // Without wander the bound is in proportion to the noise.
    let mut noisy = steady.clone();
    if let lissom_study::Input::Measured { noise_share, .. } = &mut noisy.effects.input {
        *noise_share *= 3.0;
    }
    let ratio = bound(&noisy, DriveParameter::Inertia) / bound(&steady, DriveParameter::Inertia);
    assert!((ratio - 3.0).abs() < 1e-6, "{ratio}");
}

/// The files that the command reads hold what was identified in memory.
#[test]
fn written_logs_are_read_back() {
    let late = |c: &DriveCampaign| c.effects.late_stamps.is_some() && c.declares_gravity();
    let campaign = (0..60)
        .filter_map(|index| DriveCampaign::draw(DriveStudy::Real, SEED, index))
        .find(late)
        .unwrap();
    let folder = tempfile::tempdir().unwrap();
    write_logs(&campaign, folder.path()).unwrap();
    let own = folder.path().join(format!("real-{SEED}-{:04}", campaign.index));
    let read = read_campaign(&own.join("campaign.toml")).unwrap().campaign;
    assert_eq!(read.runs.len(), campaign.logs.runs.len());
    assert!(read.gravity);
    for (a, b) in read.runs.iter().zip(&campaign.logs.runs) {
        // The decimals of the stamps in the file limit how exact they are.
        assert!((a.sample_time_s() / b.sample_time_s() - 1.0).abs() < 1e-6);
        assert_eq!(a.len(), b.len());
    }
    let truth = fs::read_to_string(own.join("truth.json")).unwrap();
    assert!(truth.contains("coulomb_nm") && truth.contains("\"bounds\""));
}

/// A page and a row for each campaign, the same with one thread and several.
#[test]
fn pages_and_rows_hold_every_campaign() {
    for study in [DriveStudy::Real, DriveStudy::Causes] {
        let plan = plan(study, 4);
        let outcomes = drive_study(&plan, || {});
        let text = drive_report(&plan, &outcomes);
        assert!(text.contains("## Silently wrong") && !text.contains("NaN"), "{text}");
        let table = drive_rows(&plan, &outcomes);
        assert_eq!(table.lines().count(), 5);
        let columns = |line: &str| line.split(',').count();
        let header = columns(table.lines().next().unwrap());
        assert!(table.lines().all(|line| columns(line) == header), "{table}");
        let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        let alone = one.install(|| drive_study(&plan, || {}));
        let scores = |all: &[Option<DriveOutcome>]| {
            all.iter().flatten().map(|o| format!("{:?}", o.score)).collect::<Vec<_>>()
        };
        assert_eq!(scores(&alone), scores(&outcomes));
    }
}
