//! The library's examples.

use std::{env, fs, path::Path, process::Command};

use crate::step::{Failure, cargo, run, target_folder};

/// Largest number of lines of an example; longer ones are hard to read.
const MOST_LINES: usize = 60;

/// Runs each example and passes its output through.
pub(crate) fn run_all(root: &Path) -> Result<(), Failure> {
    // The packages and features of the tests of the workspace: they are built already.
    let all = ["build", "--workspace", "--features", "lissom-io/schema", "--examples"];
    run("examples", &mut cargo(root, &all))?;
    let target = target_folder(root);
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
        let program = target.join("debug/examples").join(name);
        let program = program.with_extension(env::consts::EXE_EXTENSION);
        run(name, Command::new(program).current_dir(root))?;
    }
    Ok(())
}
