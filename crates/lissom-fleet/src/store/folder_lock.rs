//! The lock of a folder that one run writes into.

use std::collections::HashSet;
use std::fs::{File, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use lissom_io::WriteError;

use crate::fleet_error::FleetError;

/// File that is locked while a run writes.
const LOCK: &str = ".lock";

/// Folders that runs of this process write into.
static WRITTEN: Mutex<Option<HashSet<PathBuf>>> = Mutex::new(None);

/// A folder that no other run writes into, of this process or another one, as long as this lives.
///
/// Where there are locks that only this process has, as on Unix, they are used: a lock that belongs to an open file would
/// also be had by processes that are started meanwhile, such as those of a `multiprocessing` pool, and would outlive a run
/// that is killed. Such a lock does not tell two runs of one process apart; a list of folders does.
#[derive(Debug)]
pub(super) struct FolderLock {
    folder: PathBuf,
    file: Option<File>,
}

impl FolderLock {
    /// Locks a folder.
    pub(super) fn new(folder: &Path) -> Result<Self, FleetError> {
        let path = folder.join(LOCK);
        let failed = |source| WriteError::File { file: path.display().to_string(), source };
        let in_use = || FleetError::InUse { folder: folder.to_owned() };
        let key = folder.canonicalize().map_err(failed)?;
        let mut written = written();
        let folders = written.get_or_insert_default();
        // Closing a file that this process has locked would end the lock: it is not opened twice.
        if folders.contains(&key) {
            return Err(in_use());
        }
        let file = OpenOptions::new()
            .create(true)
            .truncate(false)
            .write(true)
            .open(&path)
            .map_err(failed)?;
        match locked(&file) {
            Ok(true) => {}
            Ok(false) => return Err(in_use()),
            // A file system without locks: one run at a time is up to the user.
            Err(error) if error.kind() == io::ErrorKind::Unsupported => {}
            Err(source) => return Err(failed(source).into()),
        }
        folders.insert(key.clone());
        Ok(Self { folder: key, file: Some(file) })
    }
}

impl Drop for FolderLock {
    fn drop(&mut self) {
        let mut written = written();
        // The lock ends before another run can take it.
        drop(self.file.take());
        if let Some(folders) = written.as_mut() {
            folders.remove(&self.folder);
        }
    }
}

fn written() -> MutexGuard<'static, Option<HashSet<PathBuf>>> {
    WRITTEN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Locks a file if no other process has locked it.
#[cfg(unix)]
fn locked(file: &File) -> io::Result<bool> {
    use rustix::fs::{FlockOperation, fcntl_lock};
    use rustix::io::Errno;
    match fcntl_lock(file, FlockOperation::NonBlockingLockExclusive) {
        Ok(()) => Ok(true),
        Err(Errno::AGAIN | Errno::ACCESS) => Ok(false),
        Err(Errno::NOLCK | Errno::OPNOTSUPP | Errno::NOSYS) => {
            Err(io::ErrorKind::Unsupported.into())
        }
        Err(error) => Err(error.into()),
    }
}

/// Locks a file if no other process has locked it.
#[cfg(not(unix))]
fn locked(file: &File) -> io::Result<bool> {
    use std::fs::TryLockError;
    match file.try_lock() {
        Ok(()) => Ok(true),
        Err(TryLockError::WouldBlock) => Ok(false),
        Err(TryLockError::Error(error)) => Err(error),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_run_of_a_process_at_a_time() {
        let folder = tempfile::tempdir().unwrap();
        let other = tempfile::tempdir().unwrap();
        let lock = FolderLock::new(folder.path()).unwrap();
        let again = || FolderLock::new(&folder.path().join("."));
        assert!(matches!(again(), Err(FleetError::InUse { .. })));
        assert!(FolderLock::new(other.path()).is_ok());
        drop(lock);
        assert!(again().is_ok());
    }
}
