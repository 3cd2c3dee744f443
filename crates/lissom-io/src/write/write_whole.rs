//! Writes one file completely or not at all.

use std::fs::{File, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use super::write_error::WriteError;

/// Writes a file completely or not at all: into a new file in the same folder, which then gets its name. On an error
/// the file keeps its former content, or does not exist.
///
/// # Errors
/// [`WriteError::File`] if the folder does not exist, cannot be written or is full, or if `fill` fails.
pub fn write_whole(
    path: &Path,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), WriteError> {
    let failed = |source| WriteError::File { file: path.display().to_string(), source };
    let path = match destination(path).map_err(failed)? {
        Destination::File(path) => path,
        Destination::Stream => return fill_stream(path, fill).map_err(failed),
    };
    let (part, file) = part_beside(&path).map_err(failed)?;
    let written = fill_and_sync(file, fill).and_then(|()| std::fs::rename(&part, &path));
    if written.is_err() {
        // Only the first error is reported.
        let _ = std::fs::remove_file(&part);
    }
    written.map_err(failed)
}

/// Creates a folder, and the folders above it, if they do not exist.
///
/// # Errors
/// [`WriteError::File`] if one cannot be created.
pub fn create_folder(path: &Path) -> Result<(), WriteError> {
    std::fs::create_dir_all(path)
        .map_err(|source| WriteError::File { file: path.display().to_string(), source })
}

/// Removes a file.
///
/// # Errors
/// [`WriteError::File`] if it cannot be removed.
pub fn remove(path: &Path) -> Result<(), WriteError> {
    std::fs::remove_file(path)
        .map_err(|source| WriteError::File { file: path.display().to_string(), source })
}

/// Writes text whole or not at all.
///
/// # Errors
/// As [`write_whole`].
pub fn write_text(path: &Path, text: &str) -> Result<(), WriteError> {
    write_whole(path, |out| out.write_all(text.as_bytes()))
}

/// Writes a value as indented JSON, whole or not at all.
///
/// # Errors
/// As [`write_whole`]; [`WriteError::Json`] for a value that JSON cannot hold.
pub fn write_json(path: &Path, value: &impl serde::Serialize) -> Result<(), WriteError> {
    write_text(path, &json_text(path, value)?)
}

/// A value as indented JSON; `path` is the file it is meant for.
///
/// # Errors
/// [`WriteError::Json`] for a value that JSON cannot hold.
pub fn json_text(path: &Path, value: &impl serde::Serialize) -> Result<String, WriteError> {
    let text = serde_json::to_string_pretty(value)
        .map_err(|source| WriteError::Json { file: path.display().to_string(), source })?;
    Ok(text + "\n")
}

pub(super) fn fill_and_sync(
    file: File,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let mut out = BufWriter::new(file);
    fill(&mut out)?;
    out.into_inner()?.sync_all()
}

/// Where what is written goes.
pub(super) enum Destination {
    /// To a file of this name, a link's own target.
    File(PathBuf),
    /// Into a device or a pipe, which another file must not replace.
    Stream,
}

pub(super) fn destination(path: &Path) -> io::Result<Destination> {
    let Ok(there) = std::fs::metadata(path) else { return Ok(Destination::File(path.to_owned())) };
    if there.is_file() {
        return Ok(Destination::File(std::fs::canonicalize(path)?));
    }
    if there.is_dir() { Err(io::ErrorKind::IsADirectory.into()) } else { Ok(Destination::Stream) }
}

pub(super) fn fill_stream(
    path: &Path,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let mut out = BufWriter::new(OpenOptions::new().write(true).open(path)?);
    fill(&mut out)?;
    out.flush()
}

/// Largest number of temporary names that are tried.
const PARTS_MOST: usize = 10_000;

/// Creates a new file in the folder of `path`.
pub(super) fn part_beside(path: &Path) -> io::Result<(PathBuf, File)> {
    static COUNT: AtomicUsize = AtomicUsize::new(0);
    let Some(name) = path.file_name() else {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "the path has no file name"));
    };
    // A killed process with the same number may have left a file with this name.
    for _ in 0..PARTS_MOST {
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let mut part_name = std::ffi::OsString::from(".");
        part_name.push(name);
        part_name.push(format!(".{}-{number}.part", std::process::id()));
        let part = path.with_file_name(part_name);
        match OpenOptions::new().write(true).create_new(true).open(&part) {
            Ok(file) => return Ok((part, file)),
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
        }
    }
    Err(io::ErrorKind::AlreadyExists.into())
}
