//! The runs of a result.

use lissom::identify::{Identified, RunKind};
use lissom_report::{Cells, Table};

/// Table of the runs: how each moves, which periods are used, and for how long it rests.
pub fn run_table(id: &Identified) -> Table {
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
    for run in &id.runs {
        let share = |s: f64| format!("{:.1}", 100.0 * s);
        let cells = match &run.kind {
            RunKind::Sinusoidal(s) => [
                run.name.clone(),
                format!("{:.4}", s.omega_rad_s),
                s.steady.periods.to_string(),
                s.steady.dropped.to_string(),
                run.stuck_share.map_or_else(String::new, share),
                share(run.saturated_share),
            ],
            RunKind::ConstantVelocity => [
                run.name.clone(),
                format!("constant velocities ({})", run.steady.len()),
                String::new(),
                String::new(),
                String::new(),
                share(run.saturated_share),
            ],
            RunKind::General => [
                run.name.clone(),
                "other motion".to_owned(),
                String::new(),
                String::new(),
                String::new(),
                share(run.saturated_share),
            ],
        };
        table = table.row(cells);
    }
    table
}
