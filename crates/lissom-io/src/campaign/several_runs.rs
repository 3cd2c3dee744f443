//! Files with several runs: in groups of channels, or numbered by a column.

use std::path::Path;

use super::run_spec::RunSpec;
use crate::io_error::Error;
use crate::log::{ColumnRef, LogOptions, LogPath};

/// A run for each group that `FILE::GROUP` fits, and for each number in the column `run`.
pub(super) fn of_specs(
    folder: &Path,
    run: Option<&ColumnRef>,
    specs: &[RunSpec],
    options: &LogOptions,
) -> Result<Vec<RunSpec>, Error> {
    let mut runs = Vec::with_capacity(specs.len());
    for spec in specs {
        let path = LogPath::of(&folder.join(&spec.file));
        if path.group.is_none() && run.is_none() {
            runs.push(spec.clone());
            continue;
        }
        let groups = path.parts(&options.of_text())?;
        let several = groups.len() > 1;
        for group in groups {
            let parts = match run {
                Some(column) => group.by_run(column)?,
                None => vec![group],
            };
            let only = !several && run.is_none();
            runs.extend(parts.into_iter().map(|part| {
                let name = if only {
                    spec.name.clone()
                } else {
                    format!("{} {}", spec.title(), part.name)
                };
                RunSpec { name, part: Some(part), ..spec.clone() }
            }));
        }
    }
    Ok(runs)
}
