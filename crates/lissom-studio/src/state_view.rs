//! The session as the page shows it.

use std::sync::Arc;

use lissom_io::inspect::{CampaignDraft, InspectedLogEntry, Inspection, InspectionFile};
use serde::Serialize;

use crate::app::App;
use crate::exports;
use crate::job::JobView;
use crate::problem::Problem;
use crate::session::{FileKind, LogEntry, ResultEntry, Session};
use crate::setup::Setup;

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
    results: Vec<ResultEntry>,
    /// Names of the files that a result gives.
    files: [&'static str; 10],
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
    problem: Option<Problem>,
}

/// The campaign.toml of the session.
#[derive(Debug, Default, Serialize)]
struct CampaignView {
    /// Its text, with comments; what is missing stands there as a comment.
    text: String,
    /// Whether a campaign.toml was given, so that nothing else is said about the logs.
    given: bool,
    /// What was taken from the log: each line with the reason.
    taken: Vec<[String; 2]>,
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
        let campaign = campaign(app, &session, first);
        let views = logs.iter().map(|(log, read)| LogView {
            id: log.id,
            name: log.name.clone(),
            kind: log.kind,
            used: log.kind != FileKind::Log || !session.setup.left_out.contains(&log.id),
            log: read.as_ref().and_then(|read| inspected(read.as_ref().ok()?)),
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
            results: session.results.clone(),
            files: exports::FILES,
        }
    }
}

fn inspected(log: &Arc<Inspection>) -> Option<InspectedLogEntry> {
    InspectionFile::of(std::slice::from_ref(&**log)).logs.pop()
}

fn campaign(app: &App, session: &Session, first: Option<&Arc<Inspection>>) -> CampaignView {
    if let Some(given) = session.campaign() {
        let text = app.path(given).and_then(|path| Ok(std::fs::read_to_string(path)?));
        return match text {
            Ok(text) => CampaignView { text, given: true, ..CampaignView::default() },
            Err(problem) => {
                CampaignView { given: true, problems: vec![problem], ..CampaignView::default() }
            }
        };
    }
    let Some(first) = first else { return CampaignView::default() };
    let draft = || {
        let said = session.description(first)?;
        let files: Vec<_> = session.used_logs().map(LogEntry::file).collect();
        CampaignDraft::new(first, &files, &said)
            .map_err(lissom_io::Error::from)
            .map_err(Problem::from)
    };
    match draft() {
        Ok(draft) => CampaignView {
            text: draft.commented(),
            given: false,
            taken: draft.taken().map(|(line, why)| [line.to_owned(), why.to_owned()]).collect(),
            problems: draft
                .missing()
                .map(|error| Problem::input(error.to_string(), None))
                .collect(),
        },
        Err(problem) => CampaignView { problems: vec![problem], ..CampaignView::default() },
    }
}
