//! What all machines do over time, such as a season: without it, what one machine does is seen better.

use super::line_fit::{Point, line};
use super::log_value::LogValue;
use super::robust::median;

/// Logs of each interval of time.
const LOGS: usize = 40;
/// Smallest number of intervals: fewer do not show a course.
const INTERVALS_LEAST: usize = 3;
/// Largest number of intervals.
const INTERVALS_MOST: usize = 52;
/// Smallest number of machines that say what is common.
const MACHINES_LEAST: usize = 20;
/// Smallest number of logs of such a machine.
const LOGS_LEAST: usize = 3;
/// Number of iterations between the levels of the machines and the course.
const ITERATIONS: usize = 3;

/// The course over time of a machine with level one.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct CommonCourse {
    /// Time in microseconds and value, ascending in time.
    points: Vec<(f64, f64)>,
    /// First and last time.
    span_us: (f64, f64),
}

impl CommonCourse {
    /// The medians of all machines in intervals of time, each machine over its own median. None if there are few machines
    /// or logs with known times, or if their levels have different signs.
    pub(super) fn of<'a>(groups: impl Iterator<Item = &'a [LogValue<'a>]>) -> Option<Self> {
        let timed = |values: &&[LogValue<'_>]| {
            values.len() >= LOGS_LEAST && values.iter().all(|value| value.time_us.is_some())
        };
        let groups: Vec<&[LogValue<'_>]> = groups.filter(timed).collect();
        if groups.len() < MACHINES_LEAST {
            return None;
        }
        let mut course = Self { points: Vec::new(), span_us: (0.0, 0.0) };
        for _ in 0..ITERATIONS {
            let mut shares: Vec<(f64, f64)> = Vec::new();
            for values in &groups {
                let level = median(values.iter().map(|v| v.value / course.at(v.time_us)))?;
                shares.extend(
                    values.iter().filter_map(|v| Some((v.time_us? as f64, v.value / level))),
                );
            }
            if shares.iter().any(|(_, share)| !(*share > 0.0 && share.is_finite())) {
                return None;
            }
            shares.sort_by(|a, b| a.0.total_cmp(&b.0));
            let intervals = (shares.len() / LOGS).min(INTERVALS_MOST);
            if intervals < INTERVALS_LEAST {
                return None;
            }
            course.span_us = (shares.first()?.0, shares.last()?.0);
            let each = shares.len().div_ceil(intervals);
            let point = |part: &[(f64, f64)]| {
                Some((median(part.iter().map(|p| p.0))?, median(part.iter().map(|p| p.1))?))
            };
            course.points = shares.chunks(each).filter_map(point).collect();
        }
        Some(course)
    }

    /// Its value at a time, linear between intervals; one without a time.
    pub(super) fn at(&self, time_us: Option<i64>) -> f64 {
        let Some(time) = time_us.map(|time| time as f64) else { return 1.0 };
        let after = self.points.partition_point(|point| point.0 <= time);
        match (after.checked_sub(1).and_then(|k| self.points.get(k)), self.points.get(after)) {
            (Some(before), Some(next)) => {
                let part = (time - before.0) / (next.0 - before.0);
                before.1 + part * (next.1 - before.1)
            }
            (Some(end), None) | (None, Some(end)) => end.1,
            (None, None) => 1.0,
        }
    }

    /// Relative change from the first log to the last of a line through it.
    pub(super) fn change(&self) -> Option<f64> {
        let (from, to) = self.span_us;
        let point =
            |(time, y): &(f64, f64)| Point { x: (time - from) / (to - from), y: *y, std: 1.0 };
        let fit = line(&self.points.iter().map(point).collect::<Vec<_>>())?;
        Some(fit.at(1.0) / fit.at(0.0) - 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Six logs of a machine that grows by 40 %.
    fn grown(first: LogValue<'_>) -> Vec<LogValue<'_>> {
        let of = |k: u8| LogValue {
            time_us: Some(k.into()),
            value: first.value * (1.0 + 0.4 * f64::from(k) / 5.0),
            ..first
        };
        (0..6).map(of).collect()
    }

    #[test]
    fn a_season_is_found_whatever_the_levels() {
        let season = |day: i64| 1.0 + 0.1 * (day as f64 / 30.0).sin();
        let machine = |m: i64| {
            let value = move |k: i64| {
                let day = 9 * k + m % 9;
                let value = (1.0 + 0.2 * m as f64) * season(day);
                LogValue { log: "", machine: None, time_us: Some(day), value, std: 0.01 }
            };
            (0..20).map(value).collect::<Vec<_>>()
        };
        let machines: Vec<Vec<LogValue<'_>>> = (0..200).map(machine).collect();
        let course = CommonCourse::of(machines.iter().map(Vec::as_slice)).unwrap();
        let scale = course.at(Some(90)) / season(90);
        for day in [5, 33, 60, 120, 170] {
            assert!((course.at(Some(day)) / season(day) / scale - 1.0).abs() < 0.005, "{day}");
        }
        assert_eq!(CommonCourse::of(machines[..19].iter().map(Vec::as_slice)), None);
        // All machines grow by 40 %, in few logs.
        let all: Vec<_> = machines[..24].iter().map(|machine| grown(machine[0])).collect();
        let course = CommonCourse::of(all.iter().map(Vec::as_slice)).unwrap();
        assert!((course.change().unwrap() - 0.4).abs() < 0.03, "{course:?}");
        assert_eq!(CommonCourse::of(all[..19].iter().map(Vec::as_slice)), None);
    }
}
