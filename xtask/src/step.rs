//! One step of a recipe: a title, a command, its time.

use std::{
    env, fmt, fs, io,
    path::{Path, PathBuf},
    process::{Command, Stdio},
    time::Instant,
};

/// Why a recipe stopped.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The command ran and failed.
    Step { title: String, command: String, status: std::process::ExitStatus },
    /// The command could not be started.
    Start { command: String, source: io::Error },
    /// A tool is missing; `install` gets it.
    Missing { tool: &'static str, install: &'static str },
    /// A tool could not be installed, or does not work.
    Install { tool: &'static str, output: String },
    /// Broken links of documents.
    Links { broken: Vec<String> },
    /// An example that is too long.
    Long { path: String, lines: usize, most: usize },
    /// A file that is too large to be published.
    Large { path: String, bytes: u64, most: u64 },
    /// A file or folder of the recipe could not be used.
    File { path: String, source: io::Error },
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Step { title, command, status } => {
                write!(f, "the step `{title}` failed ({status})\n  command: {command}")
            }
            Self::Start { command, source } => write!(f, "cannot start `{command}`: {source}"),
            Self::Missing { tool, install } => {
                write!(f, "{tool} is not installed\n  hint: {install}")
            }
            Self::Install { tool, output } => write!(f, "{tool} does not work: {}", output.trim()),
            Self::Links { broken } => {
                write!(f, "broken links:\n  {}", broken.join("\n  "))
            }
            Self::Long { path, lines, most } => {
                write!(f, "{path} has {lines} lines; an example may have at most {most}")
            }
            Self::Large { path, bytes, most } => {
                write!(f, "{path} has {bytes} bytes; it may have at most {most}")
            }
            Self::File { path, source } => write!(f, "cannot use {path}: {source}"),
        }
    }
}

/// The cargo that runs this program, in the workspace's folder, without input.
pub(crate) fn cargo(root: &Path, args: &[&str]) -> Command {
    let mut command = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.args(args).current_dir(root).stdin(Stdio::null());
    command
}

/// A folder under `target`, created if it is missing.
pub(crate) fn folder(root: &Path, name: &str) -> Result<PathBuf, Failure> {
    let folder = root.join("target").join(name);
    fs::create_dir_all(&folder)
        .map_err(|source| Failure::File { path: folder.display().to_string(), source })?;
    Ok(folder)
}

/// The folder that cargo builds into.
pub(crate) fn target_folder(root: &Path) -> PathBuf {
    env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), |given| root.join(given))
}

/// Runs one step and passes its output through.
pub(crate) fn run(title: &str, command: &mut Command) -> Result<(), Failure> {
    println!("\n--- {title}");
    let start = Instant::now();
    let status =
        command.status().map_err(|source| Failure::Start { command: shown(command), source })?;
    println!("--- {title}: {:.1} s", start.elapsed().as_secs_f64());
    if status.success() {
        return Ok(());
    }
    Err(Failure::Step { title: title.to_owned(), command: shown(command), status })
}

/// Runs a command without output; returns whether it succeeded, and the text of its error stream.
pub(crate) fn ask(command: &mut Command) -> Result<(bool, String), Failure> {
    let output =
        command.output().map_err(|source| Failure::Start { command: shown(command), source })?;
    Ok((output.status.success(), String::from_utf8_lossy(&output.stderr).into_owned()))
}

/// The command as a user would type it.
fn shown(command: &Command) -> String {
    let set = command.get_envs().filter_map(|(name, value)| {
        Some(format!("{}='{}'", name.to_string_lossy(), value?.to_string_lossy()))
    });
    let args = command.get_args().map(|arg| arg.to_string_lossy().into_owned());
    // Cargo by its name, whatever its path.
    let program = Path::new(command.get_program());
    let program = program.file_stem().unwrap_or(program.as_os_str()).to_string_lossy().into_owned();
    set.chain([program]).chain(args).collect::<Vec<_>>().join(" ")
}
