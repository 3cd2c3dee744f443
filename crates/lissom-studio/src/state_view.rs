//! The session as the page shows it.

use std::sync::Arc;

use lissom_io::CampaignReader;
use lissom_io::inspect::{CampaignDraft, InspectedLogEntry, Inspection, InspectionFile};
use serde::Serialize;

use crate::app::App;
use crate::exports;
use crate::job::JobView;
use crate::problem::Problem;
use crate::runs;
use crate::session::{FileKind, LogEntry, ResultEntry, Session};
use crate::setup::Setup;

/// What stands beside a hold that the identification finds.
const NOT_YET: &str = "not decided yet: \"Identify\" finds from the motion whether it is measured or sampled, as far as the motion shows it";

/// The session as the page shows it.
#[derive(Debug, Serialize)]
pub(crate) struct StateView {
    version: &'static str,
    folder: String,
    revision: u64,
    logs: Vec<LogView>,
    setup: Setup,
    campaign: CampaignView,
    job: Option<JobView>,
    results: Vec<ResultView>,
}

/// A result.
#[derive(Debug, Serialize)]
struct ResultView {
    #[serde(flatten)]
    entry: ResultEntry,
    /// Names of the files that it gives.
    files: Vec<&'static str>,
}

/// A log, or why it cannot be read.
type ReadLog = Result<Arc<Inspection>, Problem>;

/// A file.
#[derive(Debug, Serialize)]
struct LogView {
    id: u64,
    name: String,
    kind: FileKind,
    used: bool,
    log: Option<InspectedLogEntry>,
    /// Seconds for one unit of its time stamps, or for one row; none if that is not known.
    stamp_s: Option<f64>,
    /// What its runs are known by, if each can be a log of its own.
    runs_by: Option<String>,
    /// Whether it is one run of its file.
    is_run: bool,
    problem: Option<Problem>,
}

/// The campaign.toml of the session.
#[derive(Debug, Default, Serialize)]
struct CampaignView {
    /// Its text, with comments; what is missing stands there as a comment.
    text: String,
    /// Whether a campaign.toml was given, so that nothing else is said about the logs.
    given: bool,
    /// Why it cannot be identified yet.
    problems: Vec<Problem>,
}

impl StateView {
    pub(crate) fn of(app: &App) -> Self {
        let session = app.session();
        let is_log = |log: &LogEntry| log.kind == FileKind::Log;
        let logs: Vec<(&LogEntry, Option<ReadLog>)> = session
            .logs
            .iter()
            .map(|log| (log, is_log(log).then(|| app.inspection(&session, log))))
            .collect();
        let first = session.used_logs().next().map(|log| log.id);
        let first = logs.iter().find(|(log, _)| Some(log.id) == first);
        let first = first.and_then(|(_, read)| read.as_ref()?.as_ref().ok());
        let mut campaign = campaign(app, &session, first);
        if let Some(first) = first.filter(|_| !campaign.given) {
            let used = logs.iter().filter(|(log, _)| !session.setup.left_out.contains(&log.id));
            let read = used.filter_map(|(log, read)| Some((log, read.as_ref()?.as_ref().ok()?)));
            let lacking = read.filter_map(|(log, read)| {
                let name = session.setup.lacking(first, read).into_iter().next()?;
                Some(lacks(&log.title(), &name))
            });
            campaign.problems.extend(lacking);
        }
        let views = logs.iter().map(|(log, read)| LogView {
            id: log.id,
            name: log.title(),
            kind: log.kind,
            used: log.kind != FileKind::Log || !session.setup.left_out.contains(&log.id),
            log: read.as_ref().and_then(|read| inspected(read.as_ref().ok()?)),
            stamp_s: read.as_ref().and_then(|read| session.setup.stamp_s(read.as_ref().ok()?)),
            runs_by: read.as_ref().and_then(|read| {
                Some(runs::runs_by(&session.setup, log, read.as_ref().ok()?)?.name())
            }),
            is_run: log.run.is_some(),
            problem: read.as_ref().and_then(|read| read.as_ref().err()).cloned(),
        });
        Self {
            version: env!("CARGO_PKG_VERSION"),
            folder: app.folder.path().display().to_string(),
            revision: session.revision,
            logs: views.collect(),
            setup: session.setup.clone(),
            campaign,
            job: app.job().map(|job| job.view()),
            results: session.results.iter().map(ResultView::of).collect(),
        }
    }
}

impl ResultView {
    fn of(entry: &ResultEntry) -> Self {
        Self { entry: entry.clone(), files: exports::names(entry.planned).collect() }
    }
}

/// A log that does not have a channel of the first one.
fn lacks(log: &str, channel: &str) -> Problem {
    let hint = "leave it out above, or choose channels that all logs have";
    Problem::input(format!("{log}: there is no channel \"{channel}\""), Some(hint.to_owned()))
}

fn inspected(log: &Arc<Inspection>) -> Option<InspectedLogEntry> {
    InspectionFile::of(std::slice::from_ref(&**log)).logs.pop()
}

fn campaign(app: &App, session: &Session, first: Option<&Arc<Inspection>>) -> CampaignView {
    if let Some(given) = session.campaign() {
        let read = || {
            let path = app.path(given)?;
            let reader = CampaignReader::of_file(&path);
            let reader = if given.path.is_none() { reader.confined() } else { reader };
            Ok((lissom_io::read_text(&path)?, checked(app, reader)))
        };
        let (text, problem) = read().unwrap_or_else(|problem| (String::new(), Some(problem)));
        return CampaignView { text, given: true, problems: problem.into_iter().collect() };
    }
    let Some(first) = first else {
        let has_logs = session.logs.iter().any(|log| log.kind == FileKind::Log);
        let none_is_used = has_logs && session.used_logs().next().is_none();
        let problem = || Problem::input("all logs are left out", Some("use one above".to_owned()));
        let problems = none_is_used.then(problem).into_iter().collect();
        return CampaignView { problems, ..CampaignView::default() };
    };
    let draft = || {
        let mut said = session.description(first)?;
        let files: Vec<_> = session.used_logs().map(LogEntry::address).collect();
        let mut draft = CampaignDraft::new(first, &files, &said).map_err(lissom_io::Error::from)?;
        if draft.assumes_hold() {
            said.hold_shown = Some(("unknown".to_owned(), NOT_YET.to_owned()));
            draft = CampaignDraft::new(first, &files, &said).map_err(lissom_io::Error::from)?;
        }
        Ok::<_, Problem>(draft)
    };
    match draft() {
        Ok(draft) => {
            CampaignView { text: draft.commented(), given: false, problems: problems(app, &draft) }
        }
        Err(problem) => CampaignView { problems: vec![problem], ..CampaignView::default() },
    }
}

/// What is missing or wrong in a draft.
fn problems(app: &App, draft: &CampaignDraft) -> Vec<Problem> {
    let missing = draft.missing().map(|error| Problem::input(error.to_string(), None));
    let missing: Vec<Problem> = missing.collect();
    let Ok(text) = draft.text() else { return missing };
    checked(app, CampaignReader::of_text("campaign.toml", text)).into_iter().collect()
}

/// What is wrong in a description, without reading its logs.
fn checked(app: &App, reader: CampaignReader) -> Option<Problem> {
    reader.check().err().map(|error| Problem::from(error).without_folder(&app.folder.logs()))
}
