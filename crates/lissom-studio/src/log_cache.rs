//! Logs in memory, so that a page that zooms does not read files again.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use lissom_formats::{LogData, ReadOptions};
use lissom_io::inspect::{Inspection, inspect_content};
use lissom_io::log::{LastFile, LogPath};

use crate::problem::Problem;
use crate::thinned::{Abscissa, Extremes, Points, thinned};

/// Most values that are kept: 1 GB.
const VALUES_MOST: usize = 1 << 27;

/// A log that was read.
#[derive(Debug)]
pub(crate) struct CachedLog {
    /// What is in it, without its values.
    inspection: Arc<Inspection>,
    data: LogData,
    extremes: Vec<OnceLock<Extremes>>,
    /// Whether the values of a channel increase, as stamps do.
    increases: Vec<OnceLock<bool>>,
}

/// How a log is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Key {
    id: u64,
    options: ReadOptions,
}

/// What is in each log, and the values of the logs that were read last.
#[derive(Debug, Default)]
pub(crate) struct LogCache {
    inspections: Mutex<Vec<(Key, Arc<Inspection>)>>,
    logs: Mutex<Vec<(Key, Arc<CachedLog>)>>,
    /// The file that was read last of those with several logs.
    last: Mutex<LastFile>,
}

impl LogCache {
    /// A log, read if it is not there yet; errors call it `name`.
    pub(crate) fn log(
        &self,
        id: u64,
        path: &Path,
        name: &str,
        options: ReadOptions,
    ) -> Result<Arc<CachedLog>, Problem> {
        let key = Key { id, options };
        let mut logs = self.logs.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(at) = logs.iter().position(|(known, _)| *known == key) {
            let found = logs.remove(at);
            let log = Arc::clone(&found.1);
            logs.push(found);
            return Ok(log);
        }
        drop(logs);
        let log = Arc::new(self.read(path, name, options)?);
        let mut known = self.inspections.lock().unwrap_or_else(PoisonError::into_inner);
        known.retain(|(known, _)| known.id != id);
        known.push((key, Arc::clone(&log.inspection)));
        drop(known);
        let mut logs = self.logs.lock().unwrap_or_else(PoisonError::into_inner);
        logs.retain(|(known, _)| known.id != id);
        logs.push((key, Arc::clone(&log)));
        while logs.len() > 1
            && logs.iter().map(|(_, log)| log.values()).sum::<usize>() > VALUES_MOST
        {
            logs.remove(0);
        }
        Ok(log)
    }

    /// What is in a log, read if that is not known yet.
    pub(crate) fn inspection(
        &self,
        id: u64,
        path: &Path,
        name: &str,
        options: ReadOptions,
    ) -> Result<Arc<Inspection>, Problem> {
        let key = Key { id, options };
        let known = self.inspections.lock().unwrap_or_else(PoisonError::into_inner);
        let found = known.iter().find(|(known, _)| *known == key).map(|(_, found)| found.clone());
        drop(known);
        match found {
            Some(found) => Ok(found),
            None => Ok(Arc::clone(&self.log(id, path, name, options)?.inspection)),
        }
    }

    /// Forgets a log.
    pub(crate) fn forget(&self, id: u64) {
        let mut known = self.inspections.lock().unwrap_or_else(PoisonError::into_inner);
        known.retain(|(known, _)| known.id != id);
        drop(known);
        let mut logs = self.logs.lock().unwrap_or_else(PoisonError::into_inner);
        logs.retain(|(known, _)| known.id != id);
        drop(logs);
        *self.last.lock().unwrap_or_else(PoisonError::into_inner) = LastFile::default();
    }

    fn read(&self, path: &Path, name: &str, options: ReadOptions) -> Result<CachedLog, Problem> {
        let inspected =
            self.content(path, options).and_then(|content| inspect_content(path, content));
        let mut inspection = inspected.map_err(|error| {
            // People know a log by its name, not by its place in the folder of the state.
            match path.parent() {
                Some(folder) => Problem::from(error).without_folder(folder),
                None => error.into(),
            }
        })?;
        inspection.file = PathBuf::from(name);
        Ok(CachedLog::of(inspection))
    }

    /// The content of the file of a log. One with several logs is read once for all of them.
    fn content(&self, path: &Path, options: ReadOptions) -> Result<Arc<LogData>, lissom_io::Error> {
        let path = LogPath::of(path);
        if path.group.is_none() {
            return Ok(path.read(&options)?);
        }
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        Ok(last.content(&path, &options)?)
    }
}

impl CachedLog {
    fn of(mut inspection: Inspection) -> Self {
        let nothing = LogData::of_columns::<String>([]);
        let data = std::mem::replace(&mut inspection.data, nothing);
        let channels = || data.channels.iter();
        let extremes = channels().map(|_| OnceLock::new()).collect();
        let increases = channels().map(|_| OnceLock::new()).collect();
        Self { inspection: Arc::new(inspection), data, extremes, increases }
    }

    /// The different values of a channel, counted from 0, in the order in which they appear; `None` if they are too many for
    /// names of runs.
    pub(crate) fn names(&self, channel: usize) -> Option<Vec<String>> {
        let parts = self.data.by_value(channel)?;
        Some(parts.into_iter().map(|(name, _)| name).collect())
    }

    fn values(&self) -> usize {
        self.data.channels.iter().map(|channel| channel.values.len()).sum()
    }

    /// The channel with the stamps of a channel, its own or those of the log, if they increase.
    fn stamps(&self, channel: usize, of_log: Option<usize>) -> Option<usize> {
        let time = self.inspection.channels[channel].time.or(of_log)?;
        let values = &self.data.channels[time].values;
        let as_long = values.len() == self.data.channels[channel].values.len();
        let increase = *self.increases[time].get_or_init(|| {
            values.first().is_some_and(|first| first.is_finite())
                && values.is_sorted_by(|a, b| a < b)
        });
        (as_long && increase && time != channel).then_some(time)
    }

    /// The points of a channel, counted from 0, for a screen, over the stamps of channel `time` or over rows; all of them if no
    /// range is given.
    pub(crate) fn trace(
        &self,
        channel: usize,
        time: Option<usize>,
        range: Option<[f64; 2]>,
        pixels: usize,
    ) -> Option<TracePoints> {
        let values = &self.data.channels.get(channel)?.values;
        let known = self.extremes[channel].get_or_init(|| Extremes::of(values));
        let time = self.stamps(channel, time);
        let x = match time {
            Some(time) => Abscissa::Stamps(&self.data.channels[time].values),
            None => Abscissa::Rows,
        };
        let label = |k: usize| {
            let channel = &self.inspection.channels[k];
            match &channel.unit {
                // As in `q [rad]` and `speed_rpm`.
                Some(unit) if !channel.name.contains(&unit.text) => {
                    format!("{} ({})", channel.label(), unit.text)
                }
                _ => channel.label(),
            }
        };
        let range = range.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
        Some(TracePoints {
            x_label: time.map_or_else(|| "row".to_owned(), label),
            points: thinned(&x, values, known, range, pixels),
        })
    }
}

/// The points of a channel, with names for the axes.
#[derive(Debug, serde::Serialize)]
pub(crate) struct TracePoints {
    x_label: String,
    #[serde(flatten)]
    points: Points,
}
