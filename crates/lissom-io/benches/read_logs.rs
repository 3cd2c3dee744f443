//! lissom's own times and sums for `evidence/peers/logs.py`, which compares them with those of other tools.
//!
//! `cargo bench -p lissom-io --features full --bench read_logs -- FOLDER FILE`: the logs `FOLDER/csv/*.csv` on one thread and on
//! two, and each file of `FOLDER/binary` beside the decompression alone of `FOLDER/compressed/NAME.gz`, which has the
//! same values.
#![expect(clippy::unwrap_used, reason = "whoever runs it reads the panic")]

use std::fs;
use std::hint::black_box;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::time::Instant;

use flate2::read::MultiGzDecoder;
use lissom_core::record::Hold;
use lissom_io::log::{ColumnRef, LogColumn, LogOptions, read_log};
use rayon::prelude::*;
use serde_json::{Map, Value, json};

const REPEATS: usize = 11;

fn main() {
    // Cargo adds `--bench`. Without files there is nothing to do.
    let mut words = std::env::args().skip(1).filter(|word| !word.starts_with('-'));
    let (Some(folder), Some(file)) = (words.next(), words.next()) else { return };
    let logs = files(&Path::new(&folder).join("csv"));
    let text = [1, 2].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        median_s(|| pool.install(|| logs.par_iter().with_max_len(1).map(|log| sum(log)).collect()))
    });
    let mut binary = Map::new();
    for log in files(&Path::new(&folder).join("binary")) {
        let name = log.file_name().unwrap().to_string_lossy().into_owned();
        let (read_s, sums) = median_s(|| {
            let mut channels = lissom_formats::read(&log).unwrap().channels;
            channels.sort_by(|a, b| a.name.cmp(&b.name));
            channels.iter().map(|channel| channel.values.iter().sum()).collect()
        });
        let alone = Path::new(&folder).join("compressed").join(format!("{name}.gz"));
        let (alone_s, _) = median_s(|| {
            let mut out = Vec::new();
            MultiGzDecoder::new(&fs::read(&alone).unwrap()[..]).read_to_end(&mut out).unwrap();
            black_box(&out);
            Vec::new()
        });
        binary.insert(name, json!({ "read_s": read_s, "alone_s": alone_s, "sums": sums }));
    }
    let [(one_s, sums), (two_s, _)] = text;
    let found: Value = json!({ "one_s": one_s, "two_s": two_s, "sums": sums, "binary": binary });
    fs::write(file, found.to_string()).unwrap();
}

/// The sum of all columns of a log.
fn sum(log: &Path) -> f64 {
    let column = |name: &str| ColumnRef::Name(name.to_owned());
    let columns: Vec<LogColumn> = ["current_A", "motor_rad", "tip_rad"]
        .map(|name| LogColumn { column: column(name), hold: Hold::Measured })
        .into();
    let log = read_log(log, Some(&column("time_s")), &columns, &LogOptions::default()).unwrap();
    log.time.iter().chain(&log.columns).flatten().sum()
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let mut files: Vec<_> = fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    files.sort();
    files
}

/// Median time of a call \[s\], and what it returns.
fn median_s(mut call: impl FnMut() -> Vec<f64>) -> (f64, Vec<f64>) {
    let mut found = call();
    let mut times: Vec<f64> = (0..REPEATS)
        .map(|_| {
            let start = Instant::now();
            found = call();
            start.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    (times[REPEATS / 2], found)
}
