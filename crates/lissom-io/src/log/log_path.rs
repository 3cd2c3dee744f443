//! Where a log is: a file, or a group of channels in a file, written `FILE::GROUP`.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use lissom_formats::{LogData, ReadOptions};

use super::groups::groups;
use super::log_columns::ColumnRef;
use super::log_error::LogError;
use super::other_format::place;

/// Between a file and a group in it.
const SEPARATOR: &str = "::";
/// Stands for the name of the run's log, without its ending, in the name of another log.
const RUN: &str = "{run}";

/// The name of another log of a run, in which `{run}` may stand for the name of the run's log.
pub(crate) fn of_run(name: &str, run: &Path) -> String {
    let run = LogPath::of(run).file;
    name.replace(RUN, &run.file_stem().map_or_else(String::new, |s| s.to_string_lossy().into()))
}

/// Where a log is: `FILE`, or `FILE::GROUP`, in which `*` stands for any text; `FILE::COLUMN=VALUE` are the rows with this
/// value in a column.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LogPath {
    /// The file.
    pub file: PathBuf,
    /// The group of channels in it.
    pub group: Option<String>,
}

/// A part of a file that is a log of its own.
#[derive(Debug, Clone)]
pub struct LogPart {
    /// The file with the part, for messages.
    pub label: String,
    /// What distinguishes the part: a group, or the value of a column of runs, with its name.
    pub name: String,
    /// Its channels, with time stamps.
    pub data: Arc<LogData>,
}

impl LogPath {
    /// Reads `FILE` or `FILE::GROUP`. A file whose name has `::` is a file.
    pub fn of(path: &Path) -> Self {
        let whole = || Self { file: path.to_owned(), group: None };
        if path.exists() {
            return whole();
        }
        let Some(text) = path.to_str() else { return whole() };
        let split = |at: usize| (&text[..at], &text[at + SEPARATOR.len()..]);
        let mut places = text.match_indices(SEPARATOR).map(|(at, _)| split(at));
        let is_file = |(file, group): &(&str, &str)| !group.is_empty() && Path::new(file).exists();
        let found = places.clone().find(is_file).or_else(|| places.next());
        match found {
            Some((file, group)) if !file.is_empty() && !group.is_empty() => {
                Self { file: PathBuf::from(file), group: Some(group.to_owned()) }
            }
            _ => whole(),
        }
    }

    /// The log without the folders of its file.
    pub(crate) fn name(&self) -> String {
        let file =
            self.file.file_name().map_or_else(String::new, |n| n.to_string_lossy().into_owned());
        self.group.as_ref().map_or(file.clone(), |group| format!("{file}{SEPARATOR}{group}"))
    }

    /// Reads the logs: one for each group that fits, or the whole file; at least one.
    ///
    /// # Errors
    /// [`LogError::NoGroup`] if no group fits; others if the file cannot be read.
    pub fn parts(&self, options: &ReadOptions) -> Result<Vec<LogPart>, LogError> {
        self.parts_of(self.read(options)?)
    }

    /// Reads the whole file, with its time stamps as channels.
    ///
    /// # Errors
    /// As [`read_log`](super::read_log), if the file cannot be read.
    pub fn read(&self, options: &ReadOptions) -> Result<Arc<LogData>, LogError> {
        let data = lissom_formats::read_with(&self.file, options)
            .map_err(|error| LogError::of_format(self.file.display().to_string(), error))?;
        Ok(Arc::new(data.with_time_stamps()))
    }

    /// The logs of its file, whose content is `data`.
    ///
    /// # Errors
    /// [`LogError::NoGroup`] if no group fits.
    pub fn parts_of(&self, data: Arc<LogData>) -> Result<Vec<LogPart>, LogError> {
        let file = self.file.display().to_string();
        let Some(group) = &self.group else {
            return Ok(vec![LogPart { label: file, name: String::new(), data }]);
        };
        let mut found = data.groups(group);
        if found.is_empty()
            && let Some((column, value)) = group.split_once('=')
        {
            found = rows_with(&file, &data, column, value)?;
        }
        if found.is_empty() {
            return Err(LogError::NoGroup { file, group: group.clone(), groups: groups(&data) });
        }
        let part = |(name, data): (String, LogData)| LogPart {
            label: format!("{file}{SEPARATOR}{name}"),
            name,
            data: Arc::new(data),
        };
        Ok(found.into_iter().map(part).collect())
    }
}

/// The rows that have this value in a column, as `COLUMN=VALUE`. Where no value is the same text, blanks around it do not
/// count, or else how a number is written.
fn rows_with(
    file: &str,
    data: &LogData,
    column: &str,
    value: &str,
) -> Result<Vec<(String, LogData)>, LogError> {
    let column = column.trim();
    let named = place(file, &ColumnRef::Name(column.to_owned()), data);
    let numbered = column.parse().ok().map(|number| place(file, &ColumnRef::Number(number), data));
    let channel = named.or_else(|error| numbered.unwrap_or(Err(error)))?;
    let Some(parts) = data.by_value(channel) else {
        return Err(LogError::RunNumbers { file: file.to_owned(), column: column.to_owned() });
    };
    let is_number = |name: &str| {
        value.trim().parse().is_ok_and(|number: f64| name.trim().parse() == Ok(number))
    };
    let alike: [&dyn Fn(&str) -> bool; 3] =
        [&|name| name == value, &|name| name.trim() == value.trim(), &is_number];
    let all = |is_value: &dyn Fn(&str) -> bool| -> Vec<_> {
        parts.iter().filter(|(name, _)| is_value(name)).cloned().collect()
    };
    let found = alike.into_iter().map(all).find(|found| !found.is_empty()).unwrap_or_default();
    if found.is_empty() {
        let values = parts.into_iter().map(|(value, _)| format!("{column}={value}")).collect();
        let group = format!("{column}={value}");
        return Err(LogError::NoGroup { file: file.to_owned(), group, groups: values });
    }
    Ok(found.into_iter().map(|(value, data)| (format!("{column}={value}"), data)).collect())
}

impl LogPart {
    /// Its rows as one part for each value in a column, a number or a word; and the number and share of rows without a value.
    ///
    /// # Errors
    /// [`LogError::NoColumn`] and others if the column cannot be found; [`LogError::RunNumbers`] if it does not name runs.
    pub(crate) fn by_run(&self, column: &ColumnRef) -> Result<(Vec<Self>, usize, f64), LogError> {
        let channel = place(&self.label, column, &self.data)?;
        let Some(found) = self.data.by_value(channel) else {
            return Err(LogError::RunNumbers {
                file: self.label.clone(),
                column: column.to_string(),
            });
        };
        let word = match column {
            ColumnRef::Name(name) => name.clone(),
            ColumnRef::Number(_) => "run".to_owned(),
        };
        let part = |(value, data): (String, LogData)| {
            let name = [&self.name[..], &format!("{word} {value}")]
                .into_iter()
                .filter(|text| !text.is_empty())
                .collect::<Vec<_>>()
                .join(" ");
            let label = format!("{} ({word} {value})", self.label);
            Self { label, name, data: Arc::new(data) }
        };
        let parts: Vec<Self> = found.into_iter().map(part).collect();
        let rows_of = |part: &Self| part.data.channels.first().map_or(0, |c| c.values.len());
        let rows = self.data.channels[channel].values.len();
        let without = rows - parts.iter().map(rows_of).sum::<usize>();
        Ok((parts, without, without as f64 / rows as f64))
    }
}
