//! `lissom rig`: a campaign of experiments on a virtual arm.

mod facts;
mod folder;

use std::path::Path;
use std::process::ExitCode;

use lissom::beam::Base;
use lissom::record::{Hold, TipQuantity};
use lissom::rig::{Drive, Logged, Rig};
use lissom_io::write::{self, CampaignPlan, PlannedCommand, PlannedRun};
use lissom_io::{ArmFile, PlanFile, PlanRun};
use rayon::prelude::*;
use serde_json::Value;

use crate::cli::{RigArgs, STDOUT};
use crate::failure::Failure;
use crate::{output, print, progress};
use folder::Folder;

const CAMPAIGN: &str = "campaign.toml";
/// Findings of one kind that are shown.
const WARNED: usize = 3;
/// Frequencies of a lumped beam that are compared.
const SHOWN: usize = 3;

pub(crate) fn run(args: &RigArgs) -> Result<ExitCode, Failure> {
    let to_stdout = args.json.as_deref() == Some(Path::new(STDOUT));
    output::guard(args.json.as_deref().filter(|_| !to_stdout), None)?;
    if let Some(json) = args.json.as_deref().filter(|json| **json == args.out.join(folder::DONE)) {
        return Err(Failure::SameOutput { file: json.to_owned() });
    }
    let inputs = Inputs::read(&args.arm, &args.campaign)?;
    let file = ArmFile::from_text(&args.arm, &inputs.arm)?;
    let rig = file.rig(&args.arm).map_err(lissom_io::Error::from)?;
    let plan = PlanFile::from_text(&args.campaign, &inputs.plan)?;
    let loops = |run: &&PlanRun| matches!(run.experiment.drive, Drive::Angle(_));
    if let Some(run) = plan.runs.iter().find(loops).filter(|_| !file.has_controller()) {
        return Err(Failure::NoController { arm: args.arm.clone(), run: run.name.clone() });
    }
    let (facts, whole) = campaign(&rig, &plan, &inputs, &args.out, args.jobs)?;
    match args.json.as_deref() {
        Some(_) if to_stdout => print::json(&whole),
        json => {
            if let Some(path) = json {
                write::write_json(path, &whole)?;
            }
            report(&plan, &facts, &args.out.join(CAMPAIGN));
            if let Some(line) = lumped(&file, &args.arm, &rig) {
                print::line(&line);
            }
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// The texts that a campaign is made from, as they were when it began.
pub(crate) struct Inputs {
    /// Of the arm.toml.
    pub(crate) arm: String,
    /// Of the plan.toml.
    pub(crate) plan: String,
}

impl Inputs {
    fn read(arm: &Path, plan: &Path) -> Result<Self, Failure> {
        let text = |path: &Path| {
            lissom_io::read_text(path).map_err(|source| {
                let file = path.display().to_string();
                lissom_io::Error::from(lissom_io::ConfigError::Read { file, source })
            })
        };
        Ok(Self { arm: text(arm)?, plan: text(plan)? })
    }
}

/// Carries out a campaign, or the rest of it; gives the facts of each run and what `rig.json` holds.
pub(crate) fn campaign(
    rig: &Rig,
    plan: &PlanFile,
    inputs: &Inputs,
    out: &Path,
    jobs: Option<u16>,
) -> Result<(Vec<Value>, Value), Failure> {
    let folder = Folder::open(out, rig, plan)?;
    let facts = carry_out(rig, plan, &folder, jobs)?;
    let whole = facts::campaign(rig, plan, &facts);
    write::write_text(&folder.path("arm.toml"), &inputs.arm)?;
    write::write_text(&folder.path("plan.toml"), &inputs.plan)?;
    write::write_campaign(&folder.path(CAMPAIGN), &campaign_plan(rig, plan))?;
    folder.finish(&whole)?;
    Ok((facts, whole))
}

/// Makes every log that is not there yet; gives the facts of all, in order.
fn carry_out(
    rig: &Rig,
    plan: &PlanFile,
    folder: &Folder,
    jobs: Option<u16>,
) -> Result<Vec<Value>, Failure> {
    let done: Vec<Option<Value>> = plan.runs.iter().map(|run| folder.done(&run.name)).collect();
    let there = done.iter().flatten().count();
    if there > 0 {
        print::note(&format!("{there} of {} logs are there already", plan.runs.len()));
    }
    let bar = progress::bar(plan.runs.len(), "virtual campaign");
    bar.enable_steady_tick(std::time::Duration::from_millis(250));
    let one = |(run, done): (&PlanRun, Option<Value>)| -> Result<Value, Failure> {
        let facts = match done {
            Some(facts) => facts,
            None => simulate(rig, run, folder)?,
        };
        bar.inc(1);
        Ok(facts)
    };
    let all = || plan.runs.par_iter().zip(done.clone()).map(one).collect::<Vec<_>>();
    let threads = jobs.map_or(0, usize::from);
    // Where no threads can be had, this one does it alone.
    let made = match rayon::ThreadPoolBuilder::new().num_threads(threads).build() {
        Ok(pool) => pool.install(all),
        Err(_) => plan.runs.iter().zip(done.clone()).map(one).collect(),
    };
    bar.finish_and_clear();
    // The first failure in the order of the plan, whichever came first in time.
    made.into_iter().collect()
}

fn simulate(rig: &Rig, run: &PlanRun, folder: &Folder) -> Result<Value, Failure> {
    let logged = rig
        .run(&run.name, &run.experiment, run.seed)
        .map_err(|source| Failure::VirtualRun { run: run.name.clone(), source })?;
    let facts = facts::run(run, &logged);
    let columns = columns(&logged);
    let columns: Vec<(&str, &[f64])> =
        columns.iter().map(|(name, values)| (name.as_str(), values.as_slice())).collect();
    folder.store(&run.name, &facts, &columns)?;
    Ok(facts)
}

/// Time, current, motor and every mass.
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

fn tip_column(mass: usize) -> String {
    format!("theta_{}", mass + 1)
}

fn campaign_plan(rig: &Rig, plan: &PlanFile) -> CampaignPlan {
    let title = if plan.title.is_empty() { "A virtual campaign." } else { &plan.title };
    let runs = plan
        .runs
        .iter()
        .map(|run| PlannedRun { file: format!("{}.csv", run.name), omega_rad_s: run.omega_rad_s });
    described(rig, title.to_owned(), Some("arm.toml".to_owned()), runs.collect())
}

/// A campaign of this rig's drive and sensors.
pub(crate) fn described(
    rig: &Rig,
    title: String,
    arm: Option<String>,
    runs: Vec<PlannedRun>,
) -> CampaignPlan {
    let instruments = &rig.instruments;
    // The current stands between two rows where the controller acts at rows alone.
    let held = instruments.control_every.is_multiple_of(instruments.log_every);
    let masses = rig.arm.beam().len();
    CampaignPlan {
        title,
        time_column: "t".to_owned(),
        command: PlannedCommand {
            column: "i".to_owned(),
            hold: if held { Hold::Sampled } else { Hold::Measured },
        },
        motor_column: "theta_m".to_owned(),
        tips: (0..masses)
            .map(|mass| (format!("theta_{}", mass + 1), tip_column(mass), TipQuantity::Angle))
            .collect(),
        torque_constant_nm_per_a: Some(rig.arm.motor.torque_constant_nm_per_a),
        current_limit_a: instruments.amplifier.limit_a(),
        arm,
        runs,
    }
}

/// What lumping did to a beam with mass along it.
fn lumped(file: &ArmFile, path: &Path, rig: &Rig) -> Option<String> {
    let beam = file.distributed_beam(path).ok()?;
    let exact = beam.frequencies_rad_s(Base::Clamped, SHOWN);
    let found = rig.arm.beam().frequencies_rad_s(Base::Clamped, SHOWN);
    let errors = found.iter().zip(&exact).map(|(a, b)| format!("{:+.2} %", 100.0 * (a / b - 1.0)));
    let errors: Vec<String> = errors.collect();
    Some(format!(
        "the beam is lumped, masses: {}; its first frequencies are off by {}; `masses` in [rig] \
         changes that",
        rig.arm.beam().len(),
        errors.join(", ")
    ))
}

fn report(plan: &PlanFile, facts: &[Value], campaign: &Path) {
    let head = ["run", "samples", "settled after", "left [rad]", "stuck"];
    let mut rows = vec![head.map(str::to_owned).to_vec()];
    let figure = |facts: &Value, key: &str, digits: usize, unit: &str| {
        facts[key].as_f64().map_or_else(|| "-".to_owned(), |v| format!("{v:.digits$}{unit}"))
    };
    for (run, facts) in plan.runs.iter().zip(facts) {
        let left = facts["transient_left_rad"].as_f64();
        rows.push(vec![
            run.name.clone(),
            facts["samples"].to_string(),
            figure(facts, "waited_s", 1, " s"),
            left.map_or_else(|| "-".to_owned(), |v| format!("{v:.1e}")),
            facts["stuck_share"]
                .as_f64()
                .map_or_else(String::new, |v| format!("{:.1} %", 100.0 * v)),
        ]);
    }
    print::table(&rows);
    warn(plan, facts);
    print::line("");
    print::line(&format!("identify it with: lissom identify {}", campaign.display()));
}

/// The findings, those of one kind together.
fn warn(plan: &PlanFile, facts: &[Value]) {
    let mut kinds: Vec<(&str, Vec<String>)> = Vec::new();
    for (run, facts) in plan.runs.iter().zip(facts) {
        for finding in facts["findings"].as_array().into_iter().flatten() {
            let text = |key: &str| finding[key].as_str().unwrap_or_default();
            let line = format!("warning: {}: {}", run.name, text("message"));
            match kinds.iter_mut().find(|(code, _)| *code == text("code")) {
                Some((_, lines)) => lines.push(line),
                None => kinds.push((text("code"), vec![line])),
            }
        }
    }
    for (_, lines) in kinds {
        lines.iter().take(WARNED).for_each(|line| print::line(line));
        if lines.len() > WARNED {
            print::line(&format!(
                "  … and {} more of this kind, in rig.json",
                lines.len() - WARNED
            ));
        }
    }
}
