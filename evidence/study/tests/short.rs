//! A short study: results that must hold, with margins that are larger than chance.
//!
//! The limits are five to ten times the errors of these campaigns; a broken estimator is off by
//! more. `cargo xtask study` makes the full tables.
#![expect(clippy::unwrap_used, reason = "tests")]

use std::convert::Infallible;
use std::fs;
use std::sync::OnceLock;

use lissom::drive::Coulomb;
use lissom::identify::{Options, identify};
use lissom::record::Campaign;
use lissom::rig::{Sensor, Settle};
use lissom_study::{
    EstimateScore, Kept, Kind, Law, Score, Scored, ScoredParameter, Study, Truth, draw_campaign,
    median, report, rows, score, study,
};

/// Campaigns identified, and those that are only drawn.
const CAMPAIGNS: usize = 6;
const DRAWN: usize = 12;
const SEED: u64 = 1;

fn made(plan: &Study) -> Vec<Option<Scored>> {
    study(plan, |_| None, |_, _| Ok::<(), Infallible>(())).unwrap()
}

fn short() -> &'static [Scored] {
    static DONE: OnceLock<Vec<Scored>> = OnceLock::new();
    DONE.get_or_init(|| {
        let plan = Study { campaigns: CAMPAIGNS, seed: SEED, law: Law::None, quick: false };
        made(&plan).into_iter().map(Option::unwrap).collect()
    })
}

fn scores() -> Vec<&'static Score> {
    short().iter().map(|s| s.score.as_ref().unwrap()).collect()
}

/// Relative errors of a parameter, of the campaigns that give an estimate.
fn errors(parameter: ScoredParameter) -> Vec<f64> {
    let error = |s: &&Score| s.of(parameter).and_then(EstimateScore::error).map(f64::abs);
    scores().iter().filter_map(error).collect()
}

#[track_caller]
fn holds(parameter: ScoredParameter, median_most: f64, most: f64) {
    let errors = errors(parameter);
    assert_eq!(errors.len(), CAMPAIGNS, "{parameter}");
    assert!(median(&errors).unwrap() <= median_most, "{parameter}: {errors:?}");
    assert!(errors.iter().all(|e| *e <= most), "{parameter}: {errors:?}");
}

#[test]
fn estimates_are_as_close_as_they_were() {
    holds(ScoredParameter::Coulomb, 1e-5, 5e-5);
    holds(ScoredParameter::Inertia, 5e-5, 2e-4);
    holds(ScoredParameter::Viscous, 1e-4, 4e-4);
    holds(ScoredParameter::Coupling, 1e-4, 1e-3);
    holds(ScoredParameter::Frequency(0), 1e-5, 5e-5);
}

/// Of about thirty estimates two are expected more than two standard errors off.
#[test]
fn standard_errors_are_those_of_the_errors() {
    let each = || {
        scores().into_iter().flat_map(|s| &s.estimates).filter_map(EstimateScore::standard_errors)
    };
    let beyond = |z: f64| each().filter(|d| d.abs() > z).count();
    assert!(each().count() > 30);
    assert!(beyond(2.0) <= 5, "{}", beyond(2.0));
    assert_eq!(beyond(4.0), 0);
}

#[test]
fn corrected_responses_are_as_close_as_they_were() {
    let points = scores().into_iter().flat_map(|s| &s.points);
    let sines: Vec<_> = points.filter(|p| p.sinusoidal && p.vouched).collect();
    let corrected: Vec<f64> = sines.iter().filter_map(|p| p.corrected).collect();
    let raw: Vec<f64> = sines.iter().map(|p| p.raw).collect();
    assert!(corrected.len() >= 20);
    assert!(median(&corrected).unwrap() < 2e-4 && median(&raw).unwrap() > 0.3);
    assert!(corrected.iter().all(|e| *e < 0.01), "{corrected:?}");
    assert!(sines.iter().all(|p| p.nearer(1.0) != Some(false)), "{sines:?}");
}

/// Circles of 95 % that contain the truth less often are too small; those of bands are known to be too large.
#[test]
fn circles_of_vouched_responses_hold() {
    let points: Vec<_> =
        scores().into_iter().flat_map(|s| &s.points).filter(|p| p.vouched).collect();
    for sinusoidal in [true, false] {
        let of = points.iter().filter(|p| p.sinusoidal == sinusoidal);
        let held: Vec<bool> = of.filter_map(|p| p.covers()).collect();
        let share = held.iter().filter(|h| **h).count() as f64 / held.len() as f64;
        assert!(share > 0.85, "{share} of {}", held.len());
    }
    assert!(!points.iter().any(|p| p.silently_wrong()));
}

/// Another law of friction is reported, and inertia, coupling and frequencies stay correct. An encoder of ten bits
/// almost hides the ripple of campaign 16, and this ripple drives motions apart as that of campaign 19 does.
#[test]
fn wrong_laws_are_reported_and_spare_the_linear_part() {
    let stribeck = [(Law::Stribeck, 7)];
    let ripple = [16, 19].map(|index| (Law::Ripple, index));
    for (law, index) in stribeck.into_iter().chain(ripple).chain([(Law::Direction, 18)]) {
        let campaign = draw_campaign(3, index, law).unwrap();
        let id = identify(&campaign.logs, &Options::default(), |_| {}).unwrap();
        let scored = score(&Truth::of(&campaign), &id);
        assert!(!scored.law_alarms().is_empty(), "{law} {index}");
        let linear = |f: &&EstimateScore| {
            matches!(
                f.parameter,
                ScoredParameter::Inertia
                    | ScoredParameter::Coupling
                    | ScoredParameter::Frequency(_)
            )
        };
        for f in scored.estimates.iter().filter(linear) {
            let error = f.error().map_or(f64::INFINITY, f64::abs);
            assert!(error < 5e-3, "{law} {index}: {} off by {error:.1e}", f.parameter);
            let standard_errors = f.standard_errors().map_or(f64::INFINITY, f64::abs);
            assert!(
                standard_errors < 5.0,
                "{law} {index}: {} off by {standard_errors:.1}",
                f.parameter
            );
        }
    }
}

/// An encoder of 11 bits almost hides the Stribeck friction of campaign 12. It gives a mode a wrong frequency, and a
/// warning affects every wrong estimate.
#[test]
fn a_law_that_the_noise_hides_is_not_silently_wrong() {
    let campaign = draw_campaign(3, 12, Law::Stribeck).unwrap();
    let id = identify(&campaign.logs, &Options::default(), |_| {}).unwrap();
    let scored = score(&Truth::of(&campaign), &id);
    assert!(!scored.law_alarms().is_empty());
    let wrong: Vec<_> = scored.estimates.iter().filter(|f| f.silently_wrong()).collect();
    assert!(wrong.is_empty(), "{wrong:?}");
}

/// Loops without friction and with ideal sensors have the response that points are compared with.
#[test]
fn the_true_response_is_that_of_a_loop_without_friction() {
    let sines = |index: &usize| {
        let campaign = draw_campaign(SEED, *index, Law::None).unwrap();
        (campaign.stratum.kind == Kind::Sines).then_some(campaign)
    };
    let campaign = (0..CAMPAIGNS).find_map(|index| sines(&index)).unwrap();
    let truth = Truth::of(&campaign);
    let mut rig = campaign.definition.rig.clone();
    rig.arm.coulomb = Coulomb::symmetric(0.0).unwrap();
    rig.instruments.motor = Sensor::IDEAL;
    rig.instruments.tips = Vec::new();
    // Without friction a lightly damped beam rings longer than the campaign waits.
    let settle = Settle::Detected { tolerance: 1e-6, longest_s: 3000.0 };
    let runs = campaign.definition.runs.iter().map(|run| {
        let experiment = run.experiment.clone().settling(settle);
        rig.run(&run.name, &experiment, 0).unwrap().run
    });
    let logs = Campaign::new(campaign.logs.channels.clone(), runs.collect()).unwrap();
    let id = identify(&logs, &Options::default(), |_| {}).unwrap();
    let scored = score(&truth, &id);
    assert!(scored.points.len() >= 4);
    for p in &scored.points {
        assert!(p.raw < 1e-3, "{p:?}");
    }
}

/// The generator stays within its ranges and makes all kinds of runs.
#[test]
fn campaigns_are_within_the_ranges() {
    for scored in short() {
        assert!((0.05..=0.60).contains(&scored.coulomb_share));
        assert!(scored.stuck_share <= 0.15);
        assert!((3..=10).contains(&scored.runs.len()));
        assert!((1e-3..=4e-3).contains(&scored.stratum.sample_time_s));
    }
    let drawn: Vec<_> = (0..DRAWN).filter_map(|i| draw_campaign(SEED, i, Law::None)).collect();
    for kind in Kind::ALL {
        assert!(drawn.iter().any(|c| c.stratum.kind == kind), "{kind}");
    }
    for masses in 1..=3 {
        assert!(drawn.iter().any(|c| c.stratum.masses == masses), "{masses}");
    }
}

#[test]
fn threads_change_nothing() {
    let plan = Study { campaigns: 3, seed: SEED, law: Law::None, quick: false };
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let alone = one.install(|| made(&plan));
    for (alone, together) in alone.iter().flatten().zip(short()) {
        // Debug text shows every bit, NaN as well.
        assert_eq!(format!("{:?}", alone.score), format!("{:?}", together.score));
    }
}

/// A study that was stopped in the middle of a campaign continues after the complete ones.
#[test]
fn a_stopped_study_keeps_its_campaigns() {
    let plan = Study { campaigns: 3, seed: SEED, law: Law::None, quick: false };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("accuracy.cbor");
    let kept = Kept::create(&path).unwrap();
    kept.keep(&plan, 0, Some(&short()[0])).unwrap();
    kept.keep(&plan, 1, None).unwrap();
    kept.keep(&plan, 2, Some(&short()[2])).unwrap();
    let whole = fs::read(&path).unwrap();
    fs::write(&path, &whole[..whole.len() - 100]).unwrap();

    let resumed = Kept::resume(&path).unwrap();
    let first = resumed.known(&plan, 0).unwrap().unwrap();
    assert_eq!(format!("{first:?}"), format!("{:?}", short()[0]));
    assert!(resumed.known(&plan, 1).unwrap().is_none());
    assert!(resumed.known(&plan, 2).is_none());
    assert!(resumed.known(&Study { quick: true, ..plan }, 0).is_none());
    resumed.keep(&plan, 2, Some(&short()[2])).unwrap();
    assert_eq!(fs::read(&path).unwrap(), whole);

    let garbage = folder.path().join("garbage.cbor");
    fs::write(&garbage, "index,law\n").unwrap();
    let error = Kept::resume(&garbage).unwrap_err().to_string();
    assert!(error.contains("byte 0") && error.contains("--resume"), "{error}");
}

#[test]
fn another_law_is_another_truth_of_the_same_stratum() {
    let of = |law: Law| draw_campaign(SEED, 0, law).unwrap();
    let (coulomb, stribeck) = (of(Law::None), of(Law::Stribeck));
    assert!(coulomb.definition.rig.scene.tolerance().is_none());
    assert!(stribeck.definition.rig.scene.tolerance().is_some());
    let direction = of(Law::Direction).definition.rig.arm.coulomb;
    assert!(direction.forward() > direction.backward());
}

#[test]
fn tables_and_rows_hold_every_campaign() {
    let plan = Study { campaigns: CAMPAIGNS, seed: SEED, law: Law::None, quick: false };
    let studies = vec![(plan, short().iter().cloned().map(Some).collect())];
    let text = report(&studies);
    for section in [
        "## Goals",
        "## Parameters",
        "## Statistical limit",
        "## Frequency response",
        "## By campaign",
        "## Worst campaigns",
        "## Draws",
    ] {
        assert!(text.contains(section), "{section}");
    }
    for row in [
        "| campaigns with a silently wrong parameter: at most 1 of 1000 |",
        "| campaigns with a silently wrong vouched-for point of the response: at most 1 of 1000 |",
        "| points | vouched for | 95 % circles that contain the truth |",
        "| sinusoidal points | with (30) | nearer than (30) | ten times nearer |",
    ] {
        assert!(text.contains(row), "{row}");
    }
    assert!(!text.contains("NaN"), "{text}");
    let table = rows(&studies);
    assert_eq!(table.lines().count(), 1 + CAMPAIGNS);
    let columns = |line: &str| line.split(',').count();
    let header = columns(table.lines().next().unwrap());
    assert!(table.lines().all(|line| columns(line) == header));
}

/// There is no goal for the number of silently wrong campaigns of a wrong law.
#[test]
fn pages_of_wrong_laws_count_the_silently_wrong() {
    let of = |law| {
        let plan = Study { campaigns: CAMPAIGNS, seed: SEED, law, quick: false };
        (plan, short().iter().cloned().map(Some).collect())
    };
    let text = report(&[of(Law::None), of(Law::Stribeck)]);
    for law in [Law::None, Law::Stribeck] {
        let row =
            format!("| {law}: campaigns with a silently wrong parameter | 0.0 % (0.0-39.0) | – |");
        assert!(text.contains(&row), "{text}");
    }
}
