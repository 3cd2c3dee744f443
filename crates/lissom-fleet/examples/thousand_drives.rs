//! 1,000 simulated drives with eight logs each, over eight months. The Coulomb friction of ten of them grows by 30 %. Hall
//! temperature changes friction of all drives over the seasons, and warm-up that of each log. Each log is simulated,
//! identified quickly, and the fleet is summarised: which drives are reported as drifting, and which do?
//!
//! `cargo run --release -p lissom-fleet --example thousand_drives -- 14 15 16` with the seeds of the fleets.
#![expect(clippy::print_stdout, reason = "an example shows what it finds")]

use std::time::Instant;

use lissom::prelude::*;
use lissom_fleet::{
    BatchRows, EffortName, ExistingRows, FleetError, FleetLog, FleetRow, FleetRun, FleetSettings,
    RowOutcome, RowResult, SummaryOptions, VERSION, open, summarise,
};
use rand_distr::{Distribution as _, Normal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng as _;
use rayon::prelude::*;

const DRIVES: u64 = 1000;
const DRIFTING: u64 = 10;
const LOGS: u32 = 8;
const DAY_US: f64 = 86_400e6;
const CAMPAIGN: &str = "signals.time = { column = 't', unit = 's' }
signals.current = { column = 'i', unit = 'A', hold = 'sampled' }
signals.motor = { column = 'q', unit = 'rad' }";
const KEY: &str = "friction.coulomb [N·m]";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let seeds: Vec<u64> = std::env::args().skip(1).map(|s| s.parse()).collect::<Result<_, _>>()?;
    let (mut said, mut right, mut truth) = (0, 0, 0);
    for seed in if seeds.is_empty() { vec![1] } else { seeds } {
        let begin = Instant::now();
        let rows: Vec<FleetRow> = (0..DRIVES)
            .into_par_iter()
            .map(|drive| logs_of(seed, drive))
            .collect::<Result<Vec<_>, _>>()?
            .concat();
        let drifts = drifting(&rows)?;
        let found = drifts.iter().filter(|name| is_drifting(name)).count();
        println!(
            "seed {seed}: {} logs, {} drives reported as drifting, {found} of them do, of {DRIFTING}; {:.0} s",
            rows.len(),
            drifts.len(),
            begin.elapsed().as_secs_f64(),
        );
        said += drifts.len();
        right += found;
        truth += DRIFTING as usize;
    }
    println!("precision {:.3}", right as f64 / said as f64);
    println!("recall {:.3}", right as f64 / truth as f64);
    Ok(())
}

fn is_drifting(name: &str) -> bool {
    name.parse::<u64>().is_ok_and(|drive| drive < DRIFTING)
}

/// The rows of a drive.
fn logs_of(seed: u64, drive: u64) -> Result<Vec<FleetRow>, lissom::Error> {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(1_000_000 * seed + drive);
    let mut normal = |std: f64| Normal::new(0.0, std).map_or(0.0, |n| n.sample(&mut random));
    let (coulomb, viscous) = (0.02 * normal(0.1).exp(), 5e-3 * normal(0.1).exp());
    let inertia = 2e-3 * normal(0.02).exp();
    let mut rows = Vec::new();
    for log in 0..LOGS {
        let life = f64::from(log) / f64::from(LOGS - 1);
        let grown = if drive < DRIFTING { 1.0 + 0.3 * life } else { 1.0 };
        let season = 1.0 + 0.08 * (std::f64::consts::TAU * life).sin();
        let warm = normal(0.03).exp();
        let arm = Arm::builder()
            .motor(
                Motor::builder()
                    .inertia_kg_m2(inertia)
                    .viscous_nm_s_per_rad(viscous * season * warm * warm)
                    .torque_constant_nm_per_a(0.2),
            )
            .coulomb_nm(coulomb * grown * season * warm)
            .build()?;
        let rig = Rig::builder(arm)
            .sample_time_s(2e-3)
            .encoder_counts(1 << 16)
            .noise_rad(5e-5)
            .current_limit_a(5.0)
            .controller(Pd::new(4.0, 0.15)?) // A/rad, A·s/rad
            .build()?;
        let sine = Experiment::sine(6.0, 0.6, 6.0); // rad/s, rad, s
        let logs = rig.campaign_from_seed(1000 * drive + u64::from(log), [sine])?;
        let found = Identify::new(&logs).effort(Effort::Quick).run()?;
        let result = RowResult::of(&found, EffortName::Quick, false);
        let day = 30.0 * f64::from(log) + normal(3.0);
        rows.push(FleetRow {
            log: format!("{drive}/{log}"),
            machine: Some(drive.to_string()),
            time_us: Some((day * DAY_US) as i64),
            input_sha256: None,
            seconds: 0.0,
            version: VERSION.to_owned(),
            outcome: RowOutcome::Identified(Box::new(result)),
        });
    }
    Ok(rows)
}

/// Names of the drives whose Coulomb friction is reported to grow or fall.
fn drifting(rows: &[FleetRow]) -> Result<Vec<String>, FleetError> {
    let folder = std::env::temp_dir().join(format!("lissom-fleet-{}", std::process::id()));
    let logs = rows.iter().map(|row| FleetLog::new(row.log.clone())).collect();
    let mut run = FleetRun::begin(
        &folder,
        FleetSettings::new("campaign", CAMPAIGN),
        logs,
        &ExistingRows::Keep,
    )?;
    let mut left = rows.iter().cloned();
    while let Some(batch) = run.next_batch(1) {
        let rows = left.by_ref().take(batch.logs.len()).collect();
        run.take(&BatchRows { number: batch.number, rows, seconds: 0.0 })?;
    }
    run.end()?;
    let summary = summarise(&open(&folder)?, SummaryOptions::default());
    std::fs::remove_dir_all(&folder).map_err(|source| FleetError::Read { path: folder, source })?;
    let parameters = summary?.parameters;
    let drifts = parameters.into_iter().filter(|p| p.key == KEY).flat_map(|p| p.drifts);
    Ok(drifts.map(|drift| drift.machine).collect())
}
