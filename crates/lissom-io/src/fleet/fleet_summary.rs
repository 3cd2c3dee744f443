//! The summary of a fleet in JSON.

use serde::{Deserialize, Serialize};

/// Summary of a fleet.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FleetSummary {
    /// Version of lissom that made the summary.
    pub version: String,
    /// Number of rows.
    pub rows: usize,
    /// Number of rows with a result.
    pub identified: usize,
    /// Rows without a result, by their kind.
    pub failures: Vec<FailureCount>,
    /// Findings, the most frequent ones first.
    pub findings: Vec<FindingCount>,
    /// Number of machines that are known.
    pub machines: usize,
    /// First and last time that is known, in microseconds since 1970 UTC.
    pub span_us: Option<(i64, i64)>,
    /// The parameters, in the order of their columns.
    pub parameters: Vec<ParameterSummary>,
}

/// How many rows have a kind of failure.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FailureCount {
    /// The kind.
    pub failure: String,
    /// Number of rows.
    pub rows: usize,
    /// The first log with it.
    pub log: String,
    /// What happened there.
    pub message: String,
}

/// How many rows have a finding.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FindingCount {
    /// Its code.
    pub code: String,
    /// Its severity: `refusal`, `warning` or `info`.
    pub severity: String,
    /// Number of rows.
    pub rows: usize,
}

/// Summary of a parameter.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ParameterSummary {
    /// Its key in `result.json`.
    pub key: String,
    /// Its distribution.
    pub distribution: Distribution,
    /// Relative change of what all machines do, from the first log to the last, of a line through it. What all machines do is
    /// divided out before machines and logs are compared. None with less than 20 machines that have three or more logs with
    /// known times, or less than 120 logs.
    pub common_change: Option<f64>,
    /// Spread of the changes of the machines over their standard errors: about one if nothing but scatter is in them. If it is
    /// larger, a machine must stand out from these to be listed in `drifts`. None with less than 20 machines.
    pub change_spread: Option<f64>,
    /// Machines that drift, the largest changes first.
    pub drifts: Vec<Drift>,
    /// Machines that differ from the others, the largest deviations first.
    pub outlying_machines: Vec<MachineOutlier>,
    /// Logs that differ from the other logs of their machine, or from all logs if the machine is unknown.
    pub outlying_logs: Vec<LogOutlier>,
}

/// The distribution of a parameter over the logs of a fleet, in the unit of its key.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Distribution {
    /// Number of logs that give the parameter.
    pub logs: usize,
    /// Number of logs that were identified and do not give it.
    pub refused: usize,
    /// Smallest value.
    pub smallest: f64,
    /// 5 % of the values are below.
    pub percent_5: f64,
    /// 25 % of the values are below.
    pub percent_25: f64,
    /// Half of the values are below.
    pub median: f64,
    /// 75 % of the values are below.
    pub percent_75: f64,
    /// 95 % of the values are below.
    pub percent_95: f64,
    /// Largest value.
    pub largest: f64,
    /// Standard deviation of a normal distribution with the same median absolute deviation.
    pub spread: f64,
    /// Median of the standard errors: the part of the spread that is uncertainty of the estimates.
    pub typical_std: f64,
    /// How many values are in each of several intervals.
    pub histogram: Histogram,
}

/// How many values are in each of several intervals of the same width.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Histogram {
    /// Begin of the first interval.
    pub from: f64,
    /// Width of each interval.
    pub width: f64,
    /// Number of values in each interval.
    pub counts: Vec<usize>,
    /// Number of values below the first interval.
    pub below: usize,
    /// Number of values above the last interval.
    pub above: usize,
}

/// A parameter of a machine that changes over time. All values are without what all machines do, see
/// [`ParameterSummary::common_change`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Drift {
    /// The machine.
    pub machine: String,
    /// Its values, in the order of time.
    pub values: Vec<DriftValue>,
    /// Value of the line in the middle.
    pub level: f64,
    /// Value of the line at the first log.
    pub first: f64,
    /// Change from the first log to the last.
    pub change: f64,
    /// Its standard error.
    pub change_std: f64,
    /// The change over the level; none if the level is zero.
    pub relative_change: Option<f64>,
    /// The change over its standard error, and over the spread of this ratio of all machines if that is larger than one.
    pub z: f64,
}

/// A value of a machine that drifts.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DriftValue {
    /// The log.
    pub log: String,
    /// Its time, in microseconds since 1970 UTC.
    pub time_us: i64,
    /// The value, without what all machines do.
    pub value: f64,
    /// Its standard error.
    pub std: f64,
}

/// A machine that differs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MachineOutlier {
    /// The machine.
    pub machine: String,
    /// Number of its logs.
    pub logs: usize,
    /// Its value, in the middle of its logs.
    pub value: f64,
    /// Median of all machines.
    pub expected: f64,
    /// The deviation, in scales of the machines on this side of the median.
    pub z: f64,
}

/// A log that differs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LogOutlier {
    /// The log.
    pub log: String,
    /// Its machine; if it is known, the log is compared with the other logs of the machine, otherwise with all logs.
    pub machine: Option<String>,
    /// Its value, without what all machines do over time.
    pub value: f64,
    /// Its standard error.
    pub std: f64,
    /// The value that the others let expect.
    pub expected: f64,
    /// The deviation, in scales of the others.
    pub z: f64,
}
