//! Reads a `campaign.toml` and its logs.

use std::path::{Component, Path, PathBuf};

use lissom_core::record::Command;

use super::campaign_drive;
use super::campaign_file::{AnalysisOptions, CampaignFile, DriveConstants, ReadOptions};
use super::campaign_load::{self, CampaignLoad};
use super::campaign_signals::{Signals, signals};
use super::load_runs::load;
use super::memory_logs::{LogPlaces, MemoryLogs};
use super::own_logs::logs_of_run;
use super::run_spec::{RunSpec, runs};
use crate::config::{ConfigError, Source, Table, Value};
use crate::io_error::Error;
use crate::log::LogPath;
use crate::units::Dimension;

/// Reads a campaign: its description from a file or a text, its logs from files or from memory.
#[derive(Debug)]
#[must_use = "nothing is read before `read`"]
pub struct CampaignReader {
    source: Result<Source, ConfigError>,
    logs: MemoryLogs,
    only: Vec<PathBuf>,
    folder: Option<PathBuf>,
    confined: bool,
    options: ReadOptions,
}

impl CampaignReader {
    /// Starts with a `campaign.toml`.
    pub fn of_file(path: &Path) -> Self {
        Self::new(Source::read(path))
    }

    /// Starts with the text of a `campaign.toml`. Errors call it `name`; files in it are relative to the folder of that
    /// name, the working directory if it has none.
    pub fn of_text(name: impl AsRef<Path>, text: String) -> Self {
        Self::new(Ok(Source::new(name.as_ref(), text)))
    }

    fn new(source: Result<Source, ConfigError>) -> Self {
        let (logs, options) = (MemoryLogs::default(), ReadOptions::default());
        Self { source, logs, only: Vec::new(), folder: None, confined: false, options }
    }

    /// Takes logs from memory: a `file` of the campaign that is the name of one of them is that log.
    pub fn with_logs(mut self, logs: MemoryLogs) -> Self {
        self.logs = logs;
        self
    }

    /// Reads this log in place of the runs of the campaign; each further call adds a log. The `skip` in the `[analysis]` of the
    /// campaign applies too.
    pub fn only(mut self, log: &Path) -> Self {
        self.only.push(log.to_owned());
        self
    }

    /// Reads the logs of the runs in this folder, in place of the campaign's own.
    pub fn in_folder(mut self, folder: &Path) -> Self {
        self.folder = Some(folder.to_owned());
        self
    }

    /// Refuses files outside of the folder: a campaign of someone else can then read nothing but what is there.
    pub fn confined(mut self) -> Self {
        self.confined = true;
        self
    }

    /// The files of the campaign's runs, as it names them: of each run its log, then the logs of signals that have one of their
    /// own. Each file is listed once, without a group of channels in it. No log is read.
    ///
    /// # Errors
    /// [`Error::Config`] for signals and runs.
    pub fn run_files(self) -> Result<Vec<PathBuf>, Error> {
        let source = self.source?;
        files_of_runs(&source.root(&source.parse()?))
    }

    /// Reads the description with its `arm.toml`, and no log.
    ///
    /// # Errors
    /// Those of [`read`](Self::read) for the description.
    pub fn check(self) -> Result<(), Error> {
        let source = self.source?;
        if self.confined {
            confine(&source)?;
        }
        described(&source, &self.only).map(|_| ())
    }

    /// Sets limits for reading.
    pub fn options(mut self, options: ReadOptions) -> Self {
        self.options = options;
        self
    }

    /// Reads the campaign.
    ///
    /// # Errors
    /// [`Error::Config`] for the description itself and its `arm.toml`,
    /// [`Error::Log`] and [`Error::Record`] for the logs.
    pub fn read(self) -> Result<CampaignFile, Error> {
        let source = self.source?;
        let folder = self.folder.as_deref().unwrap_or(source.folder());
        let places = LogPlaces { folder, memory: &self.logs };
        if self.confined {
            confine(&source)?;
        }
        read(&source, &self.only, places, &self.options)
    }
}

/// Reads a `campaign.toml` and its logs.
///
/// # Errors
/// As [`CampaignReader::read`].
pub fn read_campaign(path: &Path) -> Result<CampaignFile, Error> {
    CampaignReader::of_file(path).read()
}

/// Reads only `log`, with the columns and units of the campaign at `path`.
///
/// # Errors
/// As [`CampaignReader::read`].
pub fn read_campaign_like(path: &Path, log: &Path) -> Result<CampaignFile, Error> {
    CampaignReader::of_file(path).only(log).read()
}

/// The files of the runs, each once.
fn files_of_runs(root: &Table<'_>) -> Result<Vec<PathBuf>, Error> {
    let signals = signals(&root.need("signals")?.table()?)?;
    let mut files = Vec::new();
    for spec in runs(&root.need("runs")?, None)? {
        for log in logs_of_run(&signals, &spec) {
            let file = LogPath::of(&log).file;
            if !files.contains(&file) {
                files.push(file);
            }
        }
    }
    Ok(files)
}

/// Refuses a campaign that names files outside of its folder.
fn confine(source: &Source) -> Result<(), Error> {
    let document = source.parse()?;
    let root = source.root(&document);
    let mut files = files_of_runs(&root)?;
    if let Some(drive) = root.get("drive").map(|value| value.table()).transpose()?
        && let Some(arm) = drive.get("arm")
    {
        files.push(PathBuf::from(arm.text()?));
    }
    let is_inside = |file: &PathBuf| {
        file.components().all(|c| matches!(c, Component::Normal(_) | Component::CurDir))
    };
    match files.into_iter().find(|file| !is_inside(file)) {
        Some(file) => Err(ConfigError::of_file(
            &file,
            "is not inside the folder of the campaign",
            "name a file that is given together with the campaign, without a folder above it",
        )
        .into()),
        None => Ok(()),
    }
}

/// A campaign without the contents of its logs.
struct Described {
    signals: Signals,
    command: Command,
    known: DriveConstants,
    on_motor: CampaignLoad,
    analysis: AnalysisOptions,
    runs: Vec<RunSpec>,
}

/// Reads the description; `only` logs take the place of its runs.
fn described(source: &Source, only: &[PathBuf]) -> Result<Described, Error> {
    let document = source.parse()?;
    let root = source.root(&document);
    root.only("signals drive load analysis runs")?;
    let mut signals = signals(&root.need("signals")?.table()?)?;
    let drive = root.optional("drive", Value::table)?;
    let (command, known, sign) =
        campaign_drive::drive(drive.as_ref(), signals.axis, &signals.command, source.folder())?;
    signals.command.reading.gain *= sign;
    signals.command.reading.offset *= sign;
    let load_table = root.optional("load", Value::table)?;
    let on_motor = load_table.map(|table| campaign_load::load(&table, &signals));
    let on_motor = on_motor.transpose()?.unwrap_or_default();
    signals.gravity = on_motor.gravity;
    let (analysis, skip_s) = root.optional("analysis", analysis)?.unwrap_or_default();
    let runs = if only.is_empty() {
        runs(&root.need("runs")?, skip_s)?
    } else {
        only.iter().map(|log| RunSpec::of_log(log, skip_s)).collect()
    };
    Ok(Described { signals, command, known, on_motor, analysis, runs })
}

fn read(
    source: &Source,
    only: &[PathBuf],
    places: LogPlaces<'_>,
    options: &ReadOptions,
) -> Result<CampaignFile, Error> {
    let Described { signals, command, known, on_motor, analysis, runs } = described(source, only)?;
    let places =
        if only.is_empty() { places } else { LogPlaces { folder: Path::new(""), ..places } };
    let mut campaign = load(places, &signals, command, &runs, options)?;
    campaign.hold_assumed = signals.command.hold_assumed;
    let campaign = match on_motor {
        CampaignLoad { mgl_nm: Some(mgl_nm), .. } => campaign.with_known_gravity(mgl_nm)?,
        CampaignLoad { gravity: true, .. } => campaign.with_gravity()?,
        CampaignLoad { .. } => campaign,
    };
    Ok(CampaignFile { campaign, known, analysis })
}

fn analysis(value: &Value<'_>) -> Result<(AnalysisOptions, Option<f64>), ConfigError> {
    let table = value.table()?;
    table.only("window harmonics skip")?;
    let windows = table.get("window").map_or_else(Vec::new, |value| value.one_or_list());
    let window_s =
        windows.iter().map(|v| v.positive(Dimension::TIME)).collect::<Result<Vec<_>, _>>()?;
    let harmonics = table.optional("harmonics", |v| v.whole(1, 99))?;
    let harmonics = harmonics.and_then(|count| usize::try_from(count).ok());
    let skip_s = table.not_negative("skip", Dimension::TIME)?;
    Ok((AnalysisOptions { window_s, harmonics }, skip_s))
}
