//! The folder with the state: plain files that only the user can read.
//!
//! ```text
//! session.json        logs, what is said about them, and the list of results
//! logs/               logs that the browser sent
//! results/1/          result.json, campaign.toml and report.html of a result
//! open.html           leads a browser to the page
//! lock                locked while a process uses the folder
//! ```

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use crate::session::Session;
use crate::studio_error::StudioError;

/// The folder, locked for this process.
#[derive(Debug)]
pub(crate) struct StateFolder {
    folder: PathBuf,
    _lock: File,
}

impl StateFolder {
    /// Makes the folder if there is none, and locks it.
    pub(crate) fn open(folder: &Path) -> Result<Self, StudioError> {
        let failed = |source| StudioError::Folder { folder: folder.to_owned(), source };
        if is_foreign(folder) {
            return Err(StudioError::Foreign { folder: folder.to_owned() });
        }
        create_private(folder).map_err(failed)?;
        let folder = folder.canonicalize().map_err(failed)?;
        for inner in ["logs", "results"] {
            create_private(&folder.join(inner)).map_err(failed)?;
        }
        let lock = private(OpenOptions::new().create(true).write(true).truncate(false));
        let lock = lock.open(folder.join("lock")).map_err(failed)?;
        match lock.try_lock() {
            Ok(()) => Ok(Self { folder, _lock: lock }),
            Err(TryLockError::WouldBlock) => Err(StudioError::Locked { folder }),
            Err(TryLockError::Error(source)) => Err(failed(source)),
        }
    }

    pub(crate) fn path(&self) -> &Path {
        &self.folder
    }

    /// Where logs of the browser are.
    pub(crate) fn logs(&self) -> PathBuf {
        self.folder.join("logs")
    }

    /// Where the files of a result are.
    pub(crate) fn result(&self, id: u64) -> PathBuf {
        self.folder.join("results").join(id.to_string())
    }

    /// Reads the session; a new one if there is none.
    pub(crate) fn read(&self) -> Result<Session, StudioError> {
        let file = self.folder.join("session.json");
        let failed = |reason: String| StudioError::State { file: file.clone(), reason };
        match fs::read_to_string(&file) {
            Ok(text) => Session::of_text(&text).map_err(failed),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(Session::default()),
            Err(error) => Err(failed(error.to_string())),
        }
    }

    /// Writes the session: whole, or not at all.
    pub(crate) fn write(&self, session: &Session) -> io::Result<()> {
        let text = serde_json::to_vec_pretty(session)?;
        let new = self.folder.join("session.json.new");
        write_private(&new, &text)?;
        fs::rename(new, self.folder.join("session.json"))
    }
}

/// Whether a folder has files, but not those of a state.
fn is_foreign(folder: &Path) -> bool {
    let has_files = fs::read_dir(folder).is_ok_and(|mut files| files.next().is_some());
    has_files && !folder.join("lock").is_file()
}

/// Writes a file that only the user can read, in place of one of this name.
pub(crate) fn write_private(file: &Path, content: &[u8]) -> io::Result<()> {
    // A link of this name is replaced, not followed.
    match fs::remove_file(file) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
        _ => {}
    }
    let mut made = private(OpenOptions::new().create_new(true).write(true)).open(file)?;
    made.write_all(content)?;
    made.sync_all()
}

/// Makes a folder that only the user can read; an existing one becomes so.
pub(crate) fn create_private(folder: &Path) -> io::Result<()> {
    let mut builder = fs::DirBuilder::new();
    builder.recursive(true);
    #[cfg(unix)]
    std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
    builder.create(folder)?;
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        fs::set_permissions(folder, fs::Permissions::from_mode(0o700))?;
    }
    Ok(())
}

/// Options with which a file that is made can be read only by the user.
fn private(options: &mut OpenOptions) -> OpenOptions {
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(options, 0o600);
    options.clone()
}
