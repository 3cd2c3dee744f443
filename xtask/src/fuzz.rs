//! A short run of every fuzz target: `cargo xtask fuzz [INPUTS]`. Longer runs are described in `fuzz/README.md`.

use std::fs;
use std::path::Path;

use crate::step::{Failure, ask, cargo, run};

/// Inputs of each target.
const INPUTS: &str = "20000";
/// The same inputs each time: a change is not blamed for what another seed finds. The time of one input allows for a busy machine, and
/// that of all for a slow one.
const LIMITS: [&str; 5] =
    ["-seed=1", "-timeout=30", "-max_total_time=15", "-rss_limit_mb=1024", "-max_len=65536"];

/// Runs each target on its corpus and on changes of it, which are not kept.
pub(crate) fn short_run(root: &Path, flags: &[String]) -> Result<(), Failure> {
    let (installed, _) = ask(&mut cargo(root, &["fuzz", "--version"]))?;
    if !installed {
        return Err(Failure::Missing {
            tool: "cargo-fuzz",
            install: "cargo install cargo-fuzz --locked",
        });
    }
    let inputs = flags.first().map_or(INPUTS, String::as_str);
    let file = |path: &Path| {
        let path = path.display().to_string();
        move |source| Failure::File { path, source }
    };
    let corpora = root.join("fuzz/corpus");
    let entries = fs::read_dir(&corpora).map_err(file(&corpora))?;
    let mut targets: Vec<String> =
        entries.flatten().map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    targets.sort();
    for target in &targets {
        let folder = root.join("target/fuzz-short").join(target);
        fs::create_dir_all(&folder).map_err(file(&folder))?;
        let corpus = corpora.join(target);
        // A sanitizer would need nightly; the development profile is built in a fraction of the time.
        let mut command = cargo(root, &["fuzz", "run", "-s", "none", "--dev", target.as_str()]);
        command.arg(&folder).arg(&corpus).arg("--").args(LIMITS);
        command.arg(format!("-runs={inputs}")).arg("-verbosity=0");
        run(&format!("fuzz {target}, {inputs} inputs"), &mut command)?;
    }
    Ok(())
}
