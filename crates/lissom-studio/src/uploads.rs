//! Logs that the browser sends: streamed to the disk, within a quota, under names that are names only.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use axum::body::Body;
use http_body_util::BodyExt as _;
use tokio::fs::File;
use tokio::io::AsyncWriteExt as _;

use crate::problem::Problem;

/// Longest name of a file, without a number that makes it unique.
const NAME_BYTES: usize = 120;

/// A name for a file: the last part of what the browser says, without characters that mean something to a system, a terminal
/// or a shell.
pub(crate) fn plain_name(said: &str) -> String {
    let last = said.rsplit(['/', '\\']).next().unwrap_or_default();
    let plain = |c: char| {
        let is_hidden = c.is_control() || ('\u{200b}'..='\u{200f}').contains(&c);
        let is_turned =
            ('\u{202a}'..='\u{202e}').contains(&c) || ('\u{2066}'..='\u{2069}').contains(&c);
        if is_hidden || is_turned || ":*?\"<>|`$".contains(c) { '_' } else { c }
    };
    let name: String = last.chars().map(plain).collect();
    let mut name = name.trim_matches([' ', '.', '-']).to_owned();
    while name.len() > NAME_BYTES {
        name.remove(0);
    }
    if name.is_empty() { "log".to_owned() } else { name }
}

/// A name that no file of the folder has.
fn free_name(folder: &Path, name: &str) -> String {
    let (stem, ending) = name
        .rsplit_once('.')
        .map_or((name, String::new()), |(stem, ending)| (stem, format!(".{ending}")));
    let is_free = |name: &String| folder.join(name).symlink_metadata().is_err();
    let numbered = (2_u64..).map(|k| format!("{stem}-{k}{ending}"));
    std::iter::once(name.to_owned()).chain(numbered).find(is_free).unwrap_or_default()
}

/// Bytes of all files of a folder.
fn size_bytes(folder: &Path) -> io::Result<u64> {
    let mut sum = 0;
    for file in fs::read_dir(folder)? {
        sum += file?.metadata()?.len();
    }
    Ok(sum)
}

/// Writes what the browser sends into the folder, and returns the name of the file. Nothing remains of a file that does not
/// arrive whole or is too large.
pub(crate) async fn receive(
    folder: &Path,
    said: &str,
    body: Body,
    quota_bytes: u64,
) -> Result<String, Problem> {
    let used = size_bytes(folder)?;
    let (part, mut file) = part_file(folder).await?;
    match fill(&mut file, body, quota_bytes.saturating_sub(used), quota_bytes).await {
        Ok(()) => {
            let name = free_name(folder, &plain_name(said));
            fs::rename(&part, folder.join(&name))?;
            Ok(name)
        }
        Err(problem) => {
            drop(file);
            fs::remove_file(&part)?;
            Err(problem)
        }
    }
}

/// A new file for what arrives.
async fn part_file(folder: &Path) -> Result<(PathBuf, File), Problem> {
    for k in 0_u32.. {
        let part = folder.join(format!(".part-{k}"));
        let mut options = File::options();
        options.create_new(true).write(true);
        #[cfg(unix)]
        options.mode(0o600);
        match options.open(&part).await {
            Ok(file) => return Ok((part, file)),
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error.into()),
        }
    }
    Err(Problem::internal("too many files arrive"))
}

async fn fill(file: &mut File, mut body: Body, most: u64, quota: u64) -> Result<(), Problem> {
    let mut written = 0;
    while let Some(frame) = body.frame().await {
        let frame = frame.map_err(|_| Problem::input("the file did not arrive whole", None))?;
        let Ok(bytes) = frame.into_data() else { continue };
        written += bytes.len() as u64;
        if written > most {
            let mb = quota / 1_000_000;
            return Err(Problem::input(
                format!("the files of this session would take more than {mb} MB"),
                Some("remove logs, or start the command with the file as its argument: it is then read where it is".to_owned()),
            ));
        }
        file.write_all(&bytes).await?;
    }
    file.flush().await?;
    Ok(())
}

/// Removes what did not arrive whole, or was not added, before the program ended: all files that are not `known`.
pub(crate) fn clean(folder: &Path, known: impl Fn(&str) -> bool) -> io::Result<()> {
    for file in fs::read_dir(folder)? {
        let file = file?;
        if !known(&file.file_name().to_string_lossy()) && !file.file_type()?.is_dir() {
            fs::remove_file(file.path())?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_only_names() {
        for (said, name) in [
            ("log.csv", "log.csv"),
            ("../../etc/passwd", "passwd"),
            ("C:\\logs\\a b.csv", "a b.csv"),
            ("..", "log"),
            ("", "log"),
            ("/", "log"),
            (".ssh", "ssh"),
            ("-rf.csv", "rf.csv"),
            ("a\u{1b}[31m.csv", "a_[31m.csv"),
            ("x\u{202e}vsc.exe", "x_vsc.exe"),
            ("$(rm).csv", "_(rm).csv"),
            ("Größe.csv", "Größe.csv"),
        ] {
            assert_eq!(plain_name(said), name, "{said}");
        }
        assert!(plain_name(&"ü".repeat(500)).len() <= NAME_BYTES);
    }

    #[test]
    fn only_known_files_stay() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["a.csv", "b.csv", ".part-0"] {
            fs::write(folder.path().join(name), "x").unwrap();
        }
        clean(folder.path(), |name| name == "a.csv").unwrap();
        assert!(folder.path().join("a.csv").is_file());
        assert_eq!(size_bytes(folder.path()).unwrap(), 1);
    }

    #[test]
    fn a_name_that_is_taken_gets_a_number() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("a.csv"), "x").unwrap();
        fs::write(folder.path().join("a-2.csv"), "x").unwrap();
        assert_eq!(free_name(folder.path(), "a.csv"), "a-3.csv");
        assert_eq!(free_name(folder.path(), "b"), "b");
        assert_eq!(size_bytes(folder.path()).unwrap(), 2);
    }
}
