//! `lissom rig`: a campaign of experiments on a virtual arm.

use std::path::Path;

use lissom::rig::Drive;
use lissom_io::write;
use lissom_io::{ArmFile, PlanFile, PlanRun};

use super::campaign_folder::DONE;
use super::virtual_campaign::{CAMPAIGN, Inputs, campaign};
use crate::args::rig_args::RigArgs;
use crate::args::stdout_name::STDOUT;
use crate::shared::exit_codes::ExitCode;
use crate::shared::failure::Failure;
use crate::shared::output_guard;
use crate::views::printer;
use crate::views::rig_table::{lumped, report};

pub(crate) fn run(args: &RigArgs) -> Result<ExitCode, Failure> {
    let to_stdout = args.json.as_deref() == Some(Path::new(STDOUT));
    output_guard::guard(args.json.as_deref().filter(|_| !to_stdout), None)?;
    if let Some(json) = args.json.as_deref().filter(|json| **json == args.out.join(DONE)) {
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
    let whole = campaign(&rig, &plan, &inputs, &args.out, args.jobs)?;
    match args.json.as_deref() {
        Some(_) if to_stdout => printer::json(&whole)?,
        json => {
            if let Some(path) = json {
                write::write_json(path, &whole)?;
            }
            report(&plan, &whole.runs, &args.out.join(CAMPAIGN));
            if let Some(line) = lumped(&file, &args.arm, &rig) {
                printer::line(&line);
            }
        }
    }
    Ok(ExitCode::SUCCESS)
}
