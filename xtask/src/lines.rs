//! Lines of Rust code in the crates, without tests, comments and blank lines: `cargo xtask lines`.

use std::{
    collections::BTreeMap,
    fs,
    path::{Path, PathBuf},
};

use crate::step::Failure;

/// Folders of a crate that hold no code of the product.
const LEFT_OUT: [&str; 3] = ["tests", "benches", "examples"];

/// What is counted of a group of files.
#[derive(Default)]
struct Count {
    code: usize,
    comments: usize,
}

/// Prints the lines of each crate, of all, and of the folder `identify`, with the `//` comments in a hundred of them.
pub(crate) fn print(root: &Path) -> Result<(), Failure> {
    let mut files = Vec::new();
    rust_files(&root.join("crates"), &mut files)?;
    let mut counts: BTreeMap<String, Count> = BTreeMap::new();
    for path in files {
        let text = fs::read_to_string(&path).map_err(|source| failed(&path, source))?;
        let found = count(&text);
        let inside = path.strip_prefix(root.join("crates")).unwrap_or(&path);
        let name = |part: std::path::Component<'_>| part.as_os_str().to_string_lossy().into_owned();
        let parts: Vec<String> = inside.components().map(name).collect();
        let identify = parts[0] == "lissom-core" && parts.iter().any(|part| part == "identify");
        let groups = [Some("all"), Some(parts[0].as_str()), identify.then_some("identify")];
        for group in groups.into_iter().flatten() {
            let sum = counts.entry(group.to_owned()).or_default();
            sum.code += found.code;
            sum.comments += found.comments;
        }
    }
    let mut rows: Vec<_> = counts.into_iter().collect();
    rows.sort_by_key(|(_, count)| std::cmp::Reverse(count.code));
    println!("\n   code  // in 100");
    for (group, Count { code, comments }) in rows {
        println!("{code:7}  {:9.1}  {group}", 100.0 * comments as f64 / code.max(1) as f64);
    }
    Ok(())
}

/// Counts a file up to its module of tests.
fn count(text: &str) -> Count {
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let opens_tests = |k: usize| {
        let next = lines[k + 1..].iter().take(2).any(|l| l.starts_with("mod ") && l.ends_with('{'));
        lines[k].starts_with("#[cfg(test)]") && next
    };
    let end = (0..lines.len()).find(|k| opens_tests(*k)).unwrap_or(lines.len());
    let mut count = Count::default();
    for line in lines[..end].iter().filter(|line| !line.is_empty()) {
        if !line.starts_with("//") {
            count.code += 1;
        } else if !line.starts_with("///") && !line.starts_with("//!") {
            count.comments += 1;
        }
    }
    count
}

/// The files below a folder that belong to the product.
fn rust_files(folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), Failure> {
    let entries = fs::read_dir(folder).map_err(|source| failed(folder, source))?;
    for path in entries.flatten().map(|entry| entry.path()) {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        if path.is_dir() {
            if !LEFT_OUT.contains(&&*stem) {
                rust_files(&path, files)?;
            }
        } else if path.extension().is_some_and(|ending| ending == "rs")
            && stem != "tests"
            && !stem.ends_with("_tests")
        {
            files.push(path);
        }
    }
    Ok(())
}

fn failed(path: &Path, source: std::io::Error) -> Failure {
    Failure::File { path: path.display().to_string(), source }
}

#[cfg(test)]
mod tests {
    use super::count;

    #[test]
    fn tests_documentation_and_blank_lines_are_no_code() {
        let text = "//! A file.\n\nuse std::fs; // read\n// Why.\nfn f() {}\n\n#[cfg(test)]\nmod tests {\n    fn g() {}\n}\n";
        let found = count(text);
        assert_eq!((found.code, found.comments), (2, 1));
    }
}
