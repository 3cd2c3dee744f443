//! The windows that the regression in slip phases has tried.

use lissom::identify::Identified;
use lissom_report::{Cells, Table};

/// Table of the windows, with the chosen one; `None` without a regression.
pub fn window_table(id: &Identified) -> Option<Table> {
    let r = id.regression.as_ref()?;
    let mut table = Table::new(
        "Windows tried",
        &[
            ("window (s)", Cells::Numbers),
            ("rows", Cells::Numbers),
            ("slip phases", Cells::Numbers),
            ("residual torque (%)", Cells::Numbers),
            ("sensitivity (%)", Cells::Numbers),
            ("", Cells::Text),
        ],
    );
    for c in &r.candidates {
        let chosen = (c.window_s - r.window_s).abs() < 1e-12;
        let sensitivity = if c.sensitivity.is_finite() {
            format!("{:.3}", 100.0 * c.sensitivity)
        } else {
            "–".to_owned()
        };
        table = table.row([
            format!("{:.4}", c.window_s),
            c.rows.to_string(),
            c.clusters.to_string(),
            format!("{:.2}", 100.0 * c.relative_residual),
            sensitivity,
            (if chosen { "chosen" } else { "" }).to_owned(),
        ]);
    }
    Some(table)
}
