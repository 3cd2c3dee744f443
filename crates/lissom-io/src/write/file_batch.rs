//! Writes several files together or not at all.

use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};

use super::write_error::WriteError;
use super::write_whole::{
    Destination, create_folder, destination, fill_and_sync, fill_stream, part_beside,
};

/// Files that are written under temporary names and get their names when all of them are complete.
///
/// A batch that is dropped leaves nothing behind, not even the folders that it created.
#[derive(Debug, Default)]
pub struct Batch {
    /// Complete files, and the names that they will get.
    parts: Vec<(PathBuf, PathBuf)>,
    /// Contents for devices and pipes.
    streams: Vec<(PathBuf, Vec<u8>)>,
    /// Created folders, outer ones first.
    folders: Vec<PathBuf>,
}

impl Batch {
    /// A batch without files.
    pub fn new() -> Self {
        Self::default()
    }

    /// Creates a folder, and the folders above it, if they do not exist.
    ///
    /// # Errors
    /// [`WriteError::File`] if one cannot be created.
    pub fn folder(&mut self, path: &Path) -> Result<(), WriteError> {
        let absent: Vec<PathBuf> = path
            .ancestors()
            .take_while(|folder| !folder.as_os_str().is_empty() && !folder.exists())
            .map(Path::to_owned)
            .collect();
        self.folders.extend(absent.into_iter().rev());
        create_folder(path)
    }

    /// Checks whether a file can be written at `path`, before work that would be lost otherwise. Leaves nothing behind.
    ///
    /// # Errors
    /// As [`Batch::file`].
    pub fn probe(path: &Path) -> Result<(), WriteError> {
        Self::new().file(path, b"")
    }

    /// Writes a file, which gets its name later.
    ///
    /// # Errors
    /// [`WriteError::File`] if the folder does not exist, cannot be written or is full, or if a folder has the name of
    /// the file.
    pub fn file(&mut self, path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
        let failed = |source| WriteError::File { file: path.display().to_string(), source };
        let path = match destination(path).map_err(failed)? {
            Destination::File(path) => path,
            Destination::Stream => {
                self.streams.push((path.to_owned(), bytes.to_owned()));
                return Ok(());
            }
        };
        let (part, file): (PathBuf, File) = part_beside(&path).map_err(failed)?;
        self.parts.push((part, path));
        fill_and_sync(file, |out: &mut dyn Write| out.write_all(bytes)).map_err(failed)
    }

    /// Gives every file its name.
    ///
    /// # Errors
    /// [`WriteError::File`] if a name cannot be given; files that have their names keep them.
    pub fn commit(mut self) -> Result<(), WriteError> {
        while let Some((part, path)) = self.parts.first() {
            std::fs::rename(part, path)
                .map_err(|source| WriteError::File { file: path.display().to_string(), source })?;
            self.parts.remove(0);
        }
        self.folders.clear();
        for (path, bytes) in &self.streams {
            fill_stream(path, |out| out.write_all(bytes))
                .map_err(|source| WriteError::File { file: path.display().to_string(), source })?;
        }
        Ok(())
    }
}

impl Drop for Batch {
    fn drop(&mut self) {
        // Files that cannot be removed stay: the earlier error is the one to report.
        for (part, _) in &self.parts {
            let _ = std::fs::remove_file(part);
        }
        for folder in self.folders.iter().rev() {
            let _ = std::fs::remove_dir(folder);
        }
    }
}
