//! The tables `[[runs]]`.

use std::path::{Path, PathBuf};

use lissom_core::record::clock::Trim;

use crate::config::{ConfigError, ConfigPlace, Table, Value};
use crate::log::{LogPart, LogPath};
use crate::units::Dimension;

/// A table `[[runs]]`, or one of the runs of its file.
#[derive(Clone)]
pub(super) struct RunSpec {
    pub(super) file: PathBuf,
    pub(super) name: String,
    /// The drive frequency \[rad/s\], with its place in the campaign.
    pub(super) omega_rad_s: Option<(f64, ConfigPlace)>,
    /// Times that are left out.
    pub(super) trim: Trim,
    /// The log of the motor, if it has one of its own.
    pub(super) motor_file: Option<PathBuf>,
    /// The logs of tips that have one of their own, in the order of the tips.
    pub(super) tip_files: Vec<PathBuf>,
    /// Its part of the file, if the file has several runs.
    pub(super) part: Option<LogPart>,
    /// Rows of the file that are of no run, and their share; with the first of its runs.
    pub(super) rows_without_run: Option<(usize, f64)>,
}

impl RunSpec {
    /// Its name without a group in it: the groups that fit have names of their own.
    pub(super) fn title(&self) -> &str {
        self.name.split_once("::").map_or(&self.name, |(file, _)| file)
    }

    /// The run of a single log.
    pub(super) fn of_log(log: &Path, skip_s: Option<f64>) -> Self {
        let name = LogPath::of(log).name();
        Self {
            file: log.to_owned(),
            name,
            omega_rad_s: None,
            trim: Trim { skip_s: skip_s.unwrap_or(0.0), ..Trim::default() },
            motor_file: None,
            tip_files: Vec::new(),
            part: None,
            rows_without_run: None,
        }
    }
}

pub(super) fn runs(value: &Value<'_>, skip_s: Option<f64>) -> Result<Vec<RunSpec>, ConfigError> {
    let items = value.list("a list of runs, each a table [[runs]]")?;
    if items.is_empty() {
        return Err(value.empty());
    }
    items.iter().map(|item| run(item, skip_s)).collect()
}

fn run(value: &Value<'_>, skip_s: Option<f64>) -> Result<RunSpec, ConfigError> {
    let table = value.table()?;
    table.only("file name omega_rad_s frequency skip until leave_out motor_file tip_files")?;
    let file = table.need("file")?.text()?;
    let name = table.optional("name", Value::text)?.unwrap_or(file);
    let omega_rad_s = match table.one_of(&["omega_rad_s", "frequency"])? {
        None => None,
        Some((0, value)) => match value.number()? {
            omega if omega > 0.0 => Some((omega, value.place())),
            _ => return Err(value.range("greater than zero")),
        },
        Some((_, value)) => Some((value.positive(Dimension::RATE)?, value.place())),
    };
    let trim = trim(&table, skip_s)?;
    let motor_file = table.optional("motor_file", Value::text)?;
    let tip_files = table.get("tip_files").map_or_else(Vec::new, |value| value.one_or_list());
    let tip_files =
        tip_files.iter().map(|v| v.text().map(PathBuf::from)).collect::<Result<_, _>>()?;
    Ok(RunSpec {
        file: PathBuf::from(file),
        name: name.to_owned(),
        omega_rad_s,
        trim,
        motor_file: motor_file.map(PathBuf::from),
        tip_files,
        part: None,
        rows_without_run: None,
    })
}

/// Which times of the log are left out.
fn trim(table: &Table<'_>, skip_s: Option<f64>) -> Result<Trim, ConfigError> {
    let skip = table.not_negative("skip", Dimension::TIME)?;
    let until_s = table.positive("until", Dimension::TIME)?;
    let mut left_out_s = Vec::new();
    if let Some(all) = table.get("leave_out") {
        const STRETCHES: &str = "a list of stretches, each from and to: [[\"3 s\", \"4.5 s\"]]";
        for stretch in all.list(STRETCHES)? {
            let ends = stretch.list(STRETCHES)?;
            let [from, to] = ends.as_slice() else { return Err(all.kind(STRETCHES)) };
            let from_s = from.not_negative(Dimension::TIME)?;
            let to_s = to.positive(Dimension::TIME)?;
            if to_s <= from_s {
                return Err(all.kind(STRETCHES));
            }
            left_out_s.push([from_s, to_s]);
        }
    }
    Ok(Trim { skip_s: skip.or(skip_s).unwrap_or(0.0), until_s, left_out_s })
}
