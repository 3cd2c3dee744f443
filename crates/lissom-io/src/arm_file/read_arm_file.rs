//! Reads an `arm.toml`.

use std::path::Path;

use super::arm_spec::ArmFile;
use super::{beam_spec, drive_spec, load_spec, mode_specs, rig_spec, tip_spec};
use crate::config::{ConfigError, Source, Table, Value};
use crate::io_error::Error;

impl ArmFile {
    /// Reads an `arm.toml`.
    ///
    /// # Errors
    /// [`Error::Config`] if a key or value is wrong.
    pub fn read(path: &Path) -> Result<Self, Error> {
        Ok(Self::from_source(&Source::read(path)?)?)
    }

    /// Reads the text of an `arm.toml`; `path` is the file's name in errors.
    ///
    /// ```
    /// let text = "[rig]\nsample_time = \"3 ms\"";
    /// let arm = lissom_io::ArmFile::from_text("arm.toml".as_ref(), text)?;
    /// assert_eq!(arm.rig.map(|rig| rig.instruments.sample_time_s), Some(0.003));
    /// # Ok::<(), lissom_io::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Config`] if a key or value is wrong.
    pub fn from_text(path: &Path, text: &str) -> Result<Self, Error> {
        Ok(Self::from_source(&Source::new(path, text.to_owned()))?)
    }

    fn from_source(source: &Source) -> Result<Self, ConfigError> {
        let document = source.parse()?;
        let root = source.root(&document);
        root.only("beam drive load tip rig")?;
        let table = root.optional("beam", Value::table)?;
        let rigid = table.as_ref().map_or(Ok(false), rigid)?;
        let (by_modes, by_spans) = match table {
            _ if rigid => (None, None),
            Some(table) if table.get("modes").is_some() => (Some(table), None),
            other => (None, other),
        };
        let load = root.optional("load", |v| load_spec::load(&v.table()?))?;
        let gravity = load.map(|load| load.gravity());
        Ok(Self {
            beam: by_spans.map(|t| beam_spec::beam(&t)).transpose()?,
            modes: by_modes.map(|t| mode_specs::modes(&t)).transpose()?,
            rigid,
            drive: root.optional("drive", |v| drive_spec::drive(&v.table()?, gravity))?,
            load,
            tip: root.optional("tip", |v| tip_spec::tip(&v.table()?))?,
            rig: root.optional("rig", |v| rig_spec::rig(&v.table()?))?,
        })
    }
}

/// Whether `[beam]` has `rigid = true`.
fn rigid(table: &Table<'_>) -> Result<bool, ConfigError> {
    let Some(value) = table.get("rigid") else { return Ok(false) };
    if !value.truth()? {
        return Err(value.kind("true (or `spans` or `modes` instead)"));
    }
    table.only("rigid")?;
    Ok(true)
}
