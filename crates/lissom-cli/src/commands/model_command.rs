//! `lissom model ARM`: the model of an arm, from its dimensions.

use std::path::Path;

use lissom_io::write::{self, Batch};
use lissom_io::{ArmFile, ModelFile, read_frequencies};

use crate::args::model_args::{ModelArgs, Omega};
use crate::args::stdout_name::STDOUT;
use crate::shared::exit_codes::ExitCode;
use crate::shared::failure::Failure;
use crate::shared::{output_guard, progress_bar};
use crate::tasks::any_beam::{Beam, MOST_DENSE};
use crate::tasks::model_task::{STEPS, Task};
use crate::views::{model_plots, model_table, printer};

pub(crate) fn run(args: &ModelArgs) -> Result<ExitCode, Failure> {
    let json = args.json.as_deref();
    let json_file = json.filter(|path| *path != Path::new(STDOUT));
    output_guard::guard(json_file, None)?;
    let file = ArmFile::read(&args.arm)?;
    let beam = Beam::of(&file, &args.arm).map_err(lissom_io::Error::from)?;
    let drive = file.drive.as_ref().map(|drive| (drive.motor, drive.coulomb));
    let omega_rad_s = args.omega.as_ref().map(frequencies).transpose()?;
    let functions = if args.all { beam.len().min(MOST_DENSE) } else { 0 };
    let steps = STEPS + functions + omega_rad_s.as_ref().map_or(0, Vec::len) + args.payload.len();
    let bar = progress_bar::stages(steps);
    let task = Task { args, beam: &beam, drive, omega_rad_s, bar };
    let model = task.model()?;
    let mut batch = Batch::new();
    if let Some(path) = json_file {
        batch.file(path, write::json_text(path, &ModelFile::of(&model))?.as_bytes())?;
    }
    if let Some(folder) = &args.plots {
        model_plots::add_all(&mut batch, folder, &task, &model)?;
    }
    batch.commit()?;
    if json.is_some() && json_file.is_none() {
        printer::json(&ModelFile::of(&model))?;
    } else {
        model_table::print(&task, &model);
    }
    Ok(ExitCode::SUCCESS)
}

fn frequencies(omega: &Omega) -> Result<Vec<f64>, lissom_io::Error> {
    match omega {
        Omega::Range { start, stop, count } => Ok(Omega::range(*start, *stop, *count)),
        Omega::File(path) => Ok(read_frequencies(path)?),
    }
}
