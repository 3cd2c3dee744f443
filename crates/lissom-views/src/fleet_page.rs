//! The page of a fleet: distributions, outliers and drift.

use std::collections::HashSet;

use lissom_fleet::{
    Drift, DriftValue, FailureCount, FindingCount, FleetSummary, LogOutlier, MachineOutlier,
    ParameterSummary, date,
};
use lissom_report::{Axis, Cells, LinePlot, Page, Role, Table, Trace, TraceStyle, significant};

use crate::digits::counted;

/// Most rows of a table; the JSON of the summary has all.
const ROWS_MOST: usize = 20;
/// Most plots of drifting machines for each parameter.
const DRIFTS_MOST: usize = 6;
/// Digits of values.
const DIGITS: usize = 4;
/// Smallest common change that is reported.
const COMMON_LEAST: f64 = 0.05;
/// Smallest spread of changes over their standard errors that is reported.
const SPREAD_LEAST: f64 = 2.0;
/// Relative changes that differ by less than this part of the larger one are about the same.
const ALIKE: f64 = 0.25;
/// Microseconds of a day.
const DAY_US: f64 = 86_400e6;

/// The page as one HTML document. `title` is its title.
pub fn page(title: &str, summary: &FleetSummary) -> String {
    let mut page = Page::new(title).summary(&in_words(summary));
    for line in conspicuous(summary) {
        page = page.paragraph(&line);
    }
    page = page.heading("Parameters").table(&parameter_table(summary));
    let mut plotted = HashSet::new();
    for (first, keys) in alike(summary) {
        for parameter in summary.parameters.iter().filter(|p| keys.contains(&p.key.as_str())) {
            page = one_parameter(page, parameter, (parameter.key != first.key).then_some(first));
            if parameter.key == first.key {
                page = conspicuous_tables(page, parameter, &mut plotted);
            }
        }
    }
    if !summary.failures.is_empty() {
        page = page.heading("Logs without a result").table(&failure_table(&summary.failures));
    }
    if !summary.findings.is_empty() {
        let table = finding_table(&summary.findings, summary.identified);
        page = page.heading("Findings").table(&table);
    }
    page.footer(&format!("lissom {}", summary.version)).to_html()
}

/// What the fleet is, in a sentence.
pub fn in_words(summary: &FleetSummary) -> String {
    let mut words =
        vec![format!("{} of {} identified", summary.identified, counted(summary.rows, "log"))];
    if summary.machines > 0 {
        words.push(format!("of {}", counted(summary.machines, "machine")));
    }
    if let Some((from, to)) = summary.span_us {
        words.push(format!("from {} to {}", date(from), date(to)));
    }
    words.join(", ") + "."
}

/// Parameters in which the same machines change, and the same machines and logs differ, by about the same share, as in Coulomb friction in each
/// direction: the first of them, with the keys of all. Parameters in which nothing does are alone.
pub fn alike(summary: &FleetSummary) -> Vec<(&ParameterSummary, Vec<&str>)> {
    let mut groups: Vec<(&ParameterSummary, Vec<&str>)> = Vec::new();
    for parameter in &summary.parameters {
        let same = groups.iter_mut().find(|(first, _)| is_alike(first, parameter));
        match same {
            Some((_, keys)) => keys.push(&parameter.key),
            None => groups.push((parameter, vec![&parameter.key])),
        }
    }
    groups
}

fn is_alike(a: &ParameterSummary, b: &ParameterSummary) -> bool {
    /// What is conspicuous: where, and by how much relative to what is expected.
    fn found(p: &ParameterSummary) -> Vec<(u8, &str, f64)> {
        let relative = |value: f64, expected: f64| value / expected - 1.0;
        let drifts =
            p.drifts.iter().map(|d| (0, d.machine.as_str(), d.relative_change.unwrap_or(f64::NAN)));
        let machines = p
            .outlying_machines
            .iter()
            .map(|m| (1, m.machine.as_str(), relative(m.value, m.expected)));
        let logs =
            p.outlying_logs.iter().map(|l| (2, l.log.as_str(), relative(l.value, l.expected)));
        let mut all: Vec<_> = drifts.chain(machines).chain(logs).collect();
        all.sort_by(|a, b| (a.0, a.1).cmp(&(b.0, b.1)));
        all
    }
    let (a, b) = (found(a), found(b));
    let same = |(a, b): (&(u8, &str, f64), &(u8, &str, f64))| {
        (a.0, a.1) == (b.0, b.1) && (a.2 - b.2).abs() <= ALIKE * a.2.abs().max(b.2.abs())
    };
    !a.is_empty() && a.len() == b.len() && a.iter().zip(&b).all(same)
}

/// What is conspicuous, a sentence for each parameter in which something is, or several that are alike.
pub fn conspicuous(summary: &FleetSummary) -> Vec<String> {
    let sentence = |(parameter, keys): (&ParameterSummary, Vec<&str>)| {
        let mut parts = Vec::new();
        let mut part = |count: usize, what: &str, one: &str, several: &str| match count {
            0 => {}
            1 => parts.push(format!("1 {what} {one}")),
            _ => parts.push(format!("{count} {what}s {several}")),
        };
        part(parameter.drifts.len(), "machine", "changes over time", "change over time");
        let [one, several] = ["differs from the others", "differ from the others"];
        part(parameter.outlying_machines.len(), "machine", one, several);
        part(parameter.outlying_logs.len(), "log", one, several);
        if let Some(change) = parameter.common_change.filter(|c| c.abs() >= COMMON_LEAST) {
            parts.push(format!("what all machines do changes it by {}", percent(change)));
        }
        if let Some(spread) = parameter.change_spread.filter(|s| *s >= SPREAD_LEAST) {
            let spread = significant(spread, 2);
            parts.push(format!(
                "changes of machines are {spread} times as large as scatter explains: many change, each in its own way"
            ));
        }
        (!parts.is_empty()).then(|| format!("{}: {}.", keys.join(", "), parts.join(", ")))
    };
    if summary.rows == 0 {
        return vec!["There are no rows yet.".to_owned()];
    }
    if summary.identified == 0 {
        return vec!["No log was identified.".to_owned()];
    }
    let found: Vec<String> = alike(summary).into_iter().filter_map(sentence).collect();
    if found.is_empty() { vec!["No machine or log is conspicuous.".to_owned()] } else { found }
}

/// Number with few digits.
fn number(value: f64) -> String {
    significant(value, DIGITS)
}

/// A share as a percentage with its sign.
pub fn percent(share: f64) -> String {
    let text = format!("{:+.1} %", 100.0 * share);
    text.replace('-', "−")
}

/// The distribution of each parameter, one row each.
pub fn parameter_table(summary: &FleetSummary) -> Table {
    let mut table = Table::new(
        "Distribution of each parameter over the logs, in the unit at the end of its key",
        &[
            ("parameter", Cells::Text),
            ("logs", Cells::Numbers),
            ("5 %", Cells::Numbers),
            ("median", Cells::Numbers),
            ("95 %", Cells::Numbers),
            ("spread", Cells::Numbers),
            ("typical standard error", Cells::Numbers),
            ("drifts", Cells::Numbers),
            ("outliers", Cells::Numbers),
        ],
    );
    for p in &summary.parameters {
        let d = &p.distribution;
        table = table.row([
            p.key.clone(),
            d.logs.to_string(),
            number(d.percent_5),
            number(d.median),
            number(d.percent_95),
            number(d.spread),
            number(d.typical_std),
            p.drifts.len().to_string(),
            (p.outlying_machines.len() + p.outlying_logs.len()).to_string(),
        ]);
    }
    table
}

/// Adds a parameter, with `like` one in which the same machines and logs are conspicuous.
fn one_parameter(
    page: Page,
    parameter: &ParameterSummary,
    like: Option<&ParameterSummary>,
) -> Page {
    let d = &parameter.distribution;
    let mut words = vec![format!(
        "{}, median {}, half of them between {} and {}.",
        counted(d.logs, "log"),
        number(d.median),
        number(d.percent_25),
        number(d.percent_75)
    )];
    if d.refused > 0 {
        words.push(format!("{} do not give it.", counted(d.refused, "log")));
    }
    if let Some(change) = parameter.common_change {
        words.push(format!(
            "What all machines do changes it by {} from the first log to the last; this is divided out below.",
            percent(change)
        ));
    }
    if let Some(like) = like {
        words.push(format!("The same machines and logs are conspicuous as in {}.", like.key));
    }
    let page = page.heading(&parameter.key).paragraph(&words.join(" "));
    page.figure(&histogram(parameter), &caption(parameter))
}

/// Adds the machines and logs that are conspicuous. Machines in `plotted` have a plot already: often several parameters of a
/// machine drift together.
fn conspicuous_tables<'a>(
    mut page: Page,
    parameter: &'a ParameterSummary,
    plotted: &mut HashSet<&'a str>,
) -> Page {
    if !parameter.drifts.is_empty() {
        page = page.table(&drift_table(&parameter.drifts));
        let new = parameter.drifts.iter().filter(|drift| plotted.insert(&drift.machine));
        for drift in new.take(DRIFTS_MOST) {
            let text = "Values without what all machines do; bars are standard errors.";
            page = page.figure(&drift_plot(&parameter.key, drift), text);
        }
    }
    if !parameter.outlying_machines.is_empty() {
        page = page.table(&machine_table(&parameter.outlying_machines));
    }
    if !parameter.outlying_logs.is_empty() {
        page = page.table(&log_table(&parameter.outlying_logs));
    }
    page
}

fn caption(parameter: &ParameterSummary) -> String {
    let h = &parameter.distribution.histogram;
    match (h.below, h.above) {
        (0, 0) => "Number of logs in each interval.".to_owned(),
        (below, above) => format!(
            "Number of logs in each interval; {below} are below and {above} above what is shown."
        ),
    }
}

/// Number of logs in each interval of a parameter.
pub fn histogram(parameter: &ParameterSummary) -> LinePlot {
    let h = &parameter.distribution.histogram;
    let middle = |k: usize| h.from + h.width * (k as f64 + 0.5);
    let x = (0..h.counts.len()).map(middle).collect();
    let y = h.counts.iter().map(|count| *count as f64).collect();
    LinePlot::new(parameter.key.clone(), Axis::linear(parameter.key.clone()), Axis::linear("logs"))
        .trace(Trace::new("", Role::Corrected, TraceStyle::Columns, x, y))
}

/// The values of a machine that drifts, over time in days from its first log.
pub fn drift_plot(key: &str, drift: &Drift) -> LinePlot {
    let first = drift.values.first().map_or(0, |value| value.time_us);
    let days = |time_us: i64| (time_us - first) as f64 / DAY_US;
    let last = drift.values.last().map_or(0.0, |value| days(value.time_us));
    let of = |part: &dyn Fn(&DriftValue) -> f64| drift.values.iter().map(part).collect();
    let line = vec![drift.first, drift.first + drift.change];
    LinePlot::new(
        format!("{}: {}", drift.machine, drift.relative_change.map_or_else(String::new, percent)),
        Axis::linear(format!("time from {} (days)", date(first))),
        Axis::linear(key),
    )
    .trace(Trace::points_with_bars(
        "logs",
        Role::Raw,
        of(&|v| days(v.time_us)),
        of(&|v| v.value),
        of(&|v| v.std),
    ))
    .trace(Trace::line("robust line", Role::Fitted, vec![0.0, last], line))
}

/// Machines that drift.
pub fn drift_table(drifts: &[Drift]) -> Table {
    let mut table = Table::new(
        rows_shown(
            "Machines that change over time, more than chance and more than the others",
            drifts.len(),
        ),
        &[
            ("machine", Cells::Text),
            ("logs", Cells::Numbers),
            ("first", Cells::Text),
            ("last", Cells::Text),
            ("level", Cells::Numbers),
            ("change", Cells::Numbers),
            ("relative", Cells::Numbers),
            ("z", Cells::Numbers),
        ],
    );
    for d in drifts.iter().take(ROWS_MOST) {
        let day = |value: Option<&DriftValue>| {
            value.map_or_else(String::new, |value| date(value.time_us))
        };
        table = table.row([
            d.machine.clone(),
            d.values.len().to_string(),
            day(d.values.first()),
            day(d.values.last()),
            number(d.level),
            number(d.change),
            d.relative_change.map_or_else(String::new, percent),
            format!("{:.1}", d.z),
        ]);
    }
    table
}

/// Machines that differ from the others.
pub fn machine_table(machines: &[MachineOutlier]) -> Table {
    let mut table = Table::new(
        rows_shown("Machines that differ from the others", machines.len()),
        &[
            ("machine", Cells::Text),
            ("logs", Cells::Numbers),
            ("value", Cells::Numbers),
            ("median of all", Cells::Numbers),
            ("z", Cells::Numbers),
        ],
    );
    for m in machines.iter().take(ROWS_MOST) {
        let z = format!("{:.1}", m.z);
        let logs = m.logs.to_string();
        table = table.row([m.machine.clone(), logs, number(m.value), number(m.expected), z]);
    }
    table
}

/// Logs that differ from the other logs of their machine, or from all.
pub fn log_table(logs: &[LogOutlier]) -> Table {
    let mut table = Table::new(
        rows_shown(
            "Logs that differ from the other logs of their machine, or from all if it is unknown",
            logs.len(),
        ),
        &[
            ("log", Cells::Text),
            ("machine", Cells::Text),
            ("value", Cells::Numbers),
            ("standard error", Cells::Numbers),
            ("expected", Cells::Numbers),
            ("z", Cells::Numbers),
        ],
    );
    for l in logs.iter().take(ROWS_MOST) {
        table = table.row([
            l.log.clone(),
            l.machine.clone().unwrap_or_default(),
            number(l.value),
            number(l.std),
            number(l.expected),
            format!("{:.1}", l.z),
        ]);
    }
    table
}

fn rows_shown(caption: &str, rows: usize) -> String {
    if rows <= ROWS_MOST {
        return caption.to_owned();
    }
    format!("{caption}: the first {ROWS_MOST} of {rows}")
}

/// Rows without a result, by kind.
pub fn failure_table(failures: &[FailureCount]) -> Table {
    let mut table = Table::new(
        "Logs without a result",
        &[
            ("failure", Cells::Text),
            ("logs", Cells::Numbers),
            ("for example", Cells::Text),
            ("message", Cells::Text),
        ],
    );
    for f in failures {
        let message = f.message.split_whitespace().collect::<Vec<_>>().join(" ");
        let row = [f.failure.clone(), f.rows.to_string(), f.log.clone(), message];
        table = table.row(row.map(|cell| cell.replace(char::is_control, "?")));
    }
    table
}

/// How many logs have each finding.
pub fn finding_table(findings: &[FindingCount], identified: usize) -> Table {
    let mut table = Table::new(
        "How many logs have each finding; the page Findings of the book explains the codes",
        &[
            ("finding", Cells::Text),
            ("severity", Cells::Text),
            ("logs", Cells::Numbers),
            ("share", Cells::Numbers),
        ],
    );
    for f in findings {
        let share = 100.0 * f.rows as f64 / identified.max(1) as f64;
        let (rows, share) = (f.rows.to_string(), format!("{share:.1} %"));
        table = table.row([f.code.clone(), f.severity.clone(), rows, share]);
    }
    table
}
