//! The tables `[[runs]]`.

use std::path::{Path, PathBuf};

use crate::config::{ConfigError, ConfigPlace, Rule, Value};
use crate::units::Dimension;

/// A table `[[runs]]`.
pub(super) struct RunSpec {
    pub(super) file: PathBuf,
    pub(super) name: String,
    /// The drive frequency \[rad/s\], with its place in the campaign.
    pub(super) omega_rad_s: Option<(f64, ConfigPlace)>,
    pub(super) skip_s: f64,
}

impl RunSpec {
    /// The run of a single log.
    pub(super) fn of_log(log: &Path, skip_s: Option<f64>) -> Self {
        let name = log.file_name().map_or_else(String::new, |n| n.to_string_lossy().into_owned());
        Self { file: log.to_owned(), name, omega_rad_s: None, skip_s: skip_s.unwrap_or(0.0) }
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
