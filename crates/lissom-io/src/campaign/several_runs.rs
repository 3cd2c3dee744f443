//! Files with several runs: in groups of channels, or numbered by a column.

use super::memory_logs::LogPlaces;
use super::run_spec::RunSpec;
use crate::io_error::Error;
use crate::log::{ColumnRef, LastFile, LogOptions, LogPath};

/// A run for each group that `FILE::GROUP` fits, and for each number in the column `run`.
pub(super) fn of_specs(
    places: LogPlaces<'_>,
    run: Option<&ColumnRef>,
    specs: &[RunSpec],
    options: &LogOptions,
) -> Result<Vec<RunSpec>, Error> {
    let mut runs = Vec::with_capacity(specs.len());
    let mut files = LastFile::default();
    for spec in specs {
        let path = LogPath::of(&places.path(&spec.file));
        let in_memory = places.in_memory(&spec.file);
        if run.is_none() && (in_memory.is_some() || path.group.is_none()) {
            runs.push(RunSpec { part: in_memory, ..spec.clone() });
            continue;
        }
        let groups = match in_memory {
            Some(part) => vec![part],
            None => path.parts_of(files.content(&path, &options.of_text())?)?,
        };
        let several = groups.len() > 1;
        for group in groups {
            let (parts, mut without) = match run {
                Some(column) => {
                    let (parts, count, share) = group.by_run(column)?;
                    (parts, (count > 0).then_some((count, share)))
                }
                None => (vec![group], None),
            };
            let only = !several && run.is_none();
            runs.extend(parts.into_iter().map(|part| {
                let name = if only {
                    spec.name.clone()
                } else {
                    format!("{} {}", spec.title(), part.name)
                };
                RunSpec { name, part: Some(part), rows_without_run: without.take(), ..spec.clone() }
            }));
        }
    }
    Ok(runs)
}
