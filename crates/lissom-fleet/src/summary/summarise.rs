//! Summary of a fleet.

use std::collections::HashMap;

use lissom_io::fleet::{FailureCount, FindingCount, FleetSummary, ParameterSummary};

use super::distribution::distribution;
use super::drift::drifts;
use super::log_value::LogValue;
use super::machines::machines;
use super::outliers::outliers;
use crate::fleet_error::FleetError;
use crate::store::{FAILURE, FleetTable, LOG, MACHINE, TIME, Values, std_of};
use crate::version::VERSION;

/// Options of a summary.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SummaryOptions {
    /// Share of the drifts, and of the outliers, that may be chance.
    pub false_share: f64,
}

impl Default for SummaryOptions {
    fn default() -> Self {
        Self { false_share: 0.05 }
    }
}

/// Summarises the rows of a fleet.
///
/// # Errors
/// [`FleetError::Read`] or [`FleetError::Damaged`] if a part cannot be read.
pub fn summarise(table: &FleetTable, options: SummaryOptions) -> Result<FleetSummary, FleetError> {
    let logs = texts(table, LOG)?;
    let of_machine = texts(table, MACHINE)?;
    let times = match table.column(TIME)? {
        Some(Values::Time(times)) => times,
        _ => vec![None; logs.len()],
    };
    let failures = failures(&logs, &texts(table, FAILURE)?, &texts(table, "message")?);
    let identified = table.rows() - failures.iter().map(|f| f.rows).sum::<usize>();
    let known = times.iter().flatten();
    let mut names: Vec<&str> = of_machine.iter().flatten().map(String::as_str).collect();
    names.sort_unstable();
    names.dedup();
    let mut parameters = Vec::new();
    for key in table.parameters()? {
        let (values, stds) = (numbers(table, &key)?, numbers(table, &std_of(&key))?);
        let all = values.iter().zip(&stds).enumerate();
        let given: Vec<LogValue<'_>> = all
            .filter_map(|(row, (value, std))| {
                Some(LogValue {
                    log: logs.get(row)?.as_deref()?,
                    machine: of_machine.get(row)?.as_deref(),
                    time_us: *times.get(row)?,
                    value: (*value)?,
                    std: (*std)?,
                })
            })
            .collect();
        parameters.extend(parameter(key, &given, identified, options));
    }
    Ok(FleetSummary {
        version: VERSION.to_owned(),
        rows: table.rows(),
        identified,
        failures,
        findings: findings(table)?,
        machines: names.len(),
        span_us: known.clone().min().copied().zip(known.max().copied()),
        parameters,
    })
}

fn parameter(
    key: String,
    given: &[LogValue<'_>],
    identified: usize,
    options: SummaryOptions,
) -> Option<ParameterSummary> {
    let values: Vec<f64> = given.iter().map(|v| v.value).collect();
    let stds: Vec<f64> = given.iter().map(|v| v.std).collect();
    let distribution = distribution(&values, &stds, identified)?;
    let machines = machines(given);
    let (drifts, change_spread) = drifts(&machines.all, options.false_share);
    let (outlying_logs, outlying_machines) = outliers(&machines.all, options.false_share);
    Some(ParameterSummary {
        key,
        distribution,
        common_change: machines.common_change,
        change_spread,
        drifts,
        outlying_machines,
        outlying_logs,
    })
}

fn texts(table: &FleetTable, name: &str) -> Result<Vec<Option<String>>, FleetError> {
    Ok(match table.column(name)? {
        Some(Values::Text(texts)) => texts,
        _ => vec![None; table.rows()],
    })
}

fn numbers(table: &FleetTable, name: &str) -> Result<Vec<Option<f64>>, FleetError> {
    Ok(match table.column(name)? {
        Some(Values::Number(numbers)) => numbers,
        _ => vec![None; table.rows()],
    })
}

fn failures(
    logs: &[Option<String>],
    failures: &[Option<String>],
    messages: &[Option<String>],
) -> Vec<FailureCount> {
    let mut counts: Vec<FailureCount> = Vec::new();
    for ((log, failure), message) in logs.iter().zip(failures).zip(messages) {
        let Some(failure) = failure else { continue };
        match counts.iter_mut().find(|count| count.failure == *failure) {
            Some(count) => count.rows += 1,
            None => counts.push(FailureCount {
                failure: failure.clone(),
                rows: 1,
                log: log.clone().unwrap_or_default(),
                message: message.clone().unwrap_or_default(),
            }),
        }
    }
    counts.sort_by_key(|count| std::cmp::Reverse(count.rows));
    counts
}

fn findings(table: &FleetTable) -> Result<Vec<FindingCount>, FleetError> {
    let mut all = Vec::new();
    for (column, severity) in [("refusals", "refusal"), ("warnings", "warning"), ("infos", "info")]
    {
        let mut counts: HashMap<String, usize> = HashMap::new();
        for codes in texts(table, column)?.into_iter().flatten() {
            for code in codes.split_whitespace() {
                *counts.entry(code.to_owned()).or_default() += 1;
            }
        }
        let counts = counts.into_iter().map(|(code, rows)| FindingCount {
            code,
            severity: severity.to_owned(),
            rows,
        });
        let mut counts: Vec<FindingCount> = counts.collect();
        counts.sort_by(|a, b| b.rows.cmp(&a.rows).then_with(|| a.code.cmp(&b.code)));
        all.extend(counts);
    }
    Ok(all)
}
