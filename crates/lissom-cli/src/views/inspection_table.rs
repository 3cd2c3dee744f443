//! A log, described before anything is known about it.

use std::fmt::Write as _;

use lissom_io::inspect::{
    CampaignDraft, Description, DraftError, InspectedChannel, Inspection, LabelOrder, Relation,
    Role, UnitSource,
};
use lissom_views::digits::{counted, trimmed};

use super::printer::{line, table, wrapped};
use crate::shared::command_hint::option;
use crate::shared::shell_word::shell_word;
use crate::tasks::described_logs::tip_option;

/// Significant digits of values.
const DIGITS: usize = 4;
/// Characters of the picture of a channel.
const PICTURE: usize = 24;
/// Width of a line.
const WIDTH: usize = 96;
/// Heights of a picture.
const HEIGHTS: [char; 8] = ['▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];

/// Prints what a log contains.
pub(crate) fn print(log: &Inspection) {
    let rows = log.channels.iter().map(|c| c.facts.values).max().unwrap_or(0);
    line(&format!(
        "{}: {}, {}, {}",
        log.file.display(),
        log.format.name(),
        counted(log.channels.len(), "channel"),
        counted(rows, "row")
    ));
    clock(log);
    line("");
    let head = ["channel", "unit", "smallest", "largest", "step", "over time"].map(str::to_owned);
    let mut cells = vec![head.to_vec()];
    cells.extend(log.channels.iter().enumerate().map(|(k, c)| row(log, k, c)));
    table(&cells);
    let mut remarks: Vec<String> = log.channels.iter().flat_map(|c| remarks(log, c)).collect();
    remarks.extend(log.notes.iter().cloned());
    if !remarks.is_empty() {
        line("");
        line("remarks");
        for text in &remarks {
            item(text);
        }
    }
    line("");
    line("probably");
    for (role, guess) in log.roles.all() {
        let label = log.channels[guess.channel].label();
        line(&format!("  {:<8} {label}: {}", role.name(), guess.why));
    }
    next(log);
}

/// A remark of several lines.
fn item(text: &str) {
    for (k, part) in wrapped(text, WIDTH).iter().enumerate() {
        line(&format!("{}{part}", if k == 0 { "  " } else { "    " }));
    }
}

fn number(value: f64) -> String {
    if value.is_finite() { trimmed(value, DIGITS).replace('-', "−") } else { "–".to_owned() }
}

fn clock(log: &Inspection) {
    let Some(clock) = &log.clock else {
        return line("no channel looks like time stamps");
    };
    let time = log.roles.all().first().map(|(_, guess)| &log.channels[guess.channel]);
    let unit = time.and_then(|c| c.unit.as_ref()).map_or("(unit not stated)", |u| u.text.as_str());
    let mut text = format!(
        "time stamps every {} {unit}, over {} {unit}",
        number(clock.step),
        number(clock.length)
    );
    let [least, most] = clock.steps;
    if most - least > 0.01 * clock.step {
        let _ = write!(text, "; steps from {} to {}", number(least), number(most));
    }
    for (count, what) in [(clock.gaps, "gap"), (clock.repeated, "repeated stamp")] {
        if count > 0 {
            let _ = write!(text, "; {}", counted(count, what));
        }
    }
    if clock.back > 0 {
        let _ = write!(text, "; time goes back {}", counted(clock.back, "time"));
    }
    line(&text);
}

fn row(log: &Inspection, index: usize, channel: &InspectedChannel) -> Vec<String> {
    let facts = &channel.facts;
    let unit = channel.unit.as_ref().map_or_else(|| "–".to_owned(), |u| u.text.clone());
    let step = match (facts.step, facts.bits()) {
        (Some(step), Some(bits)) => format!("{} ({bits} bits)", number(step)),
        _ => "–".to_owned(),
    };
    let [low, high] = facts.range;
    let name = format!("{:>2} {}", channel.number, channel.name);
    vec![name, unit, number(low), number(high), step, picture(&log.data.channels[index].values)]
}

/// The values over time in a line of characters: of each stretch the value that is farthest from the middle.
fn picture(values: &[f64]) -> String {
    let present = || values.iter().copied().filter(|v| v.is_finite());
    let low = present().fold(f64::INFINITY, f64::min);
    let high = present().fold(f64::NEG_INFINITY, f64::max);
    if high <= low || values.len() < PICTURE {
        return String::new();
    }
    let middle = 0.5 * (low + high);
    let stretch = values.len().div_ceil(PICTURE);
    let shown = values.chunks(stretch).map(|part| {
        let known = part.iter().copied().filter(|v| v.is_finite());
        let far = known.max_by(|a, b| (a - middle).abs().total_cmp(&(b - middle).abs()));
        far.map_or(' ', |value| {
            let height = ((value - low) / (high - low) * 7.0).round();
            HEIGHTS
                .iter()
                .copied()
                .enumerate()
                .min_by(|(a, _), (b, _)| {
                    (*a as f64 - height).abs().total_cmp(&(*b as f64 - height).abs())
                })
                .map_or(' ', |(_, c)| c)
        })
    });
    shown.collect()
}

fn remarks(log: &Inspection, channel: &InspectedChannel) -> Vec<String> {
    let facts = &channel.facts;
    let label = channel.label();
    let percent = |share: f64| format!("{} %", trimmed(100.0 * share, 2));
    let mut all = Vec::new();
    if log
        .labels
        .as_ref()
        .is_some_and(|labels| log.channels[labels.channel].number == channel.number)
    {
        return all;
    }
    if let Some((row, found)) = &channel.not_a_number {
        let place = if *row > 0 { format!(" in row {row}") } else { String::new() };
        all.push(format!("{label}: \"{found}\"{place} is not a number"));
    }
    if facts.constant && facts.missing < facts.values {
        all.push(format!("{label}: never changes (not connected?)"));
    }
    if facts.missing > 0 {
        all.push(format!("{label}: {} of {} values are missing", facts.missing, facts.values));
    }
    for (share, end) in facts.at_end_share.into_iter().zip(["smallest", "largest"]) {
        if let Some(share) = share {
            all.push(format!(
                "{label}: stays at its {end} value for {} of the time",
                percent(share)
            ));
        }
    }
    let is_time = log.roles.of(Role::Time).is_some_and(|time| time.channel + 1 == channel.number);
    if facts.wraps > 0 && !is_time {
        all.push(format!(
            "{label}: jumps by its whole range, {}: an angle that starts again after a turn",
            counted(facts.wraps, "time")
        ));
    }
    let of = |index: usize| log.channels[index].label();
    match channel.relation {
        Some(Relation::Multiple { of: index, factor }) => {
            all.push(format!("{label}: is {} × {}", number(factor), of(index)));
        }
        Some(Relation::Rate { of: index, factor }) => {
            all.push(format!("{label}: is {} × the rate of {}", number(factor), of(index)));
        }
        None => {}
    }
    if let Some(unit) = &channel.unit {
        if unit.known.is_none() {
            all.push(format!("{label}: its unit \"{}\" is not known", unit.text));
        } else if unit.source == UnitSource::Name {
            all.push(format!("{label}: its unit {} is the end of its name", unit.text));
        }
    }
    all
}

/// The command to run next.
fn next(log: &Inspection) {
    let file = log.file.display().to_string();
    if let Some(labels) = log.labels.as_ref().filter(|l| l.order == LabelOrder::InTurn) {
        let column = log.channels[labels.channel].asked();
        let rows = format!("{file}::{column}={}", labels.values[0]);
        line("");
        return line(&format!("next: lissom identify {}", shell_word(&rows)));
    }
    let Ok(draft) =
        CampaignDraft::new(log, std::slice::from_ref(&log.file), &Description::default())
    else {
        return;
    };
    line("");
    match draft.text() {
        Ok(_) => {
            let tip = tip_option(log).map_or_else(String::new, |option| format!(" {option}"));
            line(&format!("next: lissom identify {}{tip}", shell_word(&file)));
        }
        Err(missing) => {
            let text = missing.to_string();
            item(text.strip_prefix(&format!("{file}: ")).unwrap_or(&text));
            let stated = draft.missing().filter_map(DraftError::statement);
            let options: Vec<String> = stated.map(|(key, value)| option(key, &value)).collect();
            line("");
            line(&format!(
                "next, with units in place of UNIT: lissom identify {} {}",
                shell_word(&file),
                options.join(" ")
            ));
        }
    }
}
