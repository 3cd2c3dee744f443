//! Simulation of a campaign, or of the rest of an interrupted one.

use std::path::Path;

use lissom::rig::{Logged, Rig};
use lissom_io::write::{self, CampaignPlan, PlannedRun};
use lissom_io::{ConfigError, PlanFile, PlanRun, RigFile, RigRunEntry};
use rayon::prelude::*;

use super::campaign_folder::Folder;
use crate::shared::failure::Failure;
use crate::shared::progress_bar;
use crate::tasks::rig_campaign::{described, tip_column};
use crate::views::printer;

pub(crate) const CAMPAIGN: &str = "campaign.toml";

/// The texts of the input files, as they were when the campaign began.
pub(crate) struct Inputs {
    /// Text of the arm.toml.
    pub(crate) arm: String,
    /// Text of the plan.toml.
    pub(crate) plan: String,
}

impl Inputs {
    pub(crate) fn read(arm: &Path, plan: &Path) -> Result<Self, Failure> {
        let text = |path: &Path| {
            lissom_io::read_text(path)
                .map_err(|source| lissom_io::Error::from(ConfigError::unread(path, source)))
        };
        Ok(Self { arm: text(arm)?, plan: text(plan)? })
    }
}

/// Simulates a campaign, or the rest of an interrupted one; gives the content of `rig.json`.
pub(crate) fn campaign(
    rig: &Rig,
    plan: &PlanFile,
    inputs: &Inputs,
    out: &Path,
    jobs: Option<u16>,
) -> Result<RigFile, Failure> {
    let folder = Folder::open(out, rig, plan)?;
    let whole = RigFile::of(rig, plan, carry_out(rig, plan, &folder, jobs)?);
    write::write_text(&folder.path("arm.toml"), &inputs.arm)?;
    write::write_text(&folder.path("plan.toml"), &inputs.plan)?;
    write::write_campaign(&folder.path(CAMPAIGN), &campaign_plan(rig, plan))?;
    folder.finish(&whole)?;
    Ok(whole)
}

/// Simulates every missing log; gives the entries of all runs, in order.
fn carry_out(
    rig: &Rig,
    plan: &PlanFile,
    folder: &Folder,
    jobs: Option<u16>,
) -> Result<Vec<RigRunEntry>, Failure> {
    let done: Vec<Option<RigRunEntry>> =
        plan.runs.iter().map(|run| folder.done(&run.name)).collect();
    let there = done.iter().flatten().count();
    if there > 0 {
        printer::note(&format!("{there} of {} logs exist already", plan.runs.len()));
    }
    let bar = progress_bar::bar(plan.runs.len(), "virtual campaign");
    bar.enable_steady_tick(std::time::Duration::from_millis(250));
    let one = |(run, done): (&PlanRun, Option<RigRunEntry>)| -> Result<RigRunEntry, Failure> {
        let entry = match done {
            Some(entry) => entry,
            None => simulate(rig, run, folder)?,
        };
        bar.inc(1);
        Ok(entry)
    };
    let all = || plan.runs.par_iter().zip(done.clone()).map(one).collect::<Vec<_>>();
    let threads = jobs.map_or(0, usize::from);
    // If no thread pool can be built, this thread does the work alone.
    let made = match rayon::ThreadPoolBuilder::new().num_threads(threads).build() {
        Ok(pool) => pool.install(all),
        Err(_) => plan.runs.iter().zip(done.clone()).map(one).collect(),
    };
    bar.finish_and_clear();
    // The first failure in the order of the plan, not in time.
    made.into_iter().collect()
}

fn simulate(rig: &Rig, run: &PlanRun, folder: &Folder) -> Result<RigRunEntry, Failure> {
    let logged = rig
        .run(&run.name, &run.experiment, run.seed)
        .map_err(|source| Failure::VirtualRun { run: run.name.clone(), source })?;
    let entry = RigRunEntry::of(run, &logged);
    let columns = columns(&logged);
    let columns: Vec<(&str, &[f64])> =
        columns.iter().map(|(name, values)| (name.as_str(), values.as_slice())).collect();
    folder.store(&run.name, &entry, &columns)?;
    Ok(entry)
}

/// The columns of a log: time, current, motor and every mass.
fn columns(logged: &Logged) -> Vec<(String, Vec<f64>)> {
    let run = &logged.run;
    let time = (0..run.len()).map(|k| k as f64 * run.sample_time_s()).collect();
    let mut columns = vec![
        ("t".to_owned(), time),
        ("i".to_owned(), run.command().to_vec()),
        ("theta_m".to_owned(), run.motor().to_vec()),
    ];
    for (mass, tip) in run.tips().iter().enumerate() {
        columns.push((tip_column(mass), tip.clone()));
    }
    columns
}

fn campaign_plan(rig: &Rig, plan: &PlanFile) -> CampaignPlan {
    let title = if plan.title.is_empty() { "A virtual campaign." } else { &plan.title };
    let runs = plan
        .runs
        .iter()
        .map(|run| PlannedRun { file: format!("{}.csv", run.name), omega_rad_s: run.omega_rad_s });
    described(rig, title.to_owned(), Some("arm.toml".to_owned()), runs.collect())
}
