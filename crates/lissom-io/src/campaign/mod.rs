//! `campaign.toml`: which logs belong together, what their columns are and what is known of the
//! drive.
//!
//! ```toml
//! [signals]
//! time    = { column = "t", unit = "s" }    # or sample_time = "1 ms" for logs without stamps
//! current = { column = "i", unit = "A", hold = "sampled" }
//! motor   = { column = "theta_m", unit = "rad" }
//! tips    = [{ name = "tip", column = "theta_t", unit = "rad" }]
//! decimal = ","                             # absent: a point
//! [drive]
//! torque_constant = "2.184 lbf*in/A"
//! current_limit = "4.12 A"
//! arm = "arm.toml"                          # an arm to compare with
//! [analysis]
//! window = "0.3 s"                          # or a list
//! harmonics = 9
//! skip = "1 s"                              # head of every run to leave out
//! [[runs]]
//! file = "run-01.csv"
//! frequency = "0.5 Hz"                      # or omega_rad_s = 3.1416; found when absent
//! ```
//!
//! **Columns** go by name or, from 1, by number. A reading is `(scale·raw + offset)` in `unit`;
//! `scale` is 1 and `offset` 0 when absent.
//!
//! **The drive's input** is `current`, `voltage` or `command`; the unit of `command` may be one of
//! current, of voltage or `"1"`. `unit = "1"` is a command of unknown unit. `hold` is `"sampled"`
//! (a held command) or `"measured"`. For a voltage the torque constant is per volt, or per ampere
//! with `resistance` and `back_emf`; a `back_emf` beside a constant per volt adds its damping.
//! `limit` is the command's limit in any case; `current_limit` and `voltage_limit` say which.
//!
//! **The axis** is rotary where the motor's unit is an angle, linear where it is a length.
//!
//! **Tips** have a `quantity`: `"angle"` (of the radius to the point; when absent), `"deflection"`
//! (from the motor's line) or `"acceleration"`. A length or acceleration in metres on a rotary
//! axis needs `radius`. `unit = "1"` is a sensor of unknown scale. A camera has `x` and `y`
//! columns in place of `column` and, where the joint is not at (0, 0), `origin = [x, y]` in the
//! columns' own numbers; its angle is continued across ±π and multiplied by `scale` (−1 where y
//! points down).

mod drive;
mod error;
mod load;
mod signals;
#[cfg(test)]
mod tests;

pub use error::CampaignError;
pub(crate) use signals::column;

use std::path::{Path, PathBuf};

use lissom::record::Campaign;

use crate::arm_file::ArmFile;
use crate::config::{ConfigError, Place, Rule, Source, Table, Value};
use crate::error::Error;
use crate::units::Dimension;

/// A campaign with what its file says beyond its runs.
#[derive(Debug, Clone)]
pub struct CampaignFile {
    /// The runs and their channels.
    pub campaign: Campaign,
    /// What is known of the drive.
    pub known: Known,
    /// How it wants to be analysed.
    pub analysis: AnalysisOptions,
}

/// Constants of the table `[drive]`, in SI.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Known {
    /// As it was given: per ampere, per volt or per unit of command (N·m or N each).
    pub torque_constant: Option<f64>,
    /// Resistance of the winding \[Ω\].
    pub resistance_ohm: Option<f64>,
    /// Back-EMF constant \[V·s/rad or V·s/m\].
    pub back_emf: Option<f64>,
    /// The arm to compare with.
    pub arm: Option<ArmFile>,
    /// The file it stands in.
    pub arm_path: Option<PathBuf>,
}

/// The table `[analysis]`: wishes for the analysis. Its `skip` is carried out on reading.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct AnalysisOptions {
    /// Lengths of the regression's windows \[s\]; empty where they are left to the data.
    pub window_s: Vec<f64>,
    /// Highest harmonic of a periodic run.
    pub harmonics: Option<usize>,
}

/// Limits on reading.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ReadOptions {
    /// Most rows kept of a log, see [`LogOptions::max_rows`](crate::log::LogOptions::max_rows).
    pub max_rows: usize,
    /// Fewest samples of a piece between gaps.
    pub least_piece: usize,
}

impl Default for ReadOptions {
    fn default() -> Self {
        Self { max_rows: crate::log::LogOptions::default().max_rows, least_piece: 50 }
    }
}

/// Reads a `campaign.toml` and the logs it names.
///
/// # Errors
/// [`Error::Config`] and [`Error::Campaign`] for the file itself and its `arm.toml`,
/// [`Error::Log`] and [`Error::Record`] for the logs.
pub fn read_campaign(path: &Path) -> Result<CampaignFile, Error> {
    read_campaign_with(path, &ReadOptions::default())
}

/// Reads a `campaign.toml` and the logs it names, within limits.
///
/// # Errors
/// As [`read_campaign`].
pub fn read_campaign_with(path: &Path, options: &ReadOptions) -> Result<CampaignFile, Error> {
    read(path, None, options)
}

/// Reads `log` as the logs of the campaign at `path` are read, and none of these. The head that its
/// `[analysis]` skips is skipped.
///
/// # Errors
/// As [`read_campaign`].
pub fn read_campaign_like(path: &Path, log: &Path) -> Result<CampaignFile, Error> {
    read(path, Some(log), &ReadOptions::default())
}

fn read(path: &Path, log: Option<&Path>, options: &ReadOptions) -> Result<CampaignFile, Error> {
    let source = Source::read(path)?;
    let document = source.parse()?;
    let root = source.root(&document);
    root.only(&["signals", "drive", "analysis", "runs"])?;
    let signals = signals::signals(&root.need("signals")?.table()?)?;
    let drive = root.get("drive").map(|v| v.table()).transpose()?;
    let (command, known) =
        drive::drive(drive.as_ref(), signals.axis, &signals.command, source.folder())?;
    let (analysis, skip_s) = match root.get("analysis") {
        Some(value) => analysis(&value.table()?)?,
        None => (AnalysisOptions::default(), None),
    };
    let (folder, runs) = match log {
        Some(log) => (Path::new(""), vec![RunSpec::of_log(log, skip_s)]),
        None => (source.folder(), runs(&root.need("runs")?, skip_s)?),
    };
    let campaign = load::load(folder, &signals, command, &runs, options)?;
    Ok(CampaignFile { campaign, known, analysis })
}

fn runs(value: &Value<'_>, skip_s: Option<f64>) -> Result<Vec<RunSpec>, ConfigError> {
    let items = value.list("a list of runs, each a table [[runs]]")?;
    if items.is_empty() {
        return Err(value.empty());
    }
    items.iter().map(|item| run(item, skip_s)).collect()
}

fn analysis(table: &Table<'_>) -> Result<(AnalysisOptions, Option<f64>), ConfigError> {
    table.only(&["window", "harmonics", "skip"])?;
    let windows = table.get("window").map_or_else(Vec::new, |value| value.one_or_list());
    let window_s =
        windows.iter().map(|v| v.positive(Dimension::TIME)).collect::<Result<Vec<_>, _>>()?;
    let harmonics = table.get("harmonics").map(|v| v.whole(1, 99)).transpose()?;
    let harmonics = harmonics.and_then(|count| usize::try_from(count).ok());
    let skip_s = table.get("skip").map(|v| v.not_negative(Dimension::TIME)).transpose()?;
    Ok((AnalysisOptions { window_s, harmonics }, skip_s))
}

/// A table `[[runs]]`.
struct RunSpec {
    file: PathBuf,
    name: String,
    /// With its place in the campaign.
    omega_rad_s: Option<(f64, Place)>,
    skip_s: f64,
}

impl RunSpec {
    /// A log by itself.
    fn of_log(log: &Path, skip_s: Option<f64>) -> Self {
        let name = log.file_name().map_or_else(String::new, |n| n.to_string_lossy().into_owned());
        Self { file: log.to_owned(), name, omega_rad_s: None, skip_s: skip_s.unwrap_or(0.0) }
    }
}

fn run(value: &Value<'_>, skip_s: Option<f64>) -> Result<RunSpec, ConfigError> {
    let table = value.table()?;
    table.only(&["file", "name", "omega_rad_s", "frequency", "skip"])?;
    let file = table.need("file")?.text()?;
    let name = table.get("name").map(|v| v.text()).transpose()?.unwrap_or(file);
    let omega_rad_s = match table.one_of(&["omega_rad_s", "frequency"])? {
        None => None,
        Some((0, value)) => match value.number()? {
            omega if omega > 0.0 => Some((omega, value.place())),
            _ => return Err(value.range(Rule::Positive)),
        },
        Some((_, value)) => Some((value.positive(Dimension::RATE)?, value.place())),
    };
    let own_skip = table.get("skip").map(|v| v.not_negative(Dimension::TIME)).transpose()?;
    Ok(RunSpec {
        file: PathBuf::from(file),
        name: name.to_owned(),
        omega_rad_s,
        skip_s: own_skip.or(skip_s).unwrap_or(0.0),
    })
}
