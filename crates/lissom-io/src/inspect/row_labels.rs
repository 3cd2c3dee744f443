//! A column that tells which run, or which joint, each row of a log is of.

use std::collections::HashSet;

use lissom_formats::{Channel, LogData};

use super::inspected_channel::InspectedChannel;

/// Most values of such a column.
const MOST_VALUES: usize = 1000;
/// Least number of rows for each value.
const LEAST_ROWS: usize = 8;

/// A column that tells which run, or which joint, each row is of.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RowLabels {
    /// Index of the channel.
    pub channel: usize,
    /// Its values, in the order in which they appear.
    pub values: Vec<String>,
    /// How they are ordered.
    pub order: LabelOrder,
}

/// How the values of a column of labels are ordered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LabelOrder {
    /// Each value is in rows of its own, and the time starts again at the next one: these are runs.
    Restarts,
    /// Each value is in rows of its own, one after the other.
    Blocks,
    /// The values take turns: the rows are of several joints or topics.
    InTurn,
}

impl RowLabels {
    /// The column of labels of a log with these time stamps, if it has one.
    pub(super) fn of(
        data: &LogData,
        channels: &[InspectedChannel],
        time: Option<usize>,
    ) -> Option<Self> {
        let stamps = time.map(|k| &data.channels[k].values[..]);
        let all = data.channels.iter().zip(channels).enumerate();
        let candidates = all.filter(|(k, (_, facts))| Some(*k) != time && facts.relation.is_none());
        let found: Vec<Self> = candidates
            .filter_map(|(k, (channel, _))| {
                let (values, order) = labels(channel, stamps)?;
                Some(Self { channel: k, values, order })
            })
            .collect();
        let of = |order: LabelOrder| found.iter().find(move |labels| labels.order == order);
        of(LabelOrder::InTurn)
            .or_else(|| of(LabelOrder::Restarts))
            .or_else(|| of(LabelOrder::Blocks))
            .cloned()
    }
}

impl RowLabels {
    /// What it says, for a log with this name.
    pub(super) fn note(&self, name: &str, file: &str) -> String {
        let count = self.values.len();
        match self.order {
            LabelOrder::Restarts => format!(
                "{name} has {count} values, and the time starts again with each: the rows of each are a run"
            ),
            LabelOrder::Blocks => format!(
                "{name} has {count} values, each in rows of its own: if these are runs, give it as the column of the runs"
            ),
            LabelOrder::InTurn => Self::in_turn(name, file, &self.values),
        }
    }

    /// That rows are of several joints or topics, and how to give one of them.
    pub(super) fn in_turn(name: &str, file: &str, values: &[String]) -> String {
        let first: Vec<String> =
            values.iter().take(5).map(|value| format!("\"{value}\"")).collect();
        let more = if values.len() > first.len() { ", ..." } else { "" };
        format!(
            "column {name} alternates between {}{more}: each row belongs to one of them. Select one, as in \"{file}::{name}={}\"",
            first.join(", "),
            values.first().map_or("", String::as_str)
        )
    }
}

/// The values of a channel and their order, if they are labels of rows.
fn labels(channel: &Channel, stamps: Option<&[f64]>) -> Option<(Vec<String>, LabelOrder)> {
    let rows = channel.values.len();
    let number = |row: usize| {
        let value = channel.values[row];
        (value.fract() == 0.0 && value.abs() < 1e6).then(|| value.to_string())
    };
    let label = |row: usize| match &channel.words {
        Some(words) => words.at(row).map(str::to_owned),
        None => number(row),
    };
    let mut known = HashSet::new();
    let (mut values, mut last): (Vec<String>, Option<String>) = (Vec::new(), None);
    let (mut changes, mut restarts) = (0_usize, 0_usize);
    for row in 0..rows {
        let Some(value) = label(row) else {
            // A number with a fraction labels nothing.
            if channel.words.is_none() && channel.values[row].is_finite() {
                return None;
            }
            continue;
        };
        if last.as_ref() == Some(&value) {
            continue;
        }
        if last.is_some() {
            changes += 1;
            let goes_back = |t: &&[f64]| t.len() == rows && t[row] < t[row - 1];
            restarts += usize::from(stamps.as_ref().is_some_and(goes_back));
        }
        if known.insert(value.clone()) {
            values.push(value.clone());
            if values.len() > MOST_VALUES {
                return None;
            }
        }
        last = Some(value);
    }
    if values.len() < 2 || rows < LEAST_ROWS * values.len() {
        return None;
    }
    let in_blocks = changes + 1 == values.len();
    let order = if in_blocks && restarts == changes {
        LabelOrder::Restarts
    } else if channel.words.is_some() && in_blocks {
        LabelOrder::Blocks
    } else if channel.words.is_some() && 2 * changes > rows {
        LabelOrder::InTurn
    } else {
        return None;
    };
    Some((values, order))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inspect::inspect;

    fn of(rows: impl Iterator<Item = String>) -> Option<RowLabels> {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("log.csv");
        std::fs::write(&file, "trial,t [s],q [rad]\n".to_owned() + &rows.collect::<String>())
            .unwrap();
        inspect(&file).unwrap().labels
    }

    fn row(label: &str, k: usize, step: usize) -> String {
        let t = 0.001 * (k / step) as f64;
        format!("{label},{t:.3},{:.6}\n", (9.0 * t).sin())
    }

    #[test]
    fn runs_joints_and_phases() {
        let runs = of((0..300).map(|k| row(["a", "b", "c"][k / 100], k % 100, 1))).unwrap();
        assert_eq!((runs.order, runs.values.len()), (LabelOrder::Restarts, 3));
        let numbers = of((0..300).map(|k| row(["4", "7", "2"][k / 100], k % 100, 1))).unwrap();
        assert_eq!(numbers.order, LabelOrder::Restarts);
        assert_eq!(numbers.values, ["4", "7", "2"]);
        let joints = of((0..300).map(|k| row(["elbow", "wrist"][k % 2], k, 2))).unwrap();
        assert_eq!(joints.order, LabelOrder::InTurn);
        let phases = of((0..300).map(|k| row(["go", "stop"][k / 150], k, 1))).unwrap();
        assert_eq!(phases.order, LabelOrder::Blocks);
        let state = of((0..300).map(|k| row(["0", "1"][k / 20 % 2], k, 1)));
        assert_eq!(state, None);
    }
}
