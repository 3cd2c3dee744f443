//! `lissom fleet`.

use std::ffi::OsString;
use std::fs::File;
use std::io::{self, BufReader};
use std::num::NonZeroUsize;
use std::path::Path;
use std::thread;

use lissom_fleet::{
    EffortName, ExistingRows, FleetError, FleetLog, FleetRun, FleetSettings, LogPattern, MANIFEST,
    Refinement, WorkerProgram, logs_of_paths, logs_of_table, open, run_here, serve,
};
use lissom_io::read_text;

use crate::args::fleet_args::{FleetArgs, FleetCommand, FleetRunArgs, FleetTableArgs};
use crate::args::identify_args::EffortArg;
use crate::commands::fleet_summary_command;
use crate::shared::exit_codes::ExitCode;
use crate::shared::failure::Failure;
use crate::shared::interrupted::stopped_by_ctrl_c;
use crate::shared::output_guard;
use crate::shared::progress_bar::FleetBar;
use crate::views::{fleet_run_lines, printer};

/// `own` is how this program is started: program and arguments, without those of the command.
pub(crate) fn run(args: &FleetArgs, own: &[OsString]) -> Result<ExitCode, Failure> {
    match &args.command {
        Some(FleetCommand::Summary(args)) => fleet_summary_command::run(args),
        Some(FleetCommand::Table(args)) => table(args),
        Some(FleetCommand::Worker) => {
            // The program that asked is gone if this fails.
            let _ = serve(io::stdin().lock(), io::stdout().lock());
            Ok(ExitCode::SUCCESS)
        }
        None => identify(&args.run, own),
    }
}

fn identify(args: &FleetRunArgs, own: &[OsString]) -> Result<ExitCode, Failure> {
    let (Some(like), Some(out)) = (&args.like, &args.out) else {
        return Err(Failure::Asked(
            "--like and --out are missing".to_owned(),
            "lissom fleet LOGS --like campaign.toml --out DIR",
        ));
    };
    if args.logs.is_empty() && args.table.is_none() {
        return Err(Failure::Asked(
            "LOGS are missing".to_owned(),
            "lissom fleet LOGS --like campaign.toml --out DIR",
        ));
    }
    let Some((program, arguments)) = own.split_first() else {
        return Err(Failure::Asked("this program has no name".to_owned(), "start it by its name"));
    };
    let mut arguments = arguments.to_vec();
    arguments.extend(["fleet", "worker"].map(OsString::from));
    let program = WorkerProgram { program: program.into(), arguments };
    let existing = match &args.again[..] {
        _ if args.new => ExistingRows::Refuse,
        [] => ExistingRows::Keep,
        again => ExistingRows::KeepBut(
            again.iter().filter_map(|name| lissom_fleet::Failure::of(name)).collect(),
        ),
    };
    let settings = settings(args, like)?;
    let logs = logs(args, like, out, settings.run_files()?.as_deref())?;
    let run = FleetRun::begin(out, settings, logs, &existing)?;
    let cores = || thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
    let workers = args.workers.unwrap_or_else(cores);
    let bar = FleetBar::new(run.progress().logs);
    let outcome = run_here(run, workers, &program, stopped_by_ctrl_c(), |p| bar.show(p));
    bar.finish();
    match outcome {
        Ok(progress) => {
            fleet_run_lines::print(&open(out)?, &progress, workers)?;
            Ok(ExitCode::SUCCESS)
        }
        Err(FleetError::Stopped) => {
            fleet_run_lines::stopped(&open(out)?);
            Ok(ExitCode::INTERRUPTED)
        }
        Err(error) => Err(error.into()),
    }
}

fn settings(args: &FleetRunArgs, like: &Path) -> Result<FleetSettings, Failure> {
    let campaign =
        read_text(like).map_err(|source| FleetError::Read { path: like.to_owned(), source })?;
    let codes = args.refine_on.clone();
    let more = EffortName::of(&args.refine);
    Ok(FleetSettings {
        by_folder: args.by_folder,
        effort: effort_name(args.effort),
        refinement: more.map(|effort| Refinement { effort, codes }),
        time_limit_s: args.time_limit,
        retries: args.retries,
        keep_results: args.results,
        ..FleetSettings::new(like, campaign)
    })
}

fn effort_name(effort: EffortArg) -> EffortName {
    match effort {
        EffortArg::Quick => EffortName::Quick,
        EffortArg::Normal => EffortName::Normal,
        EffortArg::Thorough => EffortName::Thorough,
    }
}

fn logs(
    args: &FleetRunArgs,
    like: &Path,
    out: &Path,
    run_files: Option<&[String]>,
) -> Result<Vec<FleetLog>, Failure> {
    let pattern = args.pattern.as_deref().map(LogPattern::new).transpose()?;
    let Some(table) = &args.table else {
        let found = logs_of_paths(&args.logs, pattern.as_ref(), &[like, out], run_files)?;
        let kind = if args.by_folder { "folders" } else { "files" };
        for (what, count) in [
            (format!("{kind} that do not end like the pattern"), found.unlike),
            ("links to folders, devices and pipes".to_owned(), found.special),
        ] {
            if count > 0 {
                printer::note(&format!("{what}, left out: {count}"));
            }
        }
        return Ok(found.logs);
    };
    let failed = |source| FleetError::Read { path: table.clone(), source };
    let file = BufReader::new(File::open(table).map_err(failed)?);
    let folder = table.parent().unwrap_or(Path::new(""));
    let mut logs = logs_of_table(&table.display().to_string(), file, folder)?;
    if let Some(pattern) = &pattern {
        logs.iter_mut().try_for_each(|log| pattern.read(log))?;
    }
    Ok(logs)
}

fn table(args: &FleetTableArgs) -> Result<ExitCode, Failure> {
    let table = open(&args.folder)?;
    let is_parquet = args.out.extension().is_some_and(|end| end.eq_ignore_ascii_case("parquet"));
    let folder = args.out.parent().unwrap_or(Path::new(""));
    if is_parquet && folder.join(MANIFEST).is_file() {
        // A part would be overwritten, or taken for one.
        return Err(Failure::IsInput { file: args.out.clone() });
    }
    output_guard::guard_headed(&args.out, if is_parquet { "PAR1" } else { "log,machine,time," })?;
    table.write(&args.out)?;
    Ok(ExitCode::SUCCESS)
}
