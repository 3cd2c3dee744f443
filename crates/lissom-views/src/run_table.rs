//! The runs of a result.

use lissom_io::ResultFile;
use lissom_io::result::{RunEntry, RunKindName};
use lissom_report::{Cells, Table};

/// Table of the runs: how each moves, which periods are used, and for how long it rests.
pub fn run_table(result: &ResultFile) -> Table {
    let mut table = Table::new(
        "Motion of each run",
        &[
            ("run", Cells::Text),
            ("ω0 (rad/s)", Cells::Numbers),
            ("periods used", Cells::Numbers),
            ("periods dropped", Cells::Numbers),
            ("sticking (%)", Cells::Numbers),
            ("saturated (%)", Cells::Numbers),
        ],
    );
    for run in &result.runs {
        let share = |s: f64| format!("{:.1}", 100.0 * s);
        let words = match (run.kind, &run.sinusoid) {
            (RunKindName::Sinusoidal, Some(s)) => format!("{:.4}", s.omega_rad_s),
            (RunKindName::ConstantVelocity, _) => constant_velocities(result, run),
            _ => "other motion".to_owned(),
        };
        let sinusoid = run.sinusoid.as_ref();
        let of_sinusoid = |s: Option<String>| s.unwrap_or_default();
        let cells = [
            run.name.clone(),
            words,
            of_sinusoid(sinusoid.map(|s| s.periods.to_string())),
            of_sinusoid(sinusoid.map(|s| s.dropped_periods.to_string())),
            of_sinusoid(sinusoid.and_then(|s| s.stuck_share).map(share)),
            share(run.saturated_share),
        ];
        table = table.row(cells);
    }
    table
}

fn constant_velocities(result: &ResultFile, run: &RunEntry) -> String {
    let points = result.methods.constant_velocity.iter().flat_map(|found| &found.points);
    match points.filter(|point| point.run == run.name).count() {
        0 => "constant velocities".to_owned(),
        count => format!("constant velocities ({count})"),
    }
}
