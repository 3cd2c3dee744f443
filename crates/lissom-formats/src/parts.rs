//! Parts of a log file that are runs of their own: groups of channels, and rows with the same number in a channel.

use crate::log_data::{Channel, Clock, LogData};

/// Most parts of a file.
const MOST_PARTS: usize = 10_000;

impl LogData {
    /// The groups of channels whose path is `pattern`, in the order of the file, each with its path. The channels have
    /// their names within the group.
    ///
    /// `run3` is the group of `run3/t` and `run3/q`; `run*` are all groups that begin with `run`; `run3_` has `run3_t` as
    /// `t`. A `/` at the beginning does not count. Time stamps outside of a group come with it, under their whole name.
    #[must_use]
    pub fn groups(&self, pattern: &str) -> Vec<(String, Self)> {
        let mut found: Vec<(String, Vec<(usize, String)>)> = Vec::new();
        for (k, channel) in self.channels.iter().enumerate() {
            let Some((group, name)) = split(&channel.name, pattern) else { continue };
            let member = (k, name.to_owned());
            let is_full = found.len() == MOST_PARTS;
            match found.iter_mut().find(|(known, _)| known == group) {
                Some((_, members)) => members.push(member),
                None if is_full => {}
                None => found.push((group.to_owned(), vec![member])),
            }
        }
        found.into_iter().map(|(group, members)| (group, self.only(members))).collect()
    }

    /// These channels under these names, and the time stamps that they refer to.
    fn only(&self, mut members: Vec<(usize, String)>) -> Self {
        for place in 0..members.len() {
            if let Clock::Channel(clock) = self.channels[members[place].0].clock
                && !members.iter().any(|(k, _)| *k == clock)
            {
                members.push((clock, self.channels[clock].name.clone()));
            }
        }
        let channel = |(k, name): &(usize, String)| {
            let whole = &self.channels[*k];
            let clock = match whole.clock {
                Clock::Channel(clock) => {
                    let place = members.iter().position(|(member, _)| *member == clock);
                    place.map_or(Clock::Unstated, Clock::Channel)
                }
                clock => clock,
            };
            Channel { name: name.clone(), clock, ..whole.clone() }
        };
        Self { channels: members.iter().map(channel).collect(), ..self.without_channels() }
    }

    fn without_channels(&self) -> Self {
        let (decimal_comma, notes) = (self.decimal_comma, self.notes.clone());
        Self { format: self.format, channels: Vec::new(), decimal_comma, notes }
    }

    /// The rows with the same number in a channel, such as the number of the trial, in the order in which the numbers
    /// appear. Channels of another length are left out. `None` if the channel is missing or has more than 10,000
    /// different numbers.
    #[must_use]
    pub fn by_number(&self, channel: usize) -> Option<Vec<(f64, Self)>> {
        let numbers = &self.channels.get(channel)?.values;
        let mut found: Vec<(f64, Vec<usize>)> = Vec::new();
        let mut last = 0;
        for (row, number) in numbers.iter().enumerate().filter(|(_, n)| n.is_finite()) {
            let same = |part: &(f64, Vec<usize>)| part.0.total_cmp(number).is_eq();
            if !found.get(last).is_some_and(same) {
                last = found.iter().position(same).unwrap_or(found.len());
            }
            let is_full = found.len() == MOST_PARTS;
            match found.get_mut(last) {
                Some((_, rows)) => rows.push(row),
                None if is_full => return None,
                None => found.push((*number, vec![row])),
            }
        }
        let part = |(number, rows): (f64, Vec<usize>)| {
            let places: Vec<usize> = (0..self.channels.len())
                .filter(|k| self.channels[*k].values.len() == numbers.len())
                .collect();
            let of_rows = |k: &usize| {
                let whole = &self.channels[*k];
                let clock = match whole.clock {
                    Clock::Channel(clock) => places
                        .iter()
                        .position(|k| *k == clock)
                        .map_or(Clock::Unstated, Clock::Channel),
                    clock => clock,
                };
                Channel {
                    name: whole.name.clone(),
                    unit: whole.unit.clone(),
                    values: rows.iter().map(|row| whole.values[*row]).collect(),
                    clock,
                    not_a_number: whole.not_a_number.clone(),
                }
            };
            let channels = places.iter().map(of_rows).collect();
            (number, Self { channels, ..self.without_channels() })
        };
        Some(found.into_iter().map(part).collect())
    }
}

/// The group that a name is in, and the name within it.
fn split<'a>(name: &'a str, pattern: &str) -> Option<(&'a str, &'a str)> {
    let name = name.trim_start_matches('/');
    let pattern = pattern.trim_start_matches('/');
    let Some((before, after)) = pattern.split_once('*') else {
        let rest = name.strip_prefix(pattern)?;
        return Some((&name[..pattern.len()], within(pattern, rest)?));
    };
    let rest = name.strip_prefix(before)?;
    let ends = rest.char_indices().map(|(k, c)| (k + c.len_utf8(), c));
    for (end, _) in ends.take_while(|(_, c)| *c != '/') {
        if let Some(after_group) = rest[end..].strip_prefix(after)
            && let Some(inner) = within(if after.is_empty() { before } else { after }, after_group)
        {
            return Some((&name[..before.len() + end + after.len()], inner));
        }
    }
    None
}

/// The name within a group whose path ends with `group`, if what follows is one.
fn within<'a>(group: &str, rest: &'a str) -> Option<&'a str> {
    let inner = if group.ends_with(['/', '_', '.', '-', ':']) {
        rest
    } else {
        rest.strip_prefix(['/', '.'])?
    };
    (!inner.is_empty()).then_some(inner)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::Format;

    fn data(channels: &[(&str, &[f64])]) -> LogData {
        let channels = channels.iter().map(|(name, v)| Channel::of(*name, v.to_vec())).collect();
        LogData { format: Format::Text, channels, decimal_comma: false, notes: Vec::new() }
    }

    fn names(parts: &[(String, LogData)]) -> Vec<(String, Vec<String>)> {
        let of = |data: &LogData| data.channels.iter().map(|c| c.name.clone()).collect();
        parts.iter().map(|(group, data)| (group.clone(), of(data))).collect()
    }

    #[test]
    fn groups_by_their_path() {
        let log = data(&[
            ("run1/t", &[0.0]),
            ("run1/q", &[1.0]),
            ("/run2/t", &[0.0]),
            ("data[2]/q", &[2.0]),
            ("rest", &[2.0]),
            ("b1_t", &[2.0]),
            ("b12_t", &[2.0]),
        ]);
        let named = |pattern: &str| {
            let found = names(&log.groups(pattern));
            found.iter().map(|(g, n)| format!("{g}: {}", n.join(" "))).collect::<Vec<_>>()
        };
        assert_eq!(named("run1"), ["run1: t q"]);
        assert_eq!(named("/run*"), ["run1: t q", "run2: t"]);
        assert_eq!(named("*"), ["run1: t q", "run2: t", "data[2]: q"]);
        assert_eq!(named("data[*]"), ["data[2]: q"]);
        assert_eq!(named("b*_"), ["b1_: t", "b12_: t"]);
        assert_eq!(named("b1_"), ["b1_: t"]);
        assert!(named("run").is_empty() && named("run3").is_empty());
    }

    #[test]
    fn time_stamps_outside_of_a_group_come_with_it() {
        let mut log = data(&[("time", &[0.0]), ("a/q", &[1.0]), ("a/i", &[1.0])]);
        log.channels[1].clock = Clock::Channel(0);
        let (_, group) = &log.groups("a")[0];
        assert_eq!(group.channels[2].name, "time");
        assert_eq!(group.channels[0].clock, Clock::Channel(2));
    }

    #[test]
    fn rows_of_the_same_number() {
        let log =
            data(&[("n", &[2.0, 1.0, 2.0, f64::NAN, 1.0]), ("q", &[0.0, 1.0, 2.0, 3.0, 4.0])]);
        let parts = log.by_number(0).unwrap();
        assert_eq!(parts.iter().map(|(n, _)| *n).collect::<Vec<_>>(), [2.0, 1.0]);
        assert_eq!(parts[0].1.channels[1].values, [0.0, 2.0]);
        assert_eq!(parts[1].1.channels[1].values, [1.0, 4.0]);
    }
}
