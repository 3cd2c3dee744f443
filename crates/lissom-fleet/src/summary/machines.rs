//! The values of a parameter, by machine.

use std::collections::HashMap;

use super::common_course::CommonCourse;
use super::common_scatter::CommonScatter;
use super::line_fit::{LineFit, Point, level, line, robust_line};
use super::log_value::LogValue;
use super::robust::{median, scale};

/// Seconds of a day: times are counted in days, in which sums of squares keep their digits.
const DAY_US: f64 = 86_400e6;
/// Smallest number of logs for a line.
pub(super) const LINE_LEAST: usize = 4;
/// Deviations beyond this many scales count as much as these in a machine's scatter.
const CLIP: f64 = 1.5;
/// Mean square of a standard normal variable that is clipped at ±1.5: 1 − 2(cφ(c) + Φ(−c)) + 2c²Φ(−c).
const CLIPPED: f64 = 0.778_5;
/// Number of iterations for the scatter.
const ITERATIONS: usize = 10;
/// Largest leverage of a point: beyond it its residual says nothing.
const LEVERAGE_MOST: f64 = 0.9;

/// The values of a machine, with a line or level through them.
#[derive(Debug, Clone)]
pub(super) struct Machine<'a> {
    /// Its name; none for a log whose machine is unknown.
    pub(super) name: Option<&'a str>,
    pub(super) values: Vec<LogValue<'a>>,
    pub(super) fit: LineFit,
    /// Variance of the values around the fit over that of the points, and its degrees of freedom. Also from the other
    /// machines, see [`CommonScatter`].
    pub(super) variance: (f64, f64),
    points: Vec<Point>,
}

impl<'a> Machine<'a> {
    /// Whether there are enough logs at different times for a line.
    pub(super) fn has_line(&self) -> bool {
        self.fit.slope_std.is_finite()
    }

    /// First and last time, in microseconds.
    pub(super) fn span_us(&self) -> Option<(i64, i64)> {
        let times = || self.values.iter().filter_map(|value| value.time_us);
        times().min().zip(times().max())
    }

    /// Change from the first log to the last, with its standard error; none without a line.
    pub(super) fn change(&self) -> Option<(f64, f64)> {
        let (from, to) = self.span_us().filter(|_| self.has_line())?;
        let days = days(to) - days(from);
        Some((self.fit.slope * days, self.fit.slope_std * self.variance.0.sqrt() * days))
    }

    /// What the fit says at the first log.
    pub(super) fn first(&self) -> f64 {
        self.span_us().map_or(self.level(), |(from, _)| self.fit.at(days(from)))
    }

    /// What the fit says in the middle of the machine's logs.
    pub(super) fn level(&self) -> f64 {
        self.fit.at(self.fit.middle)
    }

    /// Value of the fit at each log, and the deviation from it, in its standard errors.
    pub(super) fn deviations(&self) -> impl Iterator<Item = (&LogValue<'a>, f64, f64)> {
        let weight = |p: &Point| 1.0 / (p.std * p.std);
        let all: f64 = self.points.iter().map(weight).sum();
        let scale = self.variance.0.sqrt();
        self.values.iter().zip(&self.points).map(move |(value, point)| {
            let expected = self.fit.at(point.x);
            let slope_std = if self.has_line() { self.fit.slope_std } else { 0.0 };
            let distance = (point.x - self.fit.middle) * slope_std;
            let leverage = weight(point) / all + weight(point) * distance * distance;
            let left = 1.0 - leverage.min(LEVERAGE_MOST);
            (value, expected, (value.value - expected) / (point.std * scale * left.sqrt()))
        })
    }
}

fn days(time_us: i64) -> f64 {
    time_us as f64 / DAY_US
}

/// The machines of a parameter, and what they have in common.
#[derive(Debug)]
pub(super) struct Machines<'a> {
    pub(super) all: Vec<Machine<'a>>,
    /// Relative change of the common course from the first log to the last.
    pub(super) common_change: Option<f64>,
}

/// The values of each machine, without what all machines do over time; a log whose machine is unknown is one of its own.
pub(super) fn machines<'a>(values: &[LogValue<'a>]) -> Machines<'a> {
    let mut places: HashMap<&str, usize> = HashMap::new();
    let mut groups: Vec<(Option<&str>, Vec<LogValue<'a>>)> = Vec::new();
    for value in values {
        let known = value.machine.and_then(|machine| places.get(machine).copied());
        if let Some(place) = known {
            groups[place].1.push(*value);
            continue;
        }
        if let Some(machine) = value.machine {
            places.insert(machine, groups.len());
        }
        groups.push((value.machine, vec![*value]));
    }
    let course = CommonCourse::of(groups.iter().map(|(_, values)| values.as_slice()));
    for value in groups.iter_mut().flat_map(|(_, values)| values) {
        let common = course.as_ref().map_or(1.0, |course| course.at(value.time_us));
        value.value /= common;
        value.std /= common;
    }
    let extra = extra_variance(&groups);
    let found = groups.into_iter().filter_map(|(name, values)| machine(name, values, extra));
    let mut machines: Vec<Machine<'a>> = found.collect();
    let own: Vec<(f64, f64)> = machines.iter().map(|machine| machine.variance).collect();
    let common = CommonScatter::of(&own);
    for machine in &mut machines {
        machine.variance = common.with_own(machine.variance.0, machine.variance.1);
    }
    Machines { all: machines, common_change: course.and_then(|course| course.change()) }
}

/// Variance of the logs of a machine beyond that of their estimates, of all machines.
fn extra_variance(groups: &[(Option<&str>, Vec<LogValue<'_>>)]) -> f64 {
    let residuals = groups.iter().filter(|(_, values)| values.len() > 2).flat_map(|(_, values)| {
        let points = points(values, 0.0);
        let equal: Vec<Point> = points.iter().map(|p| Point { std: 1.0, ..*p }).collect();
        let fit = line(&equal).filter(|_| values.len() >= LINE_LEAST);
        let used = if fit.is_some() { 2.0 } else { 1.0 };
        let count = values.len() as f64;
        let grown = (count / (count - used)).sqrt();
        let fit = fit.or_else(|| level(&equal));
        let residual = move |p: &Point| fit.map(|fit| grown * (p.y - fit.at(p.x)));
        equal.iter().filter_map(residual).collect::<Vec<f64>>()
    });
    let all = scale(residuals).unwrap_or(0.0);
    let stds = groups.iter().flat_map(|(_, values)| values).map(|value| value.std * value.std);
    (all * all - median(stds).unwrap_or(0.0)).max(0.0)
}

/// Points at times in days; all at one place if a time is unknown. What a standard error counts beyond noise is the same in most logs
/// of a machine: that of a log is no less than their median.
fn points(values: &[LogValue<'_>], extra: f64) -> Vec<Point> {
    let typical = median(values.iter().map(|value| value.std * value.std)).unwrap_or(0.0);
    let known = values.iter().all(|value| value.time_us.is_some());
    let point = |value: &LogValue<'_>| Point {
        x: value.time_us.filter(|_| known).map_or(0.0, days),
        y: value.value,
        std: (extra + typical.max(value.std * value.std)).sqrt().max(f64::MIN_POSITIVE),
    };
    values.iter().map(point).collect()
}

fn machine<'a>(
    name: Option<&'a str>,
    values: Vec<LogValue<'a>>,
    extra: f64,
) -> Option<Machine<'a>> {
    let points = points(&values, extra);
    let sloped = (points.len() >= LINE_LEAST).then(|| robust_line(&points)).flatten();
    let used = if sloped.is_some() { 2 } else { 1 };
    let fit = sloped.or_else(|| level(&points))?;
    let freedom = points.len().saturating_sub(used) as f64;
    let variance = (variance(&points, &fit, freedom), freedom);
    Some(Machine { name, values, fit, variance, points })
}

/// Variance around a fit over that of the points, in which a point far off counts little. Zero without a degree of freedom.
fn variance(points: &[Point], fit: &LineFit, freedom: f64) -> f64 {
    if freedom <= 0.0 {
        return 0.0;
    }
    let deviations: Vec<f64> = points.iter().map(|p| (p.y - fit.at(p.x)) / p.std).collect();
    let grown = points.len() as f64 / freedom;
    let mut variance = grown * scale(deviations.iter().copied()).map_or(0.0, |scale| scale * scale);
    for _ in 0..ITERATIONS {
        let most = CLIP * variance.sqrt();
        let clipped = deviations.iter().map(|d| d.abs().min(most));
        variance = clipped.map(|d| d * d).sum::<f64>() / (CLIPPED * freedom);
    }
    variance
}
