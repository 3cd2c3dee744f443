//! Table of Coulomb friction: printed in the 1989 report, and estimated here.

use std::path::Path;

use super::printer;
use crate::tasks::printed_coulomb::CoulombRow;

pub(crate) fn report(out: &Path, rows: &[CoulombRow]) {
    let head = ["Coulomb friction [A]", "printed in 6.2.2", "here", "standard error"];
    let mut table = vec![head.map(str::to_owned).to_vec()];
    for r in rows {
        let printed = r.printed_a.map_or_else(String::new, |v| format!("{v:.3}"));
        let here = r.here.map_or_else(|| "refused".to_owned(), |e| format!("{:.4}", e.value));
        let std =
            r.here.filter(|e| e.std > 0.0).map_or_else(String::new, |e| format!("{:.4}", e.std));
        table.push(vec![r.name.to_owned(), printed, here, std]);
    }
    printer::table(&table);
    printer::line("");
    printer::line(&format!(
        "figure-6 (motor), figure-7 (beam) and figure-8 (friction) are in {}, the logs in {}",
        out.display(),
        out.join("logs").display()
    ));
}
