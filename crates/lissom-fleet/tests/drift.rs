//! Which drift is found in rows with known truth: scatter of logs, seasons, machines that scatter more than others, and logs
//! that are far off.
#![expect(clippy::unwrap_used, clippy::print_stdout, reason = "a test fails by panicking")]

use std::collections::HashSet;

use lissom_fleet::{
    BatchRows, EffortName, ExistingRows, FleetLog, FleetRow, FleetRun, FleetSettings, FleetSummary,
    RowEstimate, RowOutcome, RowResult, SummaryOptions, VERSION, open, summarise,
};
use rand_distr::{Distribution as _, Normal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::{Rng as _, SeedableRng as _};

const MACHINES: usize = 1000;
const LOGS: u32 = 8;
const DRIFTING: usize = 10;
const KEY: &str = "friction.coulomb [N·m]";
const DAY_US: i64 = 86_400_000_000;
const CAMPAIGN: &str = "signals.time = { column = 't', unit = 's' }
signals.current = { column = 'i', unit = 'A', hold = 'measured' }
signals.motor = { column = 'q', unit = 'rad' }";

/// What the logs of a fleet have beside the scatter of 3 %.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Scatter,
    /// A season of ±10 %, the same for all machines.
    Season,
    /// Machines whose logs scatter by 1 to 9 %.
    Unequal,
    /// One log of a hundred is off by a factor of 0.5 to 2.
    Wild,
}

struct Draw(Xoshiro256PlusPlus);

impl Draw {
    fn uniform(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    fn normal(&mut self, std: f64) -> f64 {
        Normal::new(0.0, std).unwrap().sample(&mut self.0)
    }
}

/// The summary of a fleet of which the first machines drift by 30 %, and the names of these.
fn summary(kind: Kind, drifting: usize, seed: u64) -> (FleetSummary, HashSet<String>) {
    let mut draw = Draw(Xoshiro256PlusPlus::seed_from_u64(seed));
    let mut rows = Vec::new();
    for machine in 0..MACHINES {
        let level = 0.2 * draw.normal(0.1).exp();
        let scatter = if kind == Kind::Unequal { 0.01 * (9f64).powf(draw.uniform()) } else { 0.03 };
        for log in 0..LOGS {
            let life = f64::from(log) / f64::from(LOGS - 1);
            let grown = if machine < drifting { 1.0 + 0.3 * life } else { 1.0 };
            let phase = std::f64::consts::TAU * life;
            let season = if kind == Kind::Season { 1.0 + 0.1 * phase.sin() } else { 1.0 };
            let is_wild = kind == Kind::Wild && draw.uniform() < 0.01;
            let wild = if is_wild { 2f64.powf(2.0 * draw.uniform() - 1.0) } else { 1.0 };
            let std = 0.002 * level * (1.0 + draw.uniform());
            let value =
                level * grown * season * wild * draw.normal(scatter).exp() + draw.normal(std);
            let day = 30 * i64::from(log) + (10.0 * draw.uniform()) as i64;
            rows.push(row(&format!("m{machine}/{log}"), machine, day * DAY_US, (value, std)));
        }
    }
    let folder = tempfile::tempdir().unwrap();
    let logs = rows.iter().map(|row: &FleetRow| FleetLog::new(row.log.clone())).collect();
    let settings = FleetSettings::new("campaign.toml", CAMPAIGN);
    let mut run = FleetRun::begin(folder.path(), settings, logs, &ExistingRows::Keep).unwrap();
    let mut rows = rows.into_iter();
    while let Some(batch) = run.next_batch(1) {
        let rows = rows.by_ref().take(batch.logs.len()).collect();
        run.take(&BatchRows { number: batch.number, rows, seconds: 0.0 }).unwrap();
    }
    run.end().unwrap();
    let found = summarise(&open(folder.path()).unwrap(), SummaryOptions::default()).unwrap();
    (found, (0..drifting).map(|machine| format!("m{machine}")).collect())
}

fn row(log: &str, machine: usize, time_us: i64, value_std: (f64, f64)) -> FleetRow {
    let estimate = RowEstimate { key: KEY.to_owned(), value_std: Some(value_std) };
    FleetRow {
        log: log.to_owned(),
        machine: Some(format!("m{machine}")),
        time_us: Some(time_us),
        input_sha256: None,
        seconds: 0.01,
        version: VERSION.to_owned(),
        outcome: RowOutcome::Identified(Box::new(RowResult {
            effort: EffortName::Quick,
            estimates: vec![estimate],
            refusals: Vec::new(),
            warnings: Vec::new(),
            infos: Vec::new(),
            json: None,
        })),
    }
}

/// Of the machines that are said to drift, and of those that do, how many are right and found; over several seeds.
fn counts(kind: Kind, drifting: usize, seeds: std::ops::Range<u64>) -> (usize, usize, usize) {
    let (mut said, mut right, mut truth) = (0, 0, 0);
    for seed in seeds {
        let (found, wanted) = summary(kind, drifting, seed);
        let drifts = &found.parameters[0].drifts;
        said += drifts.len();
        right += drifts.iter().filter(|drift| wanted.contains(&drift.machine)).count();
        truth += wanted.len();
    }
    (said, right, truth)
}

#[test]
fn drift_of_one_machine_in_a_hundred_is_found() {
    for kind in [Kind::Scatter, Kind::Season, Kind::Wild] {
        let (said, right, truth) = counts(kind, DRIFTING, 101..104);
        assert!(right as f64 >= 0.9 * said as f64, "precision {right} of {said}");
        assert!(right as f64 >= 0.9 * truth as f64, "recall {right} of {truth}");
    }
}

#[test]
fn machines_that_scatter_more_are_not_said_to_drift() {
    let (said, right, _) = counts(Kind::Unequal, DRIFTING, 101..104);
    assert!(right as f64 >= 0.85 * said as f64, "precision {right} of {said}");
    let (said, ..) = counts(Kind::Unequal, 0, 101..104);
    assert!(said <= 3, "{said} of 3000 machines without drift");
}

#[test]
fn logs_that_are_far_off_are_found() {
    let (found, _) = summary(Kind::Wild, 0, 101);
    let logs = &found.parameters[0].outlying_logs;
    assert!((20..=80).contains(&logs.len()), "{} of about 80", logs.len());
    assert!(logs.iter().all(|log| (log.value / log.expected).ln().abs() > 0.07));
    let (found, _) = summary(Kind::Scatter, 0, 101);
    assert!(found.parameters[0].outlying_logs.len() <= 3);
    assert!(found.parameters[0].outlying_machines.len() <= 3);
}

#[test]
#[ignore = "prints a table over tuning seeds"]
fn table_over_seeds() {
    for (name, kind) in [
        ("scatter", Kind::Scatter),
        ("season", Kind::Season),
        ("unequal", Kind::Unequal),
        ("wild", Kind::Wild),
    ] {
        for drifting in [0, DRIFTING] {
            let (said, right, truth) = counts(kind, drifting, 1..11);
            println!("{name} {drifting}: said {said}, right {right}, truth {truth}");
        }
    }
}
