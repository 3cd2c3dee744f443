//! Identifies logs in a thread, and keeps the result: those of the session, or those of a virtual rig.

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread;
use std::time::{SystemTime, UNIX_EPOCH};

use lissom::DescribedLogs;
use lissom::identify::{Effort, Identified, Interrupt, Options, Severity, Stage, identify};
use lissom::record::Hold;
use lissom_io::campaign::{AnalysisOptions, DriveConstants};
use lissom_io::inspect::{Description, Inspection};
use lissom_io::{CampaignFile, CampaignReader, EffortName, ResultFile, UnitNames, write};
use lissom_text::with_uncertainty;
use lissom_views::known_arm::checked;
use lissom_views::report_page::{self, PageContent};
use lissom_views::{ProgramHints, Reference, own_logs, parameter_rows};

use crate::app::Shared;
use crate::job::{FirstRow, Job};
use crate::planning::Planned;
use crate::problem::Problem;
use crate::session::{LogEntry, ResultEntry, Session};
use crate::state_folder::create_private;

/// Where the logs come from.
enum Logs {
    /// Logs, and what is said about them.
    Described {
        first: Box<Inspection>,
        folder: PathBuf,
        files: Vec<PathBuf>,
        said: Box<Description>,
    },
    /// A campaign.toml; confined to its folder if the browser sent it.
    Campaign { path: PathBuf, confined: bool },
    /// Planned runs, simulated; their plan.toml is kept in place of a campaign.toml.
    Virtual(Box<Planned>),
}

/// Logs that were read.
struct Read {
    file: CampaignFile,
    /// The text of the campaign.toml.
    campaign: String,
    /// The simulated arm.
    truth: Option<Reference>,
}

/// The files of a result.
struct Made {
    entry: ResultEntry,
    result: String,
    campaign: String,
    page: String,
    arm: Option<String>,
}

/// Starts the identification of the session as it is.
pub(crate) fn start(app: &Shared, session: Session) -> Result<Arc<Job>, Problem> {
    let logs = logs(app, &session)?;
    start_with(app, session, logs)
}

/// Starts the simulation of planned runs, and the identification of their logs.
pub(crate) fn start_virtual(
    app: &Shared,
    session: Session,
    planned: Planned,
) -> Result<Arc<Job>, Problem> {
    start_with(app, session, Logs::Virtual(Box::new(planned)))
}

fn start_with(app: &Shared, session: Session, logs: Logs) -> Result<Arc<Job>, Problem> {
    let effort = session.setup.effort.effort();
    let job = Arc::new(Job::new(effort.most_evaluations()));
    app.begin(&job)?;
    let (app, running) = (Arc::clone(app), Arc::clone(&job));
    thread::spawn(move || {
        let made =
            || made(&session, logs, &running).map_err(|p| p.without_folder(&app.folder.logs()));
        let work = || keep(&app, made()?);
        let outcome = catch_unwind(AssertUnwindSafe(work));
        running.finish(outcome.unwrap_or_else(|_| {
            Err(Problem::internal("the identification has failed: this is an error in lissom"))
        }));
    });
    Ok(job)
}

/// The logs of the session, refused if something is missing.
fn logs(app: &Shared, session: &Session) -> Result<Logs, Problem> {
    if let Some(campaign) = session.campaign() {
        let confined = campaign.path.is_none();
        return Ok(Logs::Campaign { path: app.path(campaign)?, confined });
    }
    let files: Vec<PathBuf> = session.used_logs().map(LogEntry::address).collect();
    let Some(first) = session.used_logs().next() else {
        return Err(Problem::input("there is no log", Some("add a log first".to_owned())));
    };
    let first = Box::new(Inspection::clone(&*app.inspection(session, first)?));
    let said = session.description(&first)?;
    Ok(Logs::Described { first, folder: app.folder.logs(), files, said: Box::new(said) })
}

/// Reads the logs, or makes them.
fn read(logs: Logs, job: &Job) -> Result<Read, Problem> {
    match logs {
        Logs::Described { first, folder, files, said } => {
            let described = DescribedLogs::in_folder(*first, &folder, &files, &said)?;
            let file = described.read()?;
            Ok(Read { file, campaign: described.draft.commented(), truth: None })
        }
        Logs::Campaign { path, confined } => {
            let reader = CampaignReader::of_file(&path);
            let reader = if confined { reader.confined() } else { reader };
            Ok(Read { file: reader.read()?, campaign: fs::read_to_string(&path)?, truth: None })
        }
        Logs::Virtual(planned) => {
            job.step("simulating the planned runs");
            let campaign = planned.simulated()?;
            let (known, analysis) = (DriveConstants::default(), AnalysisOptions::default());
            let truth = Some(Reference::truth(&planned.rig.arm));
            Ok(Read {
                file: CampaignFile { campaign, known, analysis },
                campaign: planned.text,
                truth,
            })
        }
    }
}

/// Identifies, and makes the texts of the files.
fn made(session: &Session, logs: Logs, job: &Job) -> Result<Made, Problem> {
    let is_virtual = matches!(logs, Logs::Virtual(_));
    let is_described = matches!(logs, Logs::Described { .. });
    let Read { file, campaign, truth } = read(logs, job)?;
    let effort = session.setup.effort.effort();
    let found = |effort, interrupt: Interrupt, stage: &dyn Fn(Stage)| {
        let options = Options { effort, interrupt, ..file.options() };
        identify(&file.campaign, &options, stage)
            .map_err(|error| Problem::input(error.to_string(), None))
    };
    if job.is_dropped() {
        return Err(Problem::input("stopped", None));
    }
    job.has_read();
    let stages = Stage::count(file.campaign.runs.len());
    let mut first = None;
    if effort == Effort::Quick {
        job.first(Vec::new(), stages);
    } else {
        job.step("first result, without a search");
        let quick = found(Effort::Quick, Interrupt::default(), &|_| ())?;
        job.first(first_rows(&file, &quick), stages);
        first = Some(quick).filter(|_| job.interrupt.is_asked());
    }
    // Who stops before the search begins gets the first result.
    let is_first = first.is_some();
    let id = match first {
        Some(first) => first,
        None => found(effort, job.interrupt.clone(), &|stage| job.stage(stage))?,
    };
    job.step("report");
    let described = Reference::of(&file)?;
    let geometry = checked(&id, described.as_ref());
    let reference = truth.or(described);
    let result = ResultFile::of(&file.campaign.channels, &id, geometry.as_ref());
    let name = if is_virtual { "virtual rig".to_owned() } else { name(session) };
    let own = own_logs(&file.campaign, id.arm.as_ref());
    let content = PageContent {
        result: &result,
        logs: own.as_ref().map(|own| (&file.campaign, own)),
        reference: reference.as_ref(),
        hints: &ProgramHints::NONE,
    };
    let page = report_page::page(&name, content);
    let count = |severity| id.findings.iter().filter(|f| f.severity() == severity).count();
    let mut setup = session.setup.clone();
    if is_described && file.campaign.channels.command.hold == Hold::Sampled {
        // What was found from the motion is now said: a part of the logs may not show it. A hold that was only assumed is not.
        setup.say_sampled();
    }
    let made = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    Ok(Made {
        entry: ResultEntry {
            id: 0,
            name,
            made_s: made.as_secs(),
            effort: if is_first { EffortName::Quick } else { session.setup.effort },
            runs: id.runs.len(),
            warnings: count(Severity::Warning),
            refusals: count(Severity::Refusal),
            interrupted: is_first || id.is_interrupted(),
            planned: is_virtual,
            setup,
        },
        result: write::json_text(Path::new("result.json"), &result)
            .map_err(lissom_io::Error::from)?,
        campaign,
        page: page.to_html(),
        arm: id.arm.as_ref().and_then(|arm| write::found_arm_text(arm, &file.campaign)),
    })
}

/// The name of a result of the session: that of its campaign or first log.
fn name(session: &Session) -> String {
    let first = session.campaign().or_else(|| session.used_logs().next());
    let more = match session.campaign() {
        Some(_) => 0,
        None => session.used_logs().count().saturating_sub(1),
    };
    let first = first.map_or_else(String::new, LogEntry::title);
    match more {
        0 => first,
        1 => format!("{first} and one more"),
        more => format!("{first} and {more} more"),
    }
}

fn first_rows(file: &CampaignFile, id: &Identified) -> Vec<FirstRow> {
    let channels = &file.campaign.channels;
    let rows = parameter_rows(UnitNames::new(channels), &ResultFile::of(channels, id, None), None);
    let row = |row: lissom_views::parameter_rows::ParameterRow| {
        let value = row.estimate.map(|e| with_uncertainty(e.value, e.std));
        let value = value.unwrap_or_else(|| "refused".to_owned());
        FirstRow { name: row.name, value, unit: row.unit }
    };
    rows.into_iter().map(row).collect()
}

/// Writes the files of a result, and adds it to the session.
fn keep(app: &Shared, made: Made) -> Result<u64, Problem> {
    let id = app.amend(Session::new_result)?;
    let folder = app.folder.result(id);
    create_private(&folder)?;
    let files = [
        ("result.json", made.result),
        (if made.entry.planned { "plan.toml" } else { "campaign.toml" }, made.campaign),
        ("report.html", made.page),
    ];
    let arm = made.arm.map(|arm| ("arm.toml", arm));
    let mut batch = write::Batch::new();
    for (name, text) in files.into_iter().chain(arm) {
        batch.file(&folder.join(name), text.as_bytes()).map_err(lissom_io::Error::from)?;
    }
    batch.commit().map_err(lissom_io::Error::from)?;
    app.amend(|session| {
        if session.setup.hold.is_empty() {
            session.setup.hold.clone_from(&made.entry.setup.hold);
        }
        session.results.push(ResultEntry { id, ..made.entry });
    })?;
    Ok(id)
}
