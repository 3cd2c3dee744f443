//! Damaged files: cut off at every byte, and with every byte changed. None may stop the program, and none may take long.

#![expect(clippy::unwrap_used, reason = "tests")]

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use lissom_formats::{Format, LogData, read_bytes};

/// Longest time to read a damaged file of a few kB.
const LONGEST: Duration = Duration::from_secs(2);
/// Changes of a byte: one bit low, one bit high, all bits.
const CHANGES: [u8; 3] = [0x01, 0x80, 0xff];
/// Each byte of a larger file is changed in one of these ways only.
const SMALL: usize = 8192;

/// Whether this build reads a file.
fn is_read(path: &Path) -> bool {
    let name = path.to_str().unwrap();
    let needs = |ends: &[&str]| ends.iter().any(|end| name.ends_with(end));
    (cfg!(feature = "hdf5") || !needs(&[".h5", "_v73.mat"]))
        && (cfg!(feature = "mcap") || !needs(&[".mcap"]))
        && (cfg!(feature = "xlsx") || !needs(&[".xlsx"]))
        && (cfg!(feature = "parquet") || !needs(&[".parquet"]))
}

fn samples() -> Vec<(PathBuf, Vec<u8>)> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/files");
    let entries = std::fs::read_dir(folder).unwrap();
    let mut paths: Vec<PathBuf> =
        entries.map(|entry| entry.unwrap().path()).filter(|path| is_read(path)).collect();
    paths.sort();
    paths.into_iter().map(|path| (path.clone(), std::fs::read(path).unwrap())).collect()
}

fn same(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits())
}

/// Whether the channels of a file that is cut off are the first values of those of the whole file.
fn begins(cut: &LogData, whole: &LogData) -> bool {
    cut.channels.iter().all(|channel| {
        let mut named = whole.channels.iter().filter(|c| c.name == channel.name);
        named
            .any(|c| c.values.get(..channel.values.len()).is_some_and(|v| same(v, &channel.values)))
    })
}

/// Whether all channels that are left have all their values: a file that ends between two channels shows no damage.
fn lacks_whole_channels(cut: &LogData, whole: &LogData) -> bool {
    let whole = |name: &str, length: usize| {
        whole.channels.iter().any(|c| c.name == name && c.values.len() == length)
    };
    cut.channels.iter().all(|c| whole(&c.name, c.values.len()))
}

#[test]
fn a_file_that_is_cut_off_is_an_error_or_a_shorter_log_with_a_note() {
    for (path, bytes) in samples() {
        let whole = read_bytes(bytes.clone()).unwrap();
        for length in 0..bytes.len() {
            let begun = Instant::now();
            let cut = read_bytes(bytes[..length].to_vec());
            assert!(begun.elapsed() < LONGEST, "{}: {length} bytes", path.display());
            let Ok(cut) = cut else { continue };
            let place = format!("{}: {length} bytes: {:?}", path.display(), cut.notes);
            assert!(begins(&cut, &whole), "{place}");
            // A log of records or segments may end between two of them.
            let has_parts = matches!(cut.format, Format::WpiLog | Format::Tdms);
            let unseen = lacks_whole_channels(&cut, &whole) || has_parts;
            assert!(unseen || !cut.notes.is_empty(), "{place}");
        }
    }
}

#[test]
fn a_changed_byte_never_stops_the_program() {
    for (path, bytes) in samples() {
        for place in 0..bytes.len() {
            for (k, change) in CHANGES.into_iter().enumerate() {
                if bytes.len() > SMALL && k != place % CHANGES.len() {
                    continue;
                }
                let mut changed = bytes.clone();
                changed[place] ^= change;
                let begun = Instant::now();
                let _ = read_bytes(changed);
                assert!(begun.elapsed() < LONGEST, "{}: byte {place}", path.display());
            }
        }
    }
}
