//! The campaign of the demo: sines at frequencies ω0 and 3·ω0, with two amplitudes.

use std::path::Path;

use lissom::record::{Hold, TipQuantity};
use lissom::rig::{Experiment, Rig, RigError, Settle};
use lissom_io::write::{self, CampaignPlan, PlannedCommand, PlannedRun};

use crate::shared::failure::Failure;
use crate::shared::progress_bar;

/// Frequencies ω0 \[rad/s\]; each has another run at 3·ω0. None is close to the beam's resonance at 6.6 rad/s or to a
/// third of it, where the mode rings for a long time (its decay time is 33 s).
const OMEGA_RAD_S: [f64; 9] = [1.0, 1.3, 1.7, 3.1, 3.9, 5.1, 7.8, 9.3, 10.0];
/// Amplitudes \[rad\].
const AMPLITUDE_RAD: [f64; 2] = [0.5, 1.0];
/// Time for which the loop runs before the log begins: nine decay times of the beam \[s\].
const SETTLE_S: f64 = 300.0;
/// Logged periods of a run.
const PERIODS: f64 = 12.0;
/// Shortest logged time of a run \[s\].
const LEAST_S: f64 = 12.0;
/// Seed of the sensor noise. The sensors of the demo have no noise, so any number will do.
const SEED: u64 = 0;

/// Runs the campaign and writes its logs and `campaign.toml` into `out`.
pub(crate) fn write_logs(rig: &Rig, out: &Path) -> Result<(), Failure> {
    let drives = drives()?;
    let bar = progress_bar::bar(drives.len(), "virtual experiment");
    let mut runs = Vec::with_capacity(drives.len());
    for (index, (omega_rad_s, experiment)) in drives.iter().enumerate() {
        let file = format!("run-{:02}.csv", index + 1);
        let run = rig.run(&file, experiment, SEED)?.run;
        let time: Vec<f64> = (0..run.len()).map(|k| k as f64 * run.sample_time_s()).collect();
        let columns: [(&str, &[f64]); 4] = [
            ("t", &time),
            ("i", run.command()),
            ("theta_m", run.motor()),
            ("theta_t", &run.tips()[0]),
        ];
        write::write_csv(&out.join(&file), &columns)?;
        runs.push(PlannedRun { file, omega_rad_s: Some(*omega_rad_s) });
        bar.inc(1);
    }
    bar.finish_and_clear();
    let plan = CampaignPlan {
        title: "Sines at frequencies w0 and 3*w0, simulated.".to_owned(),
        time_column: "t".to_owned(),
        command: PlannedCommand { column: "i".to_owned(), hold: Hold::Sampled },
        motor_column: "theta_m".to_owned(),
        tips: vec![("tip".to_owned(), "theta_t".to_owned(), TipQuantity::Angle)],
        torque_constant_nm_per_a: Some(rig.arm.motor.torque_constant_nm_per_a()),
        current_limit_a: rig.instruments.amplifier.limit_a(),
        gravity: false,
        arm: None,
        runs,
    };
    write::write_campaign(&out.join("campaign.toml"), &plan)?;
    Ok(())
}

fn drives() -> Result<Vec<(f64, Experiment)>, RigError> {
    let mut omega: Vec<f64> =
        OMEGA_RAD_S.iter().copied().chain(OMEGA_RAD_S.iter().map(|w| 3.0 * w)).collect();
    omega.sort_by(f64::total_cmp);
    omega.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
    AMPLITUDE_RAD
        .iter()
        .flat_map(|&amplitude_rad| {
            omega.iter().map(move |&omega_rad_s| {
                let record_s = (PERIODS * std::f64::consts::TAU / omega_rad_s).max(LEAST_S);
                let sine = Experiment::sine(omega_rad_s, amplitude_rad, record_s)?;
                Ok((omega_rad_s, sine.settling(Settle::Wait { wait_s: SETTLE_S })))
            })
        })
        .collect()
}
