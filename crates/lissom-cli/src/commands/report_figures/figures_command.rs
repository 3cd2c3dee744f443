//! `lissom figures`: Figures 6, 7 and 8 of the 1989 report, from simulated logs.

use std::path::Path;

use lissom_io::write::{self, Batch};
use lissom_io::{ArmFile, PlanFile, ResultFile, UnitNames, read_campaign};
use lissom_views::bode_plots::bode_plots;
use lissom_views::known_arm::Reference;
use lissom_views::velocity_friction::friction_plot;

use crate::args::figures_args::FiguresArgs;
use crate::args::stdout_name::STDOUT;
use crate::commands::rig::virtual_campaign::{self, Inputs};
use crate::shared::exit_codes::ExitCode;
use crate::shared::failure::Failure;
use crate::shared::output_guard;
use crate::tasks::identification::{Asked, identified};
use crate::tasks::printed_coulomb::{compared, rows};
use crate::views::friction_truth::with_truth;
use crate::views::plot_file::add;
use crate::views::{printed_coulomb_table, printer};

const ARM: &str = include_str!("arm.toml");
const PLAN: &str = include_str!("plan.toml");

pub(crate) fn run(args: &FiguresArgs) -> Result<ExitCode, Failure> {
    let out = &args.out;
    let to_stdout = args.json.as_deref() == Some(Path::new(STDOUT));
    output_guard::guard(args.json.as_deref().filter(|_| !to_stdout), None)?;
    let (arm_path, plan_path) = (out.join("arm.toml"), out.join("plan.toml"));
    write::create_folder(out)?;
    write::write_text(&arm_path, ARM)?;
    write::write_text(&plan_path, PLAN)?;
    let made = ArmFile::read(&arm_path)?.rig(&arm_path).map_err(lissom_io::Error::from)?;
    let plan = PlanFile::read(&plan_path)?;
    let logs = out.join("logs");
    let inputs = Inputs { arm: ARM.to_owned(), plan: PLAN.to_owned() };
    virtual_campaign::campaign(&made, &plan, &inputs, &logs, None)?;

    let campaign = logs.join("campaign.toml");
    let file = read_campaign(&campaign)?;
    let id = identified(&campaign, &file, Asked::default())?;
    let channels = &file.campaign.channels;
    let names = UnitNames::new(channels);
    let result = ResultFile::of(channels, &id, None);
    let truth = Reference { label: "theory", ..Reference::truth(&made.arm) };
    let mut batch = Batch::new();
    batch.folder(out)?;
    let bodes = bode_plots(names, &result, Some(&truth));
    for ((_, plot), name) in bodes.iter().zip(["figure-6", "figure-7"]) {
        add(&mut batch, out, name, plot)?;
    }
    if let Some(plot) = friction_plot(names, &result) {
        add(&mut batch, out, "figure-8", &with_truth(plot, &made, &id))?;
    }
    batch.commit()?;
    let rows = rows(&made, &id);
    match args.json.as_deref() {
        Some(_) if to_stdout => printer::json(&compared(&rows))?,
        json => {
            if let Some(path) = json {
                write::write_json(path, &compared(&rows))?;
            }
            printed_coulomb_table::report(out, &rows);
        }
    }
    Ok(ExitCode::SUCCESS)
}
