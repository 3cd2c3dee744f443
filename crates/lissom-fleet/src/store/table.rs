//! A folder that is read.

use std::collections::HashSet;
use std::io;
use std::path::{Path, PathBuf};

use lissom_io::write::write_whole;

use super::manifest::Manifest;
use super::part::{ParquetWriter, part_column, part_names};
use super::part_columns::{Values, columns, std_of};
use crate::fleet_error::FleetError;

/// The rows of a fleet, read column by column. It shows the parts that the manifest listed when it was opened.
#[derive(Debug, Clone)]
pub struct FleetTable {
    folder: PathBuf,
    manifest: Manifest,
}

/// Opens the folder of a fleet, also while a run writes into it.
///
/// # Errors
/// [`FleetError::NoFleet`] if it has no manifest, [`FleetError::Damaged`] if that cannot be read, or a part is not as it was
/// written, [`FleetError::Part`] if a part cannot be read.
pub fn open(folder: &Path) -> Result<FleetTable, FleetError> {
    let found = Manifest::read(folder)?;
    let manifest = found.ok_or_else(|| FleetError::NoFleet { folder: folder.to_owned() })?;
    manifest.check_parts(folder)?;
    Ok(FleetTable::new(folder.to_owned(), manifest))
}

impl FleetTable {
    pub(super) fn new(folder: PathBuf, manifest: Manifest) -> Self {
        Self { folder, manifest }
    }

    /// What was asked, and the parts.
    pub fn manifest(&self) -> &Manifest {
        &self.manifest
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.manifest.parts.iter().map(|part| part.rows).sum()
    }

    /// Names of all columns, in the order of their first appearance.
    ///
    /// # Errors
    /// [`FleetError::Read`] or [`FleetError::Damaged`] if a part cannot be read.
    pub fn names(&self) -> Result<Vec<String>, FleetError> {
        let (mut names, mut seen) = (Vec::new(), HashSet::new());
        if self.manifest.parts.is_empty() {
            return Ok(columns(&[]).into_iter().map(|(name, _)| name).collect());
        }
        for part in &self.manifest.parts {
            for name in part_names(&self.folder.join(&part.file))? {
                if seen.insert(name.clone()) {
                    names.push(name);
                }
            }
        }
        Ok(names)
    }

    /// All columns, in the order of [`FleetTable::names`].
    pub(super) fn columns(&self) -> Result<Vec<(String, Values)>, FleetError> {
        let of = |name: String| Ok(self.column(&name)?.map(|values| (name, values)));
        self.names()?.into_iter().filter_map(|name| of(name).transpose()).collect()
    }

    /// Keys of all estimates: a column is one if another has its standard errors.
    ///
    /// # Errors
    /// As [`FleetTable::names`].
    pub fn parameters(&self) -> Result<Vec<String>, FleetError> {
        let names = self.names()?;
        let all: HashSet<&str> = names.iter().map(String::as_str).collect();
        let is_estimate = |name: &&String| all.contains(std_of(name).as_str());
        Ok(names.iter().filter(is_estimate).cloned().collect())
    }

    /// A column of all rows; none if no part has it.
    ///
    /// # Errors
    /// As [`FleetTable::names`].
    pub fn column(&self, name: &str) -> Result<Option<Values>, FleetError> {
        if self.manifest.parts.is_empty() {
            let empty = columns(&[]).into_iter().find(|(known, _)| known == name);
            return Ok(empty.map(|(_, values)| values));
        }
        let mut all: Option<Values> = None;
        let mut before = 0;
        for part in &self.manifest.parts {
            let path = self.folder.join(&part.file);
            let values = part_column(&path, name)?;
            let wrong = |problem: &str| FleetError::Damaged {
                path: path.clone(),
                problem: problem.to_owned(),
            };
            if values.as_ref().is_some_and(|values| values.len() != part.rows) {
                return Err(rows_differ(&path));
            }
            let (rows, kind) = (part.rows, "a column has another type than in other parts");
            match (&mut all, values) {
                (None, None) => {}
                (None, Some(values)) => all = Some(after(before, values)),
                (Some(Values::Text(all)), Some(Values::Text(more))) => all.extend(more),
                (Some(Values::Number(all)), Some(Values::Number(more))) => all.extend(more),
                (Some(Values::Time(all)), Some(Values::Time(more))) => all.extend(more),
                (Some(_), Some(_)) => return Err(wrong(kind)),
                (Some(Values::Text(all)), None) => all.resize(all.len() + rows, None),
                (Some(Values::Number(all)), None) => all.resize(all.len() + rows, None),
                (Some(Values::Time(all)), None) => all.resize(all.len() + rows, None),
            }
            before += rows;
        }
        Ok(all)
    }

    /// Writes all rows as one table: Parquet if the name of the file ends in `.parquet`, and else CSV, with times as in
    /// 2026-11-27T08:15:00.000000Z.
    ///
    /// # Errors
    /// [`FleetError::Write`] if the file cannot be written or a part cannot be read; [`FleetError::Read`] or
    /// [`FleetError::Damaged`] as [`FleetTable::names`].
    pub fn write(&self, path: &Path) -> Result<(), FleetError> {
        if path.extension().is_some_and(|end| end.eq_ignore_ascii_case("parquet")) {
            self.write_parquet(path)
        } else {
            self.write_csv(path)
        }
    }

    fn write_parquet(&self, path: &Path) -> Result<(), FleetError> {
        let mut kinds = columns(&[]);
        if !self.manifest.parts.is_empty() {
            kinds.clear();
            for name in self.names()? {
                let empty = self.column(&name)?.map(|values| values.missing(0));
                kinds.extend(empty.map(|values| (name, values)));
            }
        }
        Ok(write_whole(path, |out| {
            let mut writer = ParquetWriter::new(&kinds)?;
            for part in &self.manifest.parts {
                let path = self.folder.join(&part.file);
                let rows = kinds.iter().map(|(name, kind)| {
                    let found = part_column(&path, name).map_err(io::Error::other)?;
                    Ok(found.unwrap_or_else(|| kind.missing(part.rows)))
                });
                writer.add(&rows.collect::<io::Result<Vec<_>>>()?)?;
            }
            out.write_all(&writer.bytes()?)
        })?)
    }

    fn write_csv(&self, path: &Path) -> Result<(), FleetError> {
        let names = self.names()?;
        Ok(write_whole(path, |out| {
            let mut writer = csv::Writer::from_writer(out);
            writer.write_record(&names)?;
            for part in &self.manifest.parts {
                let path = self.folder.join(&part.file);
                let column = |name: &String| part_column(&path, name).map_err(io::Error::other);
                let columns = names.iter().map(column).collect::<io::Result<Vec<_>>>()?;
                if columns.iter().flatten().any(|values| values.len() != part.rows) {
                    return Err(io::Error::other(rows_differ(&path)));
                }
                for row in 0..part.rows {
                    writer.write_record(columns.iter().map(|values| text(values.as_ref(), row)))?;
                }
            }
            writer.flush()
        })?)
    }
}

fn rows_differ(part: &Path) -> FleetError {
    let problem = "it has not as many rows as the manifest says".to_owned();
    FleetError::Damaged { path: part.to_owned(), problem }
}

/// A value as text; empty if it is missing.
fn text(values: Option<&Values>, row: usize) -> String {
    fn at<T>(values: &[Option<T>], row: usize) -> Option<&T> {
        values.get(row)?.as_ref()
    }
    let text = values.and_then(|values| match values {
        Values::Text(texts) => at(texts, row).cloned(),
        Values::Number(numbers) => at(numbers, row).map(f64::to_string),
        Values::Time(times) => at(times, row).and_then(|us| {
            let time = chrono::DateTime::from_timestamp_micros(*us)?;
            Some(time.to_rfc3339_opts(chrono::SecondsFormat::Micros, true))
        }),
    });
    text.unwrap_or_default()
}

/// Values after a number of rows without one.
fn after(rows: usize, values: Values) -> Values {
    fn padded<T>(rows: usize, values: Vec<Option<T>>) -> Vec<Option<T>> {
        std::iter::repeat_with(|| None).take(rows).chain(values).collect()
    }
    match values {
        Values::Text(values) => Values::Text(padded(rows, values)),
        Values::Number(values) => Values::Number(padded(rows, values)),
        Values::Time(values) => Values::Time(padded(rows, values)),
    }
}
