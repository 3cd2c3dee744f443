//! Lists the logs of a fleet: files, folders, or a table of logs.

use std::collections::HashSet;
use std::fs;
use std::io::Read;
use std::path::{Component, Path, PathBuf};

use lissom_io::limits::PathPattern;
use lissom_io::log::LogPath;

use crate::fleet_error::FleetError;
use crate::fleet_log::FleetLog;
use crate::log_time::time_us;
use crate::store::MANIFEST;

/// Names in a pattern, and columns of a table.
const MACHINE: &str = "machine";
const TIME: &str = "time";
const LOG: &str = "log";

/// What the end of a log's path says, as in `{machine}/{time}.csv`.
#[derive(Debug, Clone)]
pub struct LogPattern {
    text: String,
    pattern: PathPattern,
}

impl LogPattern {
    /// Reads a pattern with the names `machine`, `time` or both in braces. Other names stand for any text.
    ///
    /// # Errors
    /// [`FleetError::Pattern`] if it is not one.
    pub fn new(pattern: &str) -> Result<Self, FleetError> {
        let wrong = |problem: String| FleetError::Pattern { pattern: pattern.to_owned(), problem };
        let read = PathPattern::parse(pattern)
            .map_err(|expected| wrong(format!("it needs {expected}")))?;
        if !pattern.contains("{machine}") && !pattern.contains("{time}") {
            return Err(wrong("it has neither {machine} nor {time}".to_owned()));
        }
        Ok(Self { text: pattern.to_owned(), pattern: read })
    }

    /// Whether a path ends like the pattern.
    pub fn fits(&self, path: &Path) -> bool {
        self.pattern.read(&path.display().to_string()).is_some()
    }

    /// Adds what the name of a log says.
    ///
    /// # Errors
    /// [`FleetError::NotLikePattern`] if it does not have this form, [`FleetError::Time`] if its time is not one.
    pub fn read(&self, log: &mut FleetLog) -> Result<(), FleetError> {
        let Some(mut found) = self.pattern.read(&log.log) else {
            return Err(FleetError::NotLikePattern {
                log: log.log.clone(),
                pattern: self.text.clone(),
            });
        };
        if let Some(machine) = found.remove(MACHINE) {
            log.machine = Some(machine);
        }
        if let Some(text) = found.remove(TIME) {
            log.time_us = Some(time(&log.log, text)?);
        }
        Ok(())
    }
}

fn time(log: &str, text: String) -> Result<i64, FleetError> {
    time_us(&text).ok_or_else(|| FleetError::Time { log: log.to_owned(), text })
}

/// The folders that have files of the campaign's runs, as `run_files` of the settings gives them, in the order of the files. A
/// file counts for one of the runs: the one whose name has the most folders.
pub fn folders_with(files: &[PathBuf], run_files: &[String]) -> Vec<PathBuf> {
    let depths: Vec<(&Path, usize)> =
        run_files.iter().map(Path::new).map(|run| (run, run.components().count())).collect();
    let mut seen = HashSet::new();
    let folder = |file: &PathBuf| {
        let of_file = depths.iter().filter(|(run, _)| file.ends_with(run));
        let (_, depth) = of_file.max_by_key(|(_, depth)| depth)?;
        let folder = file.ancestors().nth(*depth)?.to_owned();
        seen.insert(folder.clone()).then_some(folder)
    };
    files.iter().filter_map(folder).collect()
}

/// Logs of paths.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ListedLogs {
    /// The logs.
    pub logs: Vec<FleetLog>,
    /// Number of files below folders, or of folders that are logs, that are left out because they do not end like the pattern.
    pub unlike: usize,
    /// Number of links to folders, devices and pipes below folders, which are left out.
    pub special: usize,
}

/// The logs below folders, in the order of their names, and files as they are given. Below folders, files and folders whose
/// name begins with a dot are left out, links to folders, devices and pipes, what is in `except`, and files that do not end like
/// the pattern. With `run_files`, each folder that has some of them is a log ([`folders_with`]), and all paths are folders. A log
/// that is given twice is one log.
///
/// # Errors
/// [`FleetError::Read`] if a path does not exist or a folder cannot be read, [`FleetError::NoLogs`] or [`FleetError::Runs`] if
/// there are none, [`FleetError::LogsFolder`] if a folder is in `except`, and what [`LogPattern::read`] reports.
pub fn logs_of_paths(
    paths: &[PathBuf],
    pattern: Option<&LogPattern>,
    except: &[&Path],
    run_files: Option<&[String]>,
) -> Result<ListedLogs, FleetError> {
    let (mut files, mut unlike, mut special) = (Vec::new(), 0, 0);
    let except: Vec<PathBuf> = except.iter().filter_map(|path| path.canonicalize().ok()).collect();
    for path in paths {
        if path.is_dir() || run_files.is_some() {
            let failed = |source| FleetError::Read { path: path.clone(), source };
            if except.contains(&path.canonicalize().map_err(failed)?) {
                return Err(FleetError::LogsFolder { folder: path.clone() });
            }
            let mut found = Vec::new();
            below(&std::path::absolute(path).map_err(failed)?, &except, &mut found, &mut special)?;
            if let Some(run_files) = run_files {
                found = folders_with(&found, run_files);
            }
            let all = found.len();
            found.retain(|file| pattern.is_none_or(|pattern| pattern.fits(file)));
            unlike += all - found.len();
            files.append(&mut found);
        } else if path.exists() || LogPath::of(path).group.is_some() {
            files.push(path.clone());
        } else {
            let failed = |source| FleetError::Read { path: path.clone(), source };
            path.metadata().map_err(failed)?;
        }
    }
    if files.is_empty() {
        let places: Vec<String> = paths.iter().map(|path| path.display().to_string()).collect();
        let place = places.join(", ");
        return Err(match (pattern, run_files) {
            (Some(pattern), _) if unlike > 0 => FleetError::NoneLikePattern {
                place,
                count: unlike,
                kind: if run_files.is_some() { "folders" } else { "files" },
                pattern: pattern.text.clone(),
            },
            (_, Some(run_files)) => FleetError::no_folder(place, run_files),
            _ => FleetError::NoLogs { place },
        });
    }
    let mut seen = HashSet::new();
    let mut logs = Vec::with_capacity(files.len());
    for file in files {
        let mut log = FleetLog::new(name(&file)?);
        if !seen.insert(log.log.clone()) {
            continue;
        }
        if let Some(pattern) = pattern {
            pattern.read(&mut log)?;
        }
        logs.push(log);
    }
    Ok(ListedLogs { logs, unlike, special })
}

/// The name of a log: its path from the root, so that it is the same from every folder. Links keep their names.
fn name(file: &Path) -> Result<String, FleetError> {
    let failed = |source| FleetError::Read { path: file.to_owned(), source };
    let path = std::path::absolute(file).map_err(failed)?;
    let parts: Vec<Component<'_>> = path.components().collect();
    let up = parts.iter().rposition(|part| *part == Component::ParentDir);
    let path = match up {
        Some(up) => {
            let above: PathBuf = parts[..=up].iter().collect();
            let rest: PathBuf = parts[up + 1..].iter().collect();
            above.canonicalize().map_err(failed)?.join(rest)
        }
        None => path,
    };
    path.to_str().map(str::to_owned).ok_or_else(|| FleetError::Name { path: file.to_owned() })
}

/// Adds the files below a folder, and the number of links to folders, devices and pipes.
fn below(
    folder: &Path,
    except: &[PathBuf],
    files: &mut Vec<PathBuf>,
    special: &mut usize,
) -> Result<(), FleetError> {
    let failed = |source| FleetError::Read { path: folder.to_owned(), source };
    let mut entries =
        fs::read_dir(folder).and_then(Iterator::collect::<Result<Vec<_>, _>>).map_err(failed)?;
    entries.sort_by_key(fs::DirEntry::file_name);
    for entry in entries {
        let (path, kind) = (entry.path(), entry.file_type().map_err(failed)?);
        let is_left_out = || path.canonicalize().is_ok_and(|path| except.contains(&path));
        if entry.file_name().to_string_lossy().starts_with('.') || is_left_out() {
            continue;
        }
        if kind.is_dir() {
            // The rows of a fleet are no logs.
            if !path.join(MANIFEST).is_file() {
                below(&path, except, files, special)?;
            }
        } else if kind.is_file() || path.is_file() {
            files.push(path);
        } else {
            *special += 1;
        }
    }
    Ok(())
}

/// The logs of a table, CSV with a column `log` and, if they are known, `machine` and `time`. Paths are relative to
/// `folder`; names of logs are paths from the root.
///
/// # Errors
/// [`FleetError::Table`] if a row or column is wrong, [`FleetError::NoLogs`] if it has no rows.
pub fn logs_of_table(
    table_name: &str,
    table: impl Read,
    folder: &Path,
) -> Result<Vec<FleetLog>, FleetError> {
    let wrong = |place: String, problem: String| FleetError::Table {
        file: format!("{table_name}{place}"),
        problem,
    };
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(table);
    let header = reader.headers().map_err(|e| wrong(String::new(), e.to_string()))?.clone();
    let column =
        |wanted: &str| header.iter().position(|name| name.trim_start_matches('\u{feff}') == wanted);
    let Some(of_log) = column(LOG) else {
        let columns: Vec<&str> = header.iter().collect();
        let problem = format!("there is no column \"{LOG}\"; it has {}", columns.join(", "));
        return Err(wrong(String::new(), problem));
    };
    let (of_machine, of_time) = (column(MACHINE), column(TIME));
    let (mut logs, mut seen) = (Vec::new(), HashSet::new());
    for record in reader.records() {
        let record = record.map_err(|e| wrong(String::new(), e.to_string()))?;
        let row = || format!(", row {}", record.position().map_or(0, csv::Position::line));
        let cell =
            |column: Option<usize>| column.and_then(|c| record.get(c)).filter(|c| !c.is_empty());
        let Some(log) = cell(Some(of_log)) else {
            return Err(wrong(row(), "the log has no name".to_owned()));
        };
        let log = name(&folder.join(log))?;
        if !seen.insert(log.clone()) {
            return Err(wrong(row(), format!("{log} is listed twice")));
        }
        let time = cell(of_time).map(|text| {
            let problem = || wrong(row(), format!("\"{text}\" is not a time"));
            time_us(text).ok_or_else(problem)
        });
        logs.push(FleetLog {
            log,
            file: None,
            machine: cell(of_machine).map(str::to_owned),
            time_us: time.transpose()?,
        });
    }
    if logs.is_empty() {
        Err(FleetError::NoLogs { place: table_name.to_owned() })
    } else {
        Ok(logs)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_patterns_and_tables() {
        let folder = tempfile::tempdir().unwrap();
        for (machine, day) in [("m2", "2026-02-01"), ("m1", "2026-01-01"), ("m1", "2026-01-02")] {
            fs::create_dir_all(folder.path().join(machine)).unwrap();
            fs::write(folder.path().join(machine).join(format!("{day}.csv")), "").unwrap();
        }
        fs::write(folder.path().join("m1/.hidden"), "").unwrap();
        let pattern = LogPattern::new("{machine}/{time}.csv").unwrap();
        let paths = [folder.path().to_owned(), folder.path().join("m1/2026-01-02.csv")];
        let logs = logs_of_paths(&paths, Some(&pattern), &[], None).unwrap().logs;
        let machines: Vec<_> = logs.iter().map(|log| log.machine.as_deref().unwrap()).collect();
        assert_eq!(machines, ["m1", "m1", "m2"]);
        assert!(logs[0].time_us < logs[1].time_us && logs[1].time_us < logs[2].time_us);
        // The same log has the same name, however its path is written.
        let other = folder.path().join("m2/../m1/./2026-01-02.csv");
        let again = logs_of_paths(&[other], None, &[], None).unwrap().logs;
        assert_eq!(again[0].log, logs[1].log);
        let none = LogPattern::new("{machine}/{time}.mat").unwrap();
        let error = logs_of_paths(&paths[..1], Some(&none), &[], None).unwrap_err().to_string();
        assert!(error.ends_with(": none of 3 files ends like \"{machine}/{time}.mat\""), "{error}");

        fs::write(folder.path().join("m1/notes.txt"), "").unwrap();
        let found = logs_of_paths(&paths, Some(&pattern), &[], None).unwrap();
        assert_eq!((found.logs.len(), found.unlike), (3, 1));
        let notes = folder.path().join("m1/notes.txt");
        let error = logs_of_paths(std::slice::from_ref(&notes), Some(&pattern), &[], None)
            .unwrap_err()
            .to_string();
        assert!(
            error.ends_with("notes.txt: the path does not end like \"{machine}/{time}.csv\""),
            "{error}"
        );

        assert_eq!(logs_of_paths(&paths, None, &[&notes], None).unwrap().logs.len(), 3);

        let into = logs_of_paths(&paths[..1], None, &[folder.path()], None).unwrap_err();
        assert!(matches!(into, FleetError::LogsFolder { .. }), "{into}");

        let table = "log,machine,time\nm1/2026-01-01.csv,A,2026-01-01\n\"b,1.csv\",,\n";
        let logs = logs_of_table("table", table.as_bytes(), folder.path()).unwrap();
        assert_eq!(logs[0].path(), folder.path().join("m1/2026-01-01.csv"));
        assert!(logs[1].log.ends_with("/b,1.csv") && logs[1].machine.is_none());
        for (table, problem) in [
            ("file\na.csv\n", "table: there is no column \"log\"; it has file"),
            ("log\n/a\n/./a\n", "table, row 3: /a is listed twice"),
            ("log,time\na,yesterday\n", "table, row 2: \"yesterday\" is not a time"),
            ("log\n", "table: there are no logs"),
        ] {
            let error = logs_of_table("table", table.as_bytes(), Path::new("")).unwrap_err();
            assert_eq!(error.to_string(), problem);
        }
    }

    #[test]
    fn folders_of_runs() {
        let folder = tempfile::tempdir().unwrap();
        let runs = ["run.csv", "slow/run.csv"].map(str::to_owned);
        for file in ["m1/1/run.csv", "m1/1/slow/run.csv", "m1/2/slow/run.csv", "m2/3/run.csv"] {
            let file = folder.path().join(file);
            fs::create_dir_all(file.parent().unwrap()).unwrap();
            fs::write(file, "").unwrap();
        }
        fs::create_dir(folder.path().join("m2/empty")).unwrap();
        let pattern = LogPattern::new("{machine}/{time_of_day}").unwrap();
        let list = |path: &str, pattern: Option<&LogPattern>, runs: &[String]| {
            logs_of_paths(&[folder.path().join(path)], pattern, &[], Some(runs))
        };
        let found = list("", Some(&pattern), &runs).unwrap();
        let names: Vec<_> = found.logs.iter().map(|log| Path::new(&log.log)).collect();
        assert_eq!(names, ["m1/1", "m1/2", "m2/3"].map(|name| folder.path().join(name)));
        assert_eq!(found.logs[2].machine.as_deref(), Some("m2"));
        assert_eq!(list("m1", Some(&pattern), &runs).unwrap().logs.len(), 2);
        let of_m2 = LogPattern::new("m2/{machine}").unwrap();
        let found = list("", Some(&of_m2), &runs).unwrap();
        assert_eq!((found.logs.len(), found.unlike), (1, 2));
        let other = LogPattern::new("axis{machine}").unwrap();
        let error = list("", Some(&other), &runs).unwrap_err().to_string();
        assert!(error.ends_with("none of 3 folders ends like \"axis{machine}\""), "{error}");
        let none = list("", None, &["chirp.csv".to_owned()]).unwrap_err().to_string();
        assert!(none.ends_with("no folder has files of the runs: chirp.csv"), "{none}");
        assert!(matches!(list("m1/1/run.csv", None, &runs), Err(FleetError::Read { .. })));
        // Addresses, too.
        let files = ["s3://b/m1/1/run.csv", "s3://b/m1/1/slow/run.csv"].map(PathBuf::from);
        assert_eq!(folders_with(&files, &runs), [PathBuf::from("s3://b/m1/1")]);
    }

    #[test]
    #[cfg(unix)]
    fn links_to_folders_and_sockets_are_counted() {
        use std::os::unix::{fs::symlink, net::UnixListener};

        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("a.csv"), "").unwrap();
        symlink("a.csv", folder.path().join("b.csv")).unwrap();
        symlink("none", folder.path().join("broken")).unwrap();
        symlink(".", folder.path().join("again")).unwrap();
        let _socket = UnixListener::bind(folder.path().join("socket")).unwrap();
        let found = logs_of_paths(&[folder.path().to_owned()], None, &[], None).unwrap();
        assert_eq!((found.logs.len(), found.special), (2, 3));
    }
}
