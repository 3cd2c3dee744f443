//! Checks of output files, so that a mistake such as `--json run.csv campaign.toml` does not destroy a log.

use std::fs::File;
use std::io::{BufRead as _, BufReader, Read as _};
use std::path::{Path, PathBuf};

use lissom_io::write::Batch;

use super::failure::Failure;

/// Refuses to overwrite a file that is not an earlier output: JSON begins with `{`, a page with `<`. Also refuses one
/// name for two outputs.
pub(crate) fn guard(json: Option<&Path>, report: Option<&Path>) -> Result<(), Failure> {
    if let Some(file) = json.filter(|file| report == Some(*file)) {
        return Err(Failure::SameOutput { file: file.to_owned() });
    }
    for (path, first) in [(json, b'{'), (report, b'<')] {
        if let Some(path) = path.filter(|p| begins_otherwise(p, first)) {
            return Err(Failure::NotAnOutput { file: path.to_owned() });
        }
    }
    Ok(())
}

/// Refuses to overwrite a file whose first character is another than `first`, with which all outputs of its kind begin.
pub(crate) fn guard_first(out: &Path, first: u8) -> Result<(), Failure> {
    if begins_otherwise(out, first) {
        return Err(Failure::NotAnOutput { file: out.to_owned() });
    }
    Ok(())
}

/// Refuses to overwrite a file without the text that all outputs of its kind have.
pub(crate) fn guard_marked(out: &Path, mark: &str) -> Result<(), Failure> {
    let marked = |bytes: Vec<u8>| bytes.windows(mark.len()).any(|part| part == mark.as_bytes());
    if !out.is_file() || std::fs::read(out).is_ok_and(marked) {
        return Ok(());
    }
    Err(Failure::NotAnOutput { file: out.to_owned() })
}

/// Refuses to overwrite an input.
pub(crate) fn guard_inputs(output: Option<&Path>, inputs: &[&Path]) -> Result<(), Failure> {
    let whole = |path: &Path| path.canonicalize().ok();
    let Some(file) = output.filter(|file| whole(file).is_some()) else { return Ok(()) };
    if inputs.iter().any(|input| whole(input) == whole(file)) {
        return Err(Failure::IsInput { file: file.to_owned() });
    }
    Ok(())
}

/// Refuses one name for two outputs, and files that cannot be written. Called before the work starts.
pub(crate) fn ready(files: &[&Path]) -> Result<(), Failure> {
    let whole = |path: &Path| -> PathBuf {
        let folder = path.parent().filter(|p| !p.as_os_str().is_empty());
        let folder = folder.unwrap_or(Path::new(".")).canonicalize();
        match (folder, path.file_name()) {
            (Ok(folder), Some(name)) => folder.join(name),
            _ => path.to_owned(),
        }
    };
    for (i, file) in files.iter().enumerate() {
        if files[..i].iter().any(|other| whole(other) == whole(file)) {
            return Err(Failure::SameOutput { file: (*file).to_owned() });
        }
    }
    files.iter().try_for_each(|file| Ok(Batch::probe(file)?))
}

/// Whether the first character of the file `path`, without blanks, is another than `first`. A file that cannot be read
/// fails later, when it is written.
fn begins_otherwise(path: &Path, first: u8) -> bool {
    if !path.is_file() {
        return false;
    }
    let Ok(file) = File::open(path) else { return false };
    let mut reader = BufReader::new(file);
    let Ok(start) = reader.fill_buf() else { return false };
    start.iter().find(|b| !b.is_ascii_whitespace()).is_some_and(|b| *b != first)
}

/// Refuses to overwrite a file that does not begin with `head`, as earlier outputs of this kind do.
pub(crate) fn guard_headed(path: &Path, head: &str) -> Result<(), Failure> {
    let mut start = String::new();
    // A file that cannot be read fails later, when it is written.
    let other = path.is_file()
        && File::open(path).is_ok_and(|f| {
            f.take(head.len() as u64).read_to_string(&mut start).is_err() || start != head
        });
    if other { Err(Failure::NotAnOutput { file: path.to_owned() }) } else { Ok(()) }
}
