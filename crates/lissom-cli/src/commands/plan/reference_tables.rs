//! A plan for real hardware: a table of reference angles for each run, and a campaign.toml for the logs.

use std::path::Path;

use lissom::plan::{Plan, PlannedMotion, reference_table};
use lissom::rig::Rig;
use lissom_io::write::{self, CampaignPlan, PlannedRun};

use crate::shared::failure::Failure;
use crate::shared::output_guard;
use crate::tasks::rig_campaign::described;
use crate::views::printer;

/// First line of a table of reference angles.
const TABLE_HEAD: &str = "t,theta_ref,log";

/// Writes a table of reference angles for each run, and a campaign.toml for the logs unless there is one.
pub(crate) fn write(folder: &Path, rig: &Rig, made: &Plan) -> Result<(), Failure> {
    write::create_folder(folder)?;
    // Tables of an earlier plan with more runs could be mistaken for tables of this plan.
    for left in (made.runs.len()..).map(|index| folder.join(table_name(index))) {
        if !left.is_file() || output_guard::guard_headed(&left, TABLE_HEAD).is_err() {
            break;
        }
        write::remove(&left)?;
    }
    for (index, run) in made.runs.iter().enumerate() {
        let table = reference_table(run, rig.instruments.control_time_s())?;
        let columns: [(&str, &[f64]); 3] =
            [("t", &table.time_s), ("theta_ref", &table.reference_rad), ("log", &table.log)];
        write::write_csv(&folder.join(table_name(index)), &columns)?;
    }
    let place = folder.join("campaign.toml");
    if place.exists() {
        // The user may have changed its columns and units.
        printer::note(&format!(
            "{} exists and is left as it is; planned runs: {}",
            place.display(),
            made.runs.len()
        ));
        return Ok(());
    }
    write::write_campaign(&place, &campaign(rig, made))?;
    Ok(())
}

fn campaign(rig: &Rig, made: &Plan) -> CampaignPlan {
    let title = format!(
        "For the logs of a plan. log-01.csv is the log of the drive while the column `log` of {} is 1, and so on.\n\
         Replace columns, units and hold by those of your drive (see the page campaign.toml in the book).",
        table_name(0)
    );
    let run = |(index, run): (usize, &lissom::plan::PlannedRun)| PlannedRun {
        file: format!("log-{:02}.csv", index + 1),
        omega_rad_s: match run.motion {
            PlannedMotion::Sine { omega_rad_s } => Some(omega_rad_s),
            PlannedMotion::Multisine { .. } | PlannedMotion::Chirp { .. } => None,
        },
    };
    described(rig, title, None, made.runs.iter().enumerate().map(run).collect())
}

fn table_name(index: usize) -> String {
    format!("run-{:02}.csv", index + 1)
}
