//! The state of the running application.

use std::fs::File;
use std::io::{self, BufRead as _, BufReader};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use lissom_formats::ReadOptions;
use lissom_io::inspect::Inspection;

use crate::access::Access;
use crate::job::Job;
use crate::log_cache::{CachedLog, LogCache};
use crate::planning::Planned;
use crate::problem::Problem;
use crate::session::{FileKind, LogEntry, Session};
use crate::setup::Setup;
use crate::state_folder::StateFolder;

/// What all requests share.
pub(crate) type Shared = Arc<App>;

/// The running application.
#[derive(Debug)]
pub(crate) struct App {
    pub(crate) access: Access,
    pub(crate) folder: StateFolder,
    session: Mutex<Session>,
    pub(crate) cache: LogCache,
    job: Mutex<Option<Arc<Job>>>,
    /// The plan that was made last.
    planned: Mutex<Option<Planned>>,
    pub(crate) port: u16,
    /// Most bytes of all uploads together.
    pub(crate) quota_bytes: u64,
}

impl App {
    pub(crate) fn new(folder: StateFolder, session: Session, port: u16, quota_bytes: u64) -> Self {
        Self {
            access: Access::default(),
            folder,
            session: Mutex::new(session),
            cache: LogCache::default(),
            job: Mutex::new(None),
            planned: Mutex::new(None),
            port,
            quota_bytes,
        }
    }

    /// A copy of the session as it is now.
    pub(crate) fn session(&self) -> Session {
        self.locked().clone()
    }

    /// The same for a page that knows the session as it is.
    pub(crate) fn known(&self, revision: u64) -> Result<Session, Problem> {
        self.locked().known(revision)
    }

    fn locked(&self) -> MutexGuard<'_, Session> {
        self.session.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Changes logs or setup, if the page knows the session as it is.
    pub(crate) fn change<T>(
        &self,
        revision: u64,
        change: impl FnOnce(&mut Session) -> Result<T, Problem>,
    ) -> Result<T, Problem> {
        let mut session = self.locked();
        let mut changed = session.known(revision)?;
        let made = change(&mut changed)?;
        changed.revision += 1;
        self.folder.write(&changed)?;
        *session = changed;
        Ok(made)
    }

    /// Adds or removes what no page edits: results, and files that arrive.
    pub(crate) fn amend<T>(&self, amend: impl FnOnce(&mut Session) -> T) -> Result<T, Problem> {
        let mut session = self.locked();
        let mut changed = session.clone();
        let made = amend(&mut changed);
        self.folder.write(&changed)?;
        *session = changed;
        Ok(made)
    }

    /// Adds a file. Of the first log it is guessed what its channels are. A log that cannot be read is refused, or with
    /// `even_unreadable` added, so that the page shows what is wrong.
    pub(crate) fn add(&self, log: LogEntry, even_unreadable: bool) -> Result<(), Problem> {
        let session = self.session();
        if log.kind == FileKind::Campaign && session.campaign().is_some() {
            return Err(Problem::conflict(
                "there is a description of the logs already",
                "remove it first: a session has one campaign.toml",
            ));
        }
        // Files that are given are used as they are: the identification reports runs that repeat others.
        if let Some(same) = self.same_file(&session, &log)?.filter(|_| !even_unreadable) {
            let error = format!("{} is the same file as {same}, which is there already", log.name);
            return Err(Problem::input(error, None));
        }
        let guessed = match log.kind {
            FileKind::Log => match self.inspection(&session, &log) {
                Ok(found) => Some(Setup::guessed(&found)),
                Err(_) if even_unreadable => None,
                Err(problem) => return Err(problem),
            },
            FileKind::Campaign | FileKind::Other => None,
        };
        self.amend(|session| {
            let is_first = session.used_logs().next().is_none();
            if let Some(guessed) = guessed.filter(|_| is_first && session.setup == Setup::default())
            {
                session.setup = guessed;
            }
            session.logs.push(log);
            session.revision += 1;
        })
    }

    /// Name of a log of the session with the same content as a new one: as two runs it would count twice.
    fn same_file(&self, session: &Session, new: &LogEntry) -> Result<Option<String>, Problem> {
        let path = self.path(new)?;
        for log in session.logs.iter().filter(|log| log.kind == FileKind::Log) {
            // What is not there any more is reported when it is read.
            if self.path(log).is_ok_and(|other| have_same_content(&path, &other).unwrap_or(false)) {
                return Ok(Some(log.name.clone()));
            }
        }
        Ok(None)
    }

    /// The job that runs, or the last one.
    pub(crate) fn job(&self) -> Option<Arc<Job>> {
        self.job.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Takes a job as the one that runs, if none does.
    pub(crate) fn begin(&self, job: &Arc<Job>) -> Result<(), Problem> {
        let mut running = self.job.lock().unwrap_or_else(PoisonError::into_inner);
        if running.as_ref().is_some_and(|job| !job.is_finished()) {
            return Err(Problem::conflict(
                "an identification runs already",
                "wait for it, or stop it; one runs at a time",
            ));
        }
        *running = Some(Arc::clone(job));
        Ok(())
    }

    /// Keeps a plan.
    pub(crate) fn keep_plan(&self, planned: Planned) {
        *self.planned.lock().unwrap_or_else(PoisonError::into_inner) = Some(planned);
    }

    /// The plan that was made last.
    pub(crate) fn planned(&self) -> Option<Planned> {
        self.planned.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Where a file of the session is. Files of the folder that are not plain files are refused: it has no links.
    pub(crate) fn path(&self, log: &LogEntry) -> Result<PathBuf, Problem> {
        if let Some(path) = &log.path {
            return Ok(path.clone());
        }
        let path = self.folder.logs().join(&log.name);
        let is_file = path.symlink_metadata().is_ok_and(|known| known.is_file());
        if is_file { Ok(path) } else { Err(Problem::not_found("log")) }
    }

    /// A log of the session, read as its setup says.
    pub(crate) fn log(&self, session: &Session, log: &LogEntry) -> Result<Arc<CachedLog>, Problem> {
        self.cache.log(log.id, &log.at(&self.path(log)?), &log.title(), options(session))
    }

    /// Refuses a setup with which a log cannot be read that can be read now.
    pub(crate) fn check_reading(&self, setup: &Setup) -> Result<(), Problem> {
        let session = self.session();
        let mut wanted = session.clone();
        wanted.setup.clone_from(setup);
        if options(&wanted) == options(&session) {
            return Ok(());
        }
        for log in session.logs.iter().filter(|log| log.kind == FileKind::Log) {
            if let Err(problem) = self.inspection(&wanted, log)
                && self.inspection(&session, log).is_ok()
            {
                return Err(problem);
            }
        }
        Ok(())
    }

    /// What is in a log of the session.
    pub(crate) fn inspection(
        &self,
        session: &Session,
        log: &LogEntry,
    ) -> Result<Arc<Inspection>, Problem> {
        self.cache.inspection(log.id, &log.at(&self.path(log)?), &log.title(), options(session))
    }
}

/// Whether two files have the same bytes.
fn have_same_content(a: &Path, b: &Path) -> io::Result<bool> {
    let (a, b) = (File::open(a)?, File::open(b)?);
    if !a.metadata()?.is_file() || a.metadata()?.len() != b.metadata()?.len() {
        return Ok(false);
    }
    let (mut a, mut b) = (BufReader::new(a), BufReader::new(b));
    loop {
        let (left, right) = (a.fill_buf()?, b.fill_buf()?);
        let both = left.len().min(right.len());
        if left[..both] != right[..both] {
            return Ok(false);
        }
        if both == 0 {
            return Ok(true);
        }
        a.consume(both);
        b.consume(both);
    }
}

/// How the logs of a session are read.
fn options(session: &Session) -> ReadOptions {
    ReadOptions {
        header_row: session.setup.header_row,
        skip_rows: session.setup.skip_rows,
        ..ReadOptions::default()
    }
}
