//! Logs in memory, which a campaign names in place of files.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use lissom_formats::LogData;

use crate::log::LogPart;

/// Logs in memory, each with the name that a campaign gives as `file`.
///
/// ```
/// use lissom_io::campaign::{CampaignReader, MemoryLogs};
/// use lissom_formats::LogData;
/// let t: Vec<f64> = (0..2000).map(|k| 1e-3 * f64::from(k)).collect();
/// let wave = |w: f64| t.iter().map(|t| (w * t).sin()).collect::<Vec<f64>>();
/// let table = LogData::of_columns([("t", t.clone()), ("i", wave(9.0)), ("q", wave(5.0))]);
/// let mut logs = MemoryLogs::default();
/// logs.add("run 1", table);
/// let text = "signals.time = { column = 't', unit = 's' }
/// signals.current = { column = 'i', unit = 'A', hold = 'measured' }
/// signals.motor = { column = 'q', unit = 'rad' }
/// runs = [{ file = 'run 1' }]";
/// let file = CampaignReader::of_text("campaign", text.to_owned()).with_logs(logs).read()?;
/// assert_eq!(file.campaign.runs[0].len(), 2000);
/// # Ok::<(), lissom_io::Error>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct MemoryLogs {
    logs: Vec<(String, Arc<LogData>)>,
}

impl MemoryLogs {
    /// Adds a log; one with this name is replaced.
    pub fn add(&mut self, name: impl Into<String>, log: LogData) {
        let (name, log) = (name.into(), Arc::new(log.with_time_stamps()));
        match self.logs.iter_mut().find(|known| known.0 == name) {
            Some(known) => known.1 = log,
            None => self.logs.push((name, log)),
        }
    }
}

/// Where the logs of a campaign are: in memory, or in files below a folder.
#[derive(Clone, Copy)]
pub(super) struct LogPlaces<'a> {
    pub(super) folder: &'a Path,
    pub(super) memory: &'a MemoryLogs,
}

impl LogPlaces<'_> {
    /// The path of a file.
    pub(super) fn path(&self, file: &Path) -> PathBuf {
        self.folder.join(file)
    }

    /// A log in memory, if one has this name.
    pub(super) fn in_memory(&self, file: &Path) -> Option<LogPart> {
        let known = self.memory.logs.iter().find(|(name, _)| Path::new(name) == file)?;
        let (label, data) = (known.0.clone(), Arc::clone(&known.1));
        Some(LogPart { label, name: String::new(), data })
    }
}

#[cfg(test)]
mod tests {
    use lissom_core::record::Run;

    use super::*;
    use crate::CampaignReader;

    const ROWS: usize = 400;

    fn table() -> LogData {
        let t: Vec<f64> = (0..ROWS).map(|k| 2e-3 * (k % (ROWS / 2)) as f64).collect();
        let wave = |w: f64| t.iter().map(|t| (w * t).sin()).collect::<Vec<f64>>();
        let columns = [("t [s]", t.clone()), ("i", wave(20.0)), ("q", wave(30.0))];
        let trial = (0..ROWS).map(|k| if k < ROWS / 2 { "up" } else { "down" });
        LogData::of_columns(columns).with_words("trial", trial)
    }

    const SIGNALS: &str = "signals.time = { column = 't [s]', unit = 's' }
signals.current = { column = 'i', unit = 'A', hold = 'measured' }
signals.motor = { column = 'q', unit = 'rad' }
";

    fn read(more: &str) -> Result<crate::CampaignFile, crate::Error> {
        let mut logs = MemoryLogs::default();
        logs.add("bench", table());
        CampaignReader::of_text("campaign", format!("{SIGNALS}{more}")).with_logs(logs).read()
    }

    #[test]
    fn a_table_in_memory_has_several_runs() {
        let file = read("signals.run = 'trial'\nruns = [{ file = 'bench' }]").unwrap();
        let runs = file.campaign.runs;
        let names: Vec<&str> = runs.iter().map(Run::name).collect();
        assert_eq!(names, ["bench trial up", "bench trial down"]);
        assert!(runs.iter().all(|run| run.len() == ROWS / 2));
    }

    #[test]
    fn errors_name_the_table() {
        let mut logs = MemoryLogs::default();
        logs.add("bench", table().with_column("spare", vec![f64::INFINITY; ROWS]));
        let text = format!("{SIGNALS}tips = [{{ name = 'tip', column = 'spare', unit = 'rad' }}]");
        let text = format!("[signals]\n{}\n[[runs]]\nfile = 'bench'", text.replace("signals.", ""));
        let error = CampaignReader::of_text("campaign", text).with_logs(logs).read().unwrap_err();
        let expected = "bench: row 1, column \"spare\": \"inf\" is not a finite number";
        assert_eq!(error.to_string(), expected);
        let error = read("runs = [{ file = 'other.csv' }]").unwrap_err();
        assert!(error.to_string().starts_with("other.csv: cannot be opened"), "{error}");
        let error = read("signals.run = 'lap'\nruns = [{ file = 'bench' }]").unwrap_err();
        assert!(error.to_string().starts_with("bench: there is no column \"lap\""), "{error}");
    }
}
