//! The library's examples.

use std::{fs, path::Path};

use crate::step::{Failure, cargo, run};

/// Largest number of lines of an example; longer ones are hard to read.
const MOST_LINES: usize = 60;

/// Runs each example and passes its output through.
pub(crate) fn run_all(root: &Path) -> Result<(), Failure> {
    let folder = root.join("crates/lissom/examples");
    let failed = |source| Failure::File { path: folder.display().to_string(), source };
    let entries = fs::read_dir(&folder).map_err(failed)?.collect::<Result<Vec<_>, _>>();
    let mut paths: Vec<_> = entries.map_err(failed)?.into_iter().map(|e| e.path()).collect();
    paths.sort();
    for path in paths {
        let lines = fs::read_to_string(&path).map_err(failed)?.lines().count();
        if lines > MOST_LINES {
            let path = path.display().to_string();
            return Err(Failure::Long { path, lines, most: MOST_LINES });
        }
        let Some(name) = path.file_stem().and_then(|name| name.to_str()) else { continue };
        let example = ["run", "--quiet", "--release", "--package", "lissom", "--example", name];
        run(name, &mut cargo(root, &example))?;
    }
    Ok(())
}
