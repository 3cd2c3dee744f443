//! The windows that the regression in slip phases has tried.

use lissom_io::ResultFile;
use lissom_report::{Cells, Table};

/// Table of the windows, with the chosen one; `None` without a regression.
pub fn window_table(result: &ResultFile) -> Option<Table> {
    let r = result.methods.regression.as_ref()?;
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
        let sensitivity = c.sensitivity.map(|s| format!("{:.3}", 100.0 * s));
        table = table.row([
            format!("{:.4}", c.window_s),
            c.rows.to_string(),
            c.phases.to_string(),
            format!("{:.2}", 100.0 * c.relative_residual),
            sensitivity.unwrap_or_else(|| "–".to_owned()),
            (if chosen { "chosen" } else { "" }).to_owned(),
        ]);
    }
    Some(table)
}
