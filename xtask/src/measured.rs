//! Counts the tests of measured logs: those that ran, and those that were skipped because their data were missing.
//!
//! A test of measured logs appends one line to the file given by `LISSOM_MEASURED_LOG`:
//! `measured: ran TEST` or `measured: skipped TEST (REASON)`. Cargo hides what a passing test
//! prints, hence a file.

use std::{
    collections::BTreeSet,
    env, fmt, fs,
    io::{self, ErrorKind},
    path::{Path, PathBuf, absolute},
    process::Command,
};

use crate::step::Failure;

/// The file that the tests append to.
pub(crate) struct Log {
    path: PathBuf,
}

/// The tests listed in the file.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Counts {
    ran: BTreeSet<String>,
    skipped: BTreeSet<String>,
}

impl Log {
    /// An empty log under the workspace's `target`.
    pub(crate) fn start(root: &Path) -> Result<Self, Failure> {
        let folder = root.join("target");
        let log = Self { path: folder.join("measured-log.txt") };
        fs::create_dir_all(&folder).map_err(|source| log.failure(source))?;
        fs::write(&log.path, "").map_err(|source| log.failure(source))?;
        Ok(log)
    }

    /// Passes the path of the log to the tests of a command. A relative `LISSOM_DATA` is relative to the
    /// caller's folder, but tests run in the folder of their package; so they get an absolute path.
    pub(crate) fn pass_to(&self, command: &mut Command) -> Result<(), Failure> {
        let path = absolute(&self.path).map_err(|source| self.failure(source))?;
        command.env("LISSOM_MEASURED_LOG", path);
        if let Some(data) = env::var_os("LISSOM_DATA").filter(|data| !data.is_empty()) {
            let data = absolute(&data).map_err(|source| self.failure(source))?;
            command.env("LISSOM_DATA", data);
        }
        Ok(())
    }

    /// Counts the lines.
    pub(crate) fn read(&self) -> Result<Counts, Failure> {
        match fs::read_to_string(&self.path) {
            Ok(text) => Ok(Counts::parse(&text)),
            Err(error) if error.kind() == ErrorKind::NotFound => Ok(Counts::default()),
            Err(source) => Err(self.failure(source)),
        }
    }

    fn failure(&self, source: io::Error) -> Failure {
        Failure::File { path: self.path.display().to_string(), source }
    }
}

impl Counts {
    /// A test that reads several folders writes several lines and counts once.
    fn parse(text: &str) -> Self {
        let mut counts = Self::default();
        for line in text.lines() {
            if let Some(test) = line.strip_prefix("measured: ran ") {
                counts.ran.insert(test.to_owned());
            } else if let Some(test) = line.strip_prefix("measured: skipped ") {
                counts.skipped.insert(test.to_owned());
            }
        }
        counts
    }
}

impl fmt::Display for Counts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for test in &self.ran {
            writeln!(f, "measured: ran {test}")?;
        }
        for test in &self.skipped {
            writeln!(f, "measured: skipped {test}")?;
        }
        write!(f, "tests of measured logs: {} ran, {} skipped", self.ran.len(), self.skipped.len())
    }
}

#[cfg(test)]
mod tests {
    use super::Counts;

    #[test]
    fn counts_each_test_once() {
        let counts = Counts::parse(
            "measured: ran emps::friction\n\
             measured: ran emps::friction\n\
             measured: ran krauss::modes\n\
             measured: skipped quanser::runs (LISSOM_DATA is not set)\n",
        );
        assert_eq!(
            counts.to_string(),
            "measured: ran emps::friction\n\
             measured: ran krauss::modes\n\
             measured: skipped quanser::runs (LISSOM_DATA is not set)\n\
             tests of measured logs: 2 ran, 1 skipped"
        );
    }

    #[test]
    fn an_empty_log_counts_nothing() {
        assert_eq!(Counts::parse("").to_string(), "tests of measured logs: 0 ran, 0 skipped");
    }
}
