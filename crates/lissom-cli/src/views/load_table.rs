//! Table of the same beam with other loads: its poles move, its zeros do not.

use lissom_io::model::PayloadCase;
use lissom_views::digits::{change, roots_of, shown, trimmed};

use super::printer::{self, line};
use crate::tasks::any_beam::Beam;
use crate::tasks::load_study::counterpart;
use crate::tasks::model_task::Task;

/// Significant digits of frequencies and zeros.
const DIGITS: usize = 5;
/// Largest numbers of poles and of zeros in a row of the table.
const IN_A_ROW: usize = 2;

/// Prints poles and zeros for each load, with their change.
pub(crate) fn payloads(task: &Task<'_>, cases: &[PayloadCase]) {
    let first = &cases[0];
    let zeros = if first.zero_shift.is_some() { first.zeros.z.len().min(IN_A_ROW) } else { 0 };
    let modes = first.natural_frequencies_rad_s.len().min(IN_A_ROW);
    let mut heading = vec!["load".to_owned(), "[kg]".to_owned()];
    for k in 1..=modes {
        heading.extend([format!("mode {k} [rad/s]"), "change".to_owned()]);
    }
    for k in 1..=zeros {
        heading.extend([format!("zero {k} [rad/s]"), "change".to_owned()]);
    }
    let mut rows = vec![heading];
    for (index, case) in cases.iter().enumerate() {
        let name = match case.factor {
            _ if index == 0 => "as in the file".to_owned(),
            Some(factor) => format!("{}x", trimmed(factor, 4)),
            None => String::new(),
        };
        let mut row = vec![name, shown(case.tip_mass_kg, DIGITS)];
        for k in 0..modes {
            let own = first.natural_frequencies_rad_s[k];
            let found = case.natural_frequencies_rad_s.get(k);
            row.push(found.map_or(String::new(), |omega| shown(*omega, DIGITS)));
            row.push(found.filter(|_| index > 0).map_or(String::new(), |v| change(*v, own)));
        }
        for k in 0..zeros {
            let found = counterpart(&first.zeros, k, &case.zeros);
            row.push(found.map_or(String::new(), |z| roots_of(z, DIGITS)));
            let own = first.zeros.z[k].sqrt().norm();
            let found = found.filter(|_| index > 0);
            row.push(found.map_or(String::new(), |z| change(z.sqrt().norm(), own)));
        }
        rows.push(row);
    }
    printer::table(&rows);
    if let Some(sentence) = verdict(task.beam, cases) {
        line(&sentence);
    }
}

/// Relative distance above which zeros have moved; below it the difference is rounding.
const MOVED: f64 = 1e-9;

/// What the loads do to the zeros, in one sentence.
fn verdict(beam: &Beam, cases: &[PayloadCase]) -> Option<String> {
    let others = cases.get(1..)?;
    if others.is_empty() || cases[0].zero_shift.is_none() {
        return None;
    }
    if cases[0].zeros.z.is_empty() && others.iter().all(|c| c.zeros.z.is_empty()) {
        return Some("the tip's response has no zeros".to_owned());
    }
    let largest = others.iter().map(|c| c.zero_shift).try_fold(0.0, |m: f64, s| Some(m.max(s?)));
    Some(match largest {
        Some(shift) if shift <= MOVED => format!(
            "the zeros do not move (largest relative change of s² {}): at a zero the tip's mass is at \
             rest, so its size has no effect",
            shown(shift, 2)
        ),
        _ if beam.payload().turns() => "the zeros move: the load has rotary inertia or an offset, \
             and at a zero the tip does not move but turns"
            .to_owned(),
        _ => {
            "the zeros move although the load is a point mass: they are inaccurate, do not use them"
                .to_owned()
        }
    })
}
