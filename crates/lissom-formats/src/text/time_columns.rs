//! Several columns of time stamps in one table, each for the columns behind it.

use crate::log_data::{Channel, Clock};
use crate::unit;

/// Least number of stamps.
const LEAST_STAMPS: usize = 3;

/// Whether a name is one of time stamps.
pub(super) fn is_named_time(name: &str) -> bool {
    const WORDS: [&str; 5] = ["time", "zeit", "timestamp", "stamp", "timestamps"];
    let name = name.trim_start_matches(['#', '%', ' ', '"']).to_lowercase();
    let mut words = name.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    let first = words.clone().next().unwrap_or("");
    let is_numbered = |word: &str| {
        let number = word.strip_prefix('t');
        number.is_some_and(|number| number.chars().all(|c| c.is_ascii_digit()))
    };
    is_numbered(first) || words.any(|word| WORDS.contains(&word))
}

/// Gives each channel the stamps in the nearest column before it, if several columns have stamps and each is followed by
/// channels.
pub(super) fn set_clocks(channels: &mut [Channel]) {
    let times: Vec<usize> = (0..channels.len()).filter(|k| is_time(&channels[*k])).collect();
    let apart = times.windows(2).all(|pair| pair[1] > pair[0] + 1);
    let end_in_channels = times.last().is_some_and(|last| last + 1 < channels.len());
    let same_unit = times.iter().all(|k| channels[*k].unit == channels[times[0]].unit);
    if times.len() < 2 || times[0] > 1 || !apart || !end_in_channels || !same_unit {
        return;
    }
    if times.windows(2).all(|pair| channels[pair[0]].values == channels[pair[1]].values) {
        return;
    }
    let mut stamps = times[0];
    for (k, channel) in channels.iter_mut().enumerate().skip(times[0]) {
        if times.contains(&k) {
            stamps = k;
        } else if channel.clock == Clock::Unstated {
            channel.clock = Clock::Channel(stamps);
        }
    }
}

/// Whether a channel has time stamps: by its name or its unit, and because it grows.
fn is_time(channel: &Channel) -> bool {
    let stated = channel.unit.as_deref().is_some_and(unit::is_time);
    let mut stamps = channel.values.iter().copied().filter(|value| value.is_finite());
    let count = stamps.clone().count();
    let mut last = f64::NEG_INFINITY;
    let mut grows = || stamps.all(|stamp| std::mem::replace(&mut last, stamp) < stamp);
    (stated || is_named_time(&channel.name)) && count >= LEAST_STAMPS && grows()
}

/// Whether a line of a text names several columns of time stamps.
pub(crate) fn names_several_times(text: &str) -> bool {
    text.lines().take(100).any(|line| {
        let cells = line.split([',', ';', '\t']).map(str::trim);
        let has_unit = |cell: &str| {
            unit::is_time(unit::bare(cell))
                || unit::in_name(cell).as_deref().is_some_and(unit::is_time)
        };
        cells.filter(|cell| is_named_time(cell) || has_unit(cell)).count() > 1
    })
}
