//! `lissom plan`: the runs that give a wanted precision.

use std::path::Path;

use lissom::plan::{Plan, Wishes, plan};
use lissom::rig::Rig;
use lissom_io::write::{self, Batch};
use lissom_io::{ArmFile, PlannedFile};

use super::reference_tables;
use crate::args::plan_args::PlanArgs;
use crate::args::stdout_name::STDOUT;
use crate::shared::exit_codes::ExitCode;
use crate::shared::failure::Failure;
use crate::shared::{output_guard, progress_bar};
use crate::views::{plan_table, printer};

pub(crate) fn run(args: &PlanArgs) -> Result<ExitCode, Failure> {
    let to_stdout = args.json.as_deref() == Some(Path::new(STDOUT));
    let json_file = args.json.as_deref().filter(|_| !to_stdout);
    output_guard::guard(json_file, None)?;
    guard(args.out.as_deref(), json_file)?;
    let file = ArmFile::read(&args.arm)?;
    let rig = file.rig(&args.arm).map_err(lissom_io::Error::from)?;
    if !file.has_controller() {
        return Err(Failure::LoopNeeded { arm: args.arm.clone() });
    }
    let wishes = args.wishes();
    let made = planned(&args.arm, &rig, &wishes)?;
    let value = PlannedFile::of(&wishes, &made);
    if let Some(folder) = &args.tables {
        reference_tables::write(folder, &rig, &made)?;
    }
    let mut batch = Batch::new();
    if let Some(path) = &args.out {
        batch.file(path, write::plan_text(&made).as_bytes())?;
    }
    if let Some(path) = json_file {
        batch.file(path, write::json_text(path, &value)?.as_bytes())?;
    }
    batch.commit()?;
    match (to_stdout, &args.out) {
        (true, _) => printer::json(&value)?,
        // The plan.toml, whose comments have the contents of the table.
        (false, None) => printer::line(write::plan_text(&made).trim_end()),
        (false, Some(path)) => plan_table::report(&args.arm, &made, path),
    }
    let reached = made.expected.iter().all(|e| e.std <= e.wanted);
    Ok(if reached { ExitCode::SUCCESS } else { ExitCode::REFUSED })
}

fn planned(arm: &Path, rig: &Rig, wishes: &Wishes) -> Result<Plan, Failure> {
    let bar = progress_bar::bar(0, "simulating motions");
    bar.enable_steady_tick(std::time::Duration::from_millis(250));
    let made = plan(rig, wishes, |done, all| {
        bar.set_length(all as u64);
        bar.set_position(done as u64);
    });
    bar.finish_and_clear();
    made.map_err(|source| Failure::Plan { arm: arm.to_owned(), source })
}

/// Refuses to overwrite a file that is not an earlier plan.
fn guard(out: Option<&Path>, json: Option<&Path>) -> Result<(), Failure> {
    let Some(out) = out else { return Ok(()) };
    if json == Some(out) {
        return Err(Failure::SameOutput { file: out.to_owned() });
    }
    output_guard::guard_headed(out, write::PLAN_HEAD)
}
