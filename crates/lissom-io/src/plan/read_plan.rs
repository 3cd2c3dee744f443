//! Reads a `plan.toml`.

use std::collections::HashSet;
use std::path::Path;

use lissom_core::rig::Settle;

use super::plan_experiment::{Planned, RUNS_MOST, read};
use super::plan_file::{PlanFile, PlanRun};
use super::plan_settle::settle;
use crate::config::{ConfigError, Source, Value};
use crate::io_error::Error;

impl PlanFile {
    /// Reads a `plan.toml` and its tables.
    ///
    /// # Errors
    /// [`Error::Config`] for the file, [`Error::Log`] for a table.
    pub fn read(path: &Path) -> Result<Self, Error> {
        Self::from_source(&Source::read(path)?)
    }

    /// Reads the text of a `plan.toml`; `path` is the file's name in errors, and paths of tables start from its folder.
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
        root.only("title seed settle runs")?;
        let title = root.optional("title", Value::text)?.unwrap_or("");
        let seed = root.optional("seed", |v| v.whole(0, i64::MAX))?;
        let seed = seed.map_or(1, i64::unsigned_abs);
        let common = root.get("settle").map_or(Ok(Settle::DETECTED), |v| settle(&v))?;
        let list = root.need("runs")?;
        let entries = list.list("a list of runs, each under [[runs]]")?;
        if entries.is_empty() {
            return Err(list.empty().into());
        }
        let mut made: Vec<(Option<String>, Planned)> = Vec::new();
        for entry in &entries {
            let table = entry.table()?;
            let name = table.optional("name", |v| v.text().map(str::to_owned))?;
            let repeat = table.optional("repeat", |v| v.whole(1, 10_000))?.unwrap_or(1);
            let planned = read(&table, common, seed, source.folder())?;
            let repeat = usize::try_from(repeat).unwrap_or(usize::MAX);
            let found = made.len() + planned.len().saturating_mul(repeat);
            if found > RUNS_MOST {
                return Err(entry.too_many(found, RUNS_MOST).into());
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
        names(&list, &runs)?;
        Ok(Self { title: title.to_owned(), seed, runs })
    }
}

/// Checks that the names of runs are file names, and that each occurs once.
fn names(list: &Value<'_>, runs: &[PlanRun]) -> Result<(), ConfigError> {
    let mut seen = HashSet::new();
    for run in runs {
        let name = &run.name;
        let fits = |c: char| c.is_alphanumeric() || matches!(c, '-' | '_' | '.');
        let begins = name.chars().next().is_some_and(char::is_alphanumeric);
        if !begins || !name.chars().all(fits) || name.len() > 100 {
            return Err(list.error(
                format!(": `{name}` is not a valid name for a log"),
                "use letters, digits, `-`, `_` and `.`, and begin with a letter or digit",
            ));
        }
        // Some file systems do not distinguish upper and lower case.
        if !seen.insert(name.to_lowercase()) {
            let problem = format!(": two runs have the name `{name}`");
            return Err(list.error(problem, "give each run its own `name`, or none"));
        }
    }
    Ok(())
}
