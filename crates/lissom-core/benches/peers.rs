//! lissom's own estimates for `evidence/peers/run.py`, which compares them with those of other tools.
//!
//! `cargo bench -p lissom-core --bench peers -- FOLDER`: each `*.beam.csv` of the folder (length, EI and
//! mass of a span per line, base to tip) is measured with the `*.omega.csv` beside it. What comes
//! out stands in `*.lissom.json`.
#![expect(clippy::unwrap_used, reason = "whoever runs it reads the panic")]

use std::path::Path;
use std::time::{Duration, Instant};

use lissom::beam::{Base, LumpedBeam, Span};
use serde_json::json;

/// Natural frequencies found of each beam.
const MODES: usize = 20;

fn main() {
    // Cargo adds `--bench`. Without a folder there is nothing to measure.
    let Some(folder) = std::env::args().skip(1).find(|a| !a.starts_with('-')) else { return };
    let mut files: Vec<_> =
        std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    for file in &files {
        if let Some(name) = file.to_str().and_then(|path| path.strip_suffix(".beam.csv")) {
            measure(name);
        }
    }
}

fn measure(name: &str) {
    let spans: Vec<Span> = rows(Path::new(&format!("{name}.beam.csv")))
        .iter()
        .map(|row| Span {
            length_m: row[0],
            flexural_rigidity_n_m2: row[1],
            mass_kg: row[2],
            damping_n_s_per_m: 0.0,
        })
        .collect();
    let omega: Vec<f64> =
        rows(Path::new(&format!("{name}.omega.csv"))).into_iter().flatten().collect();
    let beam = LumpedBeam::new(&spans).unwrap();
    let (build_s, _) = median_s(|| LumpedBeam::new(&spans));
    let (tip_s, tip) = median_s(|| beam.tip_response(&omega));
    let tip: Vec<f64> = tip.iter().map(|g| g.re).collect();
    let (modes_s, modes) = median_s(|| beam.frequencies_rad_s(Base::Clamped, MODES));
    let estimates = json!({
        "build_s": build_s, "tip_s": tip_s, "tip": tip, "modes_s": modes_s, "modes_rad_s": modes,
    });
    std::fs::write(format!("{name}.lissom.json"), estimates.to_string()).unwrap();
}

/// Median time of a call \[s\] over at least 5 of them and, where they are short, 0.2 s; and what
/// it gave.
fn median_s<T>(f: impl Fn() -> T) -> (f64, T) {
    let start = Instant::now();
    let mut given = f();
    let mut times = Vec::new();
    while times.len() < 5 || (start.elapsed() < Duration::from_millis(200) && times.len() < 1000) {
        let begin = Instant::now();
        given = f();
        times.push(begin.elapsed().as_secs_f64());
    }
    times.sort_by(f64::total_cmp);
    (times[times.len() / 2], given)
}

fn rows(path: &Path) -> Vec<Vec<f64>> {
    let text = std::fs::read_to_string(path).unwrap();
    text.lines().map(|line| line.split(',').map(|v| v.parse().unwrap()).collect()).collect()
}
