//! Writes the logs of a drive to files, to use the command on them.

use std::path::Path;

use lissom_io::write::{
    CampaignPlan, PlannedCommand, PlannedRun, create_folder, write_campaign, write_csv, write_json,
};
use serde_json::json;

use super::drive_campaign::DriveCampaign;
use super::friction_line::{FrictionLine, LineOf};
use super::torque_bound::TorqueBound;
use crate::drives::DriveParameter;

/// The reason why logs cannot be written.
pub type LogsError = Box<dyn std::error::Error + Send + Sync>;

/// Writes `STUDY-SEED-INDEX/` into `folder`: a log for each run, `campaign.toml` and `truth.json`.
///
/// # Errors
/// If the folder cannot be written.
pub fn write_logs(campaign: &DriveCampaign, folder: &Path) -> Result<(), LogsError> {
    let DriveCampaign { study, seed, index, .. } = campaign;
    let own = folder.join(format!("{study}-{seed}-{index:04}"));
    create_folder(&own)?;
    let mut runs = Vec::new();
    for (k, (stamps, run)) in campaign.raw.iter().enumerate() {
        let file = format!("run-{}.csv", k + 1);
        let columns: [(&str, &[f64]); 3] =
            [("time_s", stamps), ("current_a", run.command()), ("motor_rad", run.motor())];
        write_csv(&own.join(&file), &columns)?;
        runs.push(PlannedRun { file, omega_rad_s: None });
    }
    let command = &campaign.logs.channels.command;
    let plan = CampaignPlan {
        title: format!("Simulated drive {index} of seed {seed}, study `{study}`"),
        time_column: "time_s".to_owned(),
        command: PlannedCommand { column: "current_a".to_owned(), hold: command.hold },
        motor_column: "motor_rad".to_owned(),
        tips: vec![],
        torque_constant_nm_per_a: command.torque_per_command,
        current_limit_a: None,
        gravity: campaign.declares_gravity(),
        arm: None,
        runs,
    };
    write_campaign(&own.join("campaign.toml"), &plan)?;
    let line = FrictionLine::of(campaign, LineOf::LAW);
    let fell = FrictionLine::of(campaign, LineOf { wander: true, ..LineOf::LAW });
    let bound = TorqueBound::of(campaign);
    let bounds: serde_json::Map<String, serde_json::Value> = DriveParameter::ALL
        .into_iter()
        .filter_map(|p| Some((p.to_string(), json!(bound.as_ref()?.std(p)?))))
        .collect();
    let truth = json!({
        "seed": seed,
        "index": index,
        "cause": campaign.cause(),
        "effects": campaign.effects,
        "drive": campaign.numbers,
        "motion": campaign.motion,
        "line": {
            "coulomb_nm": line.coulomb_nm,
            "viscous_nm_s_per_rad": line.viscous_nm_s_per_rad,
        },
        "line_with_wander": {
            "coulomb_nm": fell.coulomb_nm,
            "viscous_nm_s_per_rad": fell.viscous_nm_s_per_rad,
        },
        "bounds": bounds,
    });
    write_json(&own.join("truth.json"), &truth)?;
    Ok(())
}
