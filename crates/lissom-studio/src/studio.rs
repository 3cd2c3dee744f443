//! The application: opened, then run.

use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::net::{Ipv4Addr, TcpListener};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use etcetera::BaseStrategy as _;
use sha2::{Digest as _, Sha256};

use crate::access::hex;
use crate::app::{App, Shared};
use crate::opener;
use crate::problem::Problem;
use crate::routes;
use crate::session::{FileKind, LogEntry, Session};
use crate::state_folder::StateFolder;
use crate::studio_error::StudioError;
use crate::uploads;

/// Most bytes of logs that the browser sends, if nothing else is said.
const QUOTA_BYTES: u64 = 8 << 30;

/// How the application is started.
#[derive(Debug, Clone, Default)]
#[non_exhaustive]
pub struct StudioOptions {
    /// Logs, or a campaign.toml, that are read where they are.
    pub logs: Vec<PathBuf>,
    /// The folder of the state; one for these logs in the user's own folder for states if absent.
    pub folder: Option<PathBuf>,
    /// The port; a free one if absent.
    pub port: Option<u16>,
    /// Most bytes of all logs that the browser sends \[B\]; 8 GiB if absent.
    pub quota_bytes: Option<u64>,
}

/// The application, ready to serve: its state is locked and its port is taken.
#[derive(Debug)]
pub struct Studio {
    app: Shared,
    listener: TcpListener,
    address: String,
    opener: PathBuf,
}

impl Studio {
    /// Locks the folder of the state, and listens on the loopback interface.
    ///
    /// # Errors
    /// [`StudioError`] if a log is not there, or if the folder or the port cannot be used.
    pub fn open(options: &StudioOptions) -> Result<Self, StudioError> {
        let logs = given(&options.logs)?;
        let folder = match &options.folder {
            Some(folder) => folder.clone(),
            None => own_folder(&logs)?,
        };
        let folder = StateFolder::open(&folder)?;
        let failed = |source| StudioError::Folder { folder: folder.path().to_owned(), source };
        let session = folder.read()?;
        let known =
            |name: &str| session.logs.iter().any(|log| log.path.is_none() && log.name == name);
        uploads::clean(&folder.logs(), known).map_err(failed)?;
        let wanted = options.port.unwrap_or(0);
        let no_port = |source| StudioError::Port { port: wanted, source };
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, wanted)).map_err(no_port)?;
        listener.set_nonblocking(true).map_err(no_port)?;
        let port = listener.local_addr().map_err(no_port)?.port();
        let quota_bytes = options.quota_bytes.unwrap_or(QUOTA_BYTES);
        let app = Arc::new(App::new(folder, session, port, quota_bytes));
        let failed = |problem: Problem| StudioError::Folder {
            folder: app.folder.path().to_owned(),
            source: io::Error::other(problem.error),
        };
        add_given(&app, logs).map_err(failed)?;
        let address = opener::address(port, &app.access.new_token()?);
        let opener = opener::write(app.folder.path(), &address).map_err(|source| {
            StudioError::Folder { folder: app.folder.path().to_owned(), source }
        })?;
        Ok(Self { app, listener, address, opener })
    }

    /// The address of the page; it opens one page.
    pub fn address(&self) -> &str {
        &self.address
    }

    /// A file that only the user can read and that leads a browser to the page. It has a new address for each page.
    pub fn opener(&self) -> &Path {
        &self.opener
    }

    /// Opens the page in the user's browser.
    ///
    /// # Errors
    /// What the system says if it has no browser.
    pub fn open_browser(&self) -> std::io::Result<()> {
        open::that_detached(&self.opener)
    }

    /// Serves until the program ends.
    ///
    /// # Errors
    /// [`StudioError::Ended`] if the system stops it.
    pub fn run(self) -> Result<(), StudioError> {
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build();
        let runtime = runtime.map_err(StudioError::Ended)?;
        runtime
            .block_on(async {
                let listener = tokio::net::TcpListener::from_std(self.listener)?;
                axum::serve(listener, routes::router(self.app)).await
            })
            .map_err(StudioError::Ended)
    }
}

/// The files that are given, with their whole paths.
fn given(logs: &[PathBuf]) -> Result<Vec<(String, PathBuf)>, StudioError> {
    let whole = |log: &PathBuf| {
        let path = log.canonicalize();
        let path = path.map_err(|source| StudioError::Log { file: log.clone(), source })?;
        let name = path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into());
        Ok((name, path))
    };
    logs.iter().map(whole).collect()
}

/// The folder of the state for these logs: the same logs find their state again.
fn own_folder(logs: &[(String, PathBuf)]) -> Result<PathBuf, StudioError> {
    let places = etcetera::choose_base_strategy().map_err(|_| StudioError::NoFolder)?;
    let all = places.state_dir().unwrap_or_else(|| places.data_dir());
    let all = all.join("lissom").join("studio");
    fs::create_dir_all(&all)
        .map_err(|source| StudioError::Folder { folder: all.clone(), source })?;
    let Some((name, _)) = logs.first() else { return Ok(all.join("session")) };
    let mut digest = Sha256::new();
    for (_, path) in logs {
        digest.update(path.as_os_str().as_encoded_bytes());
        digest.update([0]);
    }
    let digest = hex(&digest.finalize()[..8]);
    Ok(all.join(format!("{}-{digest}", uploads::plain_name(name))))
}

/// Adds files that are not in the session yet. The first log is read to guess what its channels are.
fn add_given(app: &App, logs: Vec<(String, PathBuf)>) -> Result<(), Problem> {
    let known = app.session();
    let is_new = |(_, path): &(String, PathBuf)| {
        !known.logs.iter().any(|log| log.path.as_ref() == Some(path))
    };
    let mut given = BTreeSet::new();
    for (name, path) in logs.into_iter().filter(is_new) {
        if !given.insert(path.clone()) {
            continue;
        }
        let kind = FileKind::of(&path);
        let id = app.amend(Session::new_log)?;
        app.add(LogEntry::of_file(id, name, Some(path), kind), true)?;
    }
    Ok(())
}
