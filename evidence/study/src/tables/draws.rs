//! The draws: ranges of the accepted campaigns, and reasons for rejected ones.

use std::collections::BTreeMap;
use std::fmt::Display;

use super::markdown::{percent, significant, table};
use super::{Outcome, drawn};
use crate::statistics::quantile;
use crate::stratum::Stratum;
use crate::study::Scored;

pub(super) fn section(outcome: &Outcome) -> String {
    let all = drawn(outcome);
    let rejected = all.iter().flat_map(|s| &s.rejected);
    let given_up: Vec<Stratum> = all.iter().flat_map(|s| s.given_up.iter().copied()).collect();
    let dropped = all.iter().flat_map(|s| &s.dropped);
    let range = |name: &str, of: fn(&Scored) -> f64, shown: fn(f64) -> String| {
        let values: Vec<f64> = all.iter().map(|s| of(s)).collect();
        let at = |share| quantile(&values, share).map_or_else(|| "–".to_owned(), shown);
        vec![name.to_owned(), at(0.0), at(0.05), at(0.5), at(0.95), at(1.0)]
    };
    let share = |v: f64| percent(Some(v));
    let ranges = [
        range("CF over peak torque", |s| s.coulomb_share, share),
        range("largest sticking share of a run", |s| s.stuck_share, share),
        range("runs", |s| s.runs.len() as f64, |v| format!("{v:.0}")),
        range("samples", |s| s.samples as f64, |v| format!("{v:.0}")),
        range(
            "longest wait [s]",
            |s| s.runs.iter().map(|r| r.waited_s).fold(0.0, f64::max),
            significant,
        ),
    ];
    format!(
        "## Draws\n\nIf a draw does not fit the ranges above, it is repeated up to 50 times with the same number of masses, \
         bits, kind of runs, sample time, noise, damping and planned share of friction. Then these are drawn anew, too.\n\n\
         {}\n\n{}\n\n{}\n\n{}",
        table(&["of the accepted campaigns", "least", "5 %", "median", "95 %", "most"], &ranges),
        table(&["rejected draws", "number"], &counted(rejected)),
        given_up_table(&all, &given_up),
        table(&["runs left out of the accepted campaigns", "number"], &counted(dropped)),
    )
}

/// The numbers of accepted campaigns and of strata that were given up, by the bits of the motor's encoder.
fn given_up_table(all: &[&Scored], given_up: &[Stratum]) -> String {
    let row = |(low, high): (u32, u32)| {
        let within = |s: &Stratum| (low..=high).contains(&s.motor_bits);
        vec![
            format!("{low}-{high}"),
            all.iter().filter(|s| within(&s.stratum)).count().to_string(),
            given_up.iter().filter(|s| within(s)).count().to_string(),
        ]
    };
    let rows: Vec<_> = [(10, 11), (12, 13), (14, 16)].into_iter().map(row).collect();
    table(&["bits of the motor's encoder", "campaigns", "given up after 50 draws"], &rows)
}

fn counted<T: Display>(reasons: impl Iterator<Item = T>) -> Vec<Vec<String>> {
    let mut counts = BTreeMap::new();
    for reason in reasons {
        *counts.entry(reason.to_string()).or_insert(0_usize) += 1;
    }
    let mut rows: Vec<(String, usize)> = counts.into_iter().collect();
    rows.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    rows.into_iter().map(|(reason, count)| vec![reason, count.to_string()]).collect()
}
