//! `plan.toml`: the experiments of a virtual campaign.
//!
//! ```toml
//! seed = 1                                  # of noise and random phases; 1 when absent
//! settle = "detected"                       # or a time, "none", { tolerance, longest }
//! [[runs]]
//! sine = { frequency = ["0.2 Hz", "0.6 Hz"], amplitude = ["0.5 rad", "1 rad"] }  # each with each
//! periods = 12                              # or record = "60 s"
//! [[runs]]
//! multisine = { frequency = "0.1 Hz", to = "5 Hz", amplitude = "0.5 rad", crest = 1.7 }
//! [[runs]]
//! release = "0.05 N"                        # the tip let go
//! record = "60 s"
//! ```
//!
//! Every key is in `docs/plan.md`.

mod error;
mod experiment;
#[cfg(test)]
mod tests;

pub use error::PlanError;

use std::path::Path;

use lissom::rig::{Experiment, Settle};

use crate::config::{Source, Table, Value};
use crate::error::Error;
use crate::units::Dimension;

/// A virtual campaign.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanFile {
    /// What it is for; may be empty.
    pub title: String,
    /// Seed of the sensors' noise.
    pub seed: u64,
    /// The runs in order.
    pub runs: Vec<PlanRun>,
}

/// One run of a virtual campaign.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanRun {
    /// Name of its log without the ending.
    pub name: String,
    /// What is done.
    pub experiment: Experiment,
    /// Frequency of a sine \[rad/s\].
    pub omega_rad_s: Option<f64>,
    /// Seed of its noise.
    pub seed: u64,
}

/// Most runs of a plan.
const RUNS_MOST: usize = 10_000;

impl PlanFile {
    /// Reads a `plan.toml` and the tables that it names.
    ///
    /// # Errors
    /// [`Error::Config`], [`Error::Plan`], [`Error::Log`] for a table.
    pub fn read(path: &Path) -> Result<Self, Error> {
        Self::from_source(&Source::read(path)?)
    }

    /// Reads the text of a `plan.toml`; `path` stands in errors, and tables start from its folder.
    ///
    /// ```
    /// let text = "[[runs]]\nsine = { frequency = \"1 Hz\", amplitude = \"0.5 rad\" }\nperiods = 9";
    /// let plan = lissom_io::PlanFile::from_text("plan.toml".as_ref(), text)?;
    /// assert_eq!((plan.runs.len(), plan.runs[0].experiment.record_s), (1, 9.0));
    /// # Ok::<(), lissom_io::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn from_text(path: &Path, text: &str) -> Result<Self, Error> {
        Self::from_source(&Source::new(path, text.to_owned()))
    }

    fn from_source(source: &Source) -> Result<Self, Error> {
        let document = source.parse()?;
        let root = source.root(&document);
        root.only(&["title", "seed", "settle", "runs"])?;
        let title = root.get("title").map(|v| v.text()).transpose()?.unwrap_or("");
        let seed = root.get("seed").map(|v| v.whole(0, i64::MAX)).transpose()?;
        let seed = seed.map_or(1, i64::unsigned_abs);
        let common = root.get("settle").map_or(Ok(Settle::DETECTED), |v| settle(&v))?;
        let list = root.need("runs")?;
        let entries = list.list("a list of runs, each under [[runs]]")?;
        if entries.is_empty() {
            return Err(list.empty().into());
        }
        let mut made: Vec<(Option<String>, experiment::Planned)> = Vec::new();
        for entry in &entries {
            let table = entry.table()?;
            let name = table.get("name").map(|v| v.text().map(str::to_owned)).transpose()?;
            let repeat = table.get("repeat").map(|v| v.whole(1, 10_000)).transpose()?.unwrap_or(1);
            let planned = experiment::read(&table, common, seed, source.folder())?;
            let repeat = usize::try_from(repeat).unwrap_or(usize::MAX);
            let found = made.len() + planned.len().saturating_mul(repeat);
            if found > RUNS_MOST {
                let (place, most) = (entry.place(), RUNS_MOST);
                return Err(crate::config::ConfigError::TooMany { place, found, most }.into());
            }
            for _ in 0..repeat {
                made.extend(planned.iter().map(|p| (name.clone(), p.clone())));
            }
        }
        let digits = made.len().to_string().len().max(2);
        let runs: Vec<PlanRun> = made
            .into_iter()
            .enumerate()
            .map(|(index, (name, planned))| PlanRun {
                name: match name {
                    Some(name) if planned.alone => name,
                    Some(name) => format!("{name}-{:0digits$}", index + 1),
                    None => format!("run-{:0digits$}", index + 1),
                },
                experiment: planned.experiment,
                omega_rad_s: planned.omega_rad_s,
                seed: seed.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(index as u64),
            })
            .collect();
        error::names(&root, &runs)?;
        Ok(Self { title: title.to_owned(), seed, runs })
    }
}

/// How the transient before a log goes.
fn settle(value: &Value<'_>) -> Result<Settle, Error> {
    if let Some(table) = value.as_table() {
        return detected(&table);
    }
    Ok(match value.as_text() {
        Some("detected") => Settle::DETECTED,
        Some("none") => Settle::AtOnce,
        _ => Settle::Wait { wait_s: value.not_negative(Dimension::TIME)? },
    })
}

fn detected(table: &Table<'_>) -> Result<Settle, Error> {
    table.only(&["tolerance", "longest"])?;
    let Settle::Detected { tolerance, longest_s } = Settle::DETECTED else {
        return Ok(Settle::DETECTED);
    };
    let given = |key, dimension| table.get(key).map(|v| v.positive(dimension)).transpose();
    Ok(Settle::Detected {
        tolerance: given("tolerance", Dimension::NUMBER)?.unwrap_or(tolerance),
        longest_s: given("longest", Dimension::TIME)?.unwrap_or(longest_s),
    })
}
