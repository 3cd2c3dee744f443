//! Time stamps in two columns, seconds and nanoseconds, as ROS writes them.

use crate::log_data::Channel;

/// Ends of the names of seconds.
const SECONDS: [&str; 3] = ["sec", "secs", "seconds"];
/// Ends of the names of fractions, and their size in seconds.
const FRACTIONS: [(&str, f64); 7] = [
    ("nanosec", 1e-9),
    ("nanosecs", 1e-9),
    ("nanoseconds", 1e-9),
    ("nsec", 1e-9),
    ("nsecs", 1e-9),
    ("usec", 1e-6),
    ("usecs", 1e-6),
];

/// Appends a channel of times, counted from the first one, if two columns are stamps.
pub(super) fn append(channels: &mut Vec<Channel>) {
    let names: Vec<String> = channels.iter().map(|channel| channel.name.to_lowercase()).collect();
    let named = names.iter().enumerate().find_map(|(fraction, name)| {
        // `nanosec` ends with `sec` too, but nothing else has what is before it.
        FRACTIONS.iter().find_map(|(end, scale)| {
            let before = name.strip_suffix(end)?;
            let is_seconds =
                |name: &String| name.strip_prefix(before).is_some_and(|n| SECONDS.contains(&n));
            Some((names.iter().position(is_seconds)?, fraction, *scale))
        })
    });
    let unnamed = || {
        let is_unnamed = names.iter().all(String::is_empty);
        let is_pair = |k: &usize| are_stamps(&channels[*k].values, &channels[k + 1].values);
        (1..channels.len()).map(|k| k - 1).find(|k| is_unnamed && is_pair(k))
    };
    let Some((seconds, fraction, scale)) = named.or_else(|| unnamed().map(|k| (k, k + 1, 1e-9)))
    else {
        return;
    };
    let values = times(&channels[seconds].values, &channels[fraction].values, scale);
    let name = if names.iter().any(|name| name == "time") { "stamp" } else { "time" };
    channels.push(Channel { unit: Some("s".to_owned()), ..Channel::of(name, values) });
}

fn times(seconds: &[f64], fractions: &[f64], scale: f64) -> Vec<f64> {
    let first = seconds.first().copied().unwrap_or(0.0);
    let first_fraction = fractions.first().copied().unwrap_or(0.0);
    let time = |(s, f): (&f64, &f64)| (s - first) + scale * (f - first_fraction);
    seconds.iter().zip(fractions).map(time).collect()
}

/// Whether numbers without names are seconds since 1970 and nanoseconds.
fn are_stamps(seconds: &[f64], nanoseconds: &[f64]) -> bool {
    /// Seconds from 2001 to 2128.
    const NOW: std::ops::Range<f64> = 1e9..5e9;
    let is_whole = |value: &f64| value.fract().abs() < f64::EPSILON;
    let are_seconds = seconds.iter().all(|s| NOW.contains(s) && is_whole(s));
    let are_parts = nanoseconds.iter().all(|ns| (0.0..1e9).contains(ns) && is_whole(ns));
    are_seconds && are_parts && times(seconds, nanoseconds, 1e-9).is_sorted_by(|a, b| a < b)
}
