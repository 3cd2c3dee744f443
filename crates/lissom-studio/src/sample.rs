//! Logs to try the application with: a light arm on a motor with friction, simulated.

use std::path::Path;

use lissom::prelude::*;
use lissom_io::write::{Batch, csv_text};

use crate::problem::Problem;
use crate::setup::{Pick, Setup};

/// Frequency and amplitude of each run \[rad/s, rad\].
const SINES: [(f64, f64); 4] = [(1.0, 0.5), (3.0, 0.5), (2.0, 0.5), (6.0, 0.3)];
const RECORD_S: f64 = 20.0;
const SAMPLE_TIME_S: f64 = 3e-3;
const ENCODER_BITS: u32 = 14;

/// Writes the logs into a folder, all or none, and returns their names.
pub(crate) fn write(folder: &Path) -> Result<Vec<String>, Problem> {
    let campaign = simulated().map_err(Problem::internal)?;
    let mut batch = Batch::new();
    let mut names = Vec::new();
    for (k, run) in campaign.runs.iter().enumerate() {
        let name = format!("sample-{}.csv", k + 1);
        let time: Vec<f64> = (0..run.len()).map(|k| k as f64 * run.sample_time_s()).collect();
        let columns: [(&str, &[f64]); 4] = [
            ("time [s]", &time),
            ("current [A]", run.command()),
            ("motor [rad]", run.motor()),
            ("tip [rad]", &run.tips()[0]),
        ];
        let text = csv_text(&columns).map_err(lissom_io::Error::from)?;
        batch.file(&folder.join(&name), text.as_bytes()).map_err(lissom_io::Error::from)?;
        names.push(name);
    }
    batch.commit().map_err(lissom_io::Error::from)?;
    Ok(names)
}

fn simulated() -> Result<Campaign, lissom::Error> {
    let arm = Arm::builder()
        .span(Span::new(0.25, 0.02).mass_kg(0.05))
        .motor(
            Motor::builder()
                .inertia_kg_m2(2e-3)
                .viscous_nm_s_per_rad(1e-3)
                .torque_constant_nm_per_a(0.2),
        )
        .coulomb_nm(0.02)
        .build()?;
    let rig = Rig::builder(arm)
        .sample_time_s(SAMPLE_TIME_S)
        .encoder_bits(ENCODER_BITS)
        .controller(Pd::new(8.0, 0.25)?)
        .build()?;
    let sines = SINES.map(|(omega, amplitude)| Experiment::sine(omega, amplitude, RECORD_S));
    let logs = rig.campaign(sines)?;
    let campaign: &Campaign = logs.as_ref();
    Ok(campaign.clone())
}

/// What is said about them, in addition to what they state.
pub(crate) fn setup() -> Setup {
    let (column, unit) = ("tip [rad]".to_owned(), "rad".to_owned());
    Setup {
        tips: vec![Pick { column, unit, ..Pick::default() }],
        hold: "sampled".to_owned(),
        torque_constant: "0.2 N*m/A".to_owned(),
        ..Setup::default()
    }
}
