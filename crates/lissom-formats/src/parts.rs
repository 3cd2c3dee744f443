//! Parts of a log file that are runs of their own: groups of channels, and rows with the same value in a channel.

use std::collections::HashMap;

use crate::log_data::{Channel, Clock, LogData};

/// Most parts of a file.
const MOST_PARTS: usize = 10_000;

impl LogData {
    /// The groups of channels whose path is `pattern`, in the order of the file, each with its path. The channels have
    /// their names within the group.
    ///
    /// `run3` is the group of `run3/t` and `run3/q`; `run*` are all groups that begin with `run`; `run3_` has `run3_t` as
    /// `t`. A `/` at the beginning does not count. Time stamps outside of a group come with it, under their whole name.
    /// A group whose path is `pattern` itself comes before others that fit.
    #[must_use]
    pub fn groups(&self, pattern: &str) -> Vec<(String, Self)> {
        let has = |split: &dyn Fn(&str) -> bool| self.channels.iter().any(|c| split(&c.name));
        let is_itself = pattern.contains('*') && has(&|name| of_group(name, pattern).is_some());
        let split = if is_itself { of_group } else { of_pattern };
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

    /// The rows with the same value in a channel, such as the number or the name of the trial, in the order in which the
    /// values appear. Channels of another length are left out. `None` if the channel is missing or has more than 10,000
    /// different values.
    #[must_use]
    pub fn by_value(&self, channel: usize) -> Option<Vec<(String, Self)>> {
        let channel = self.channels.get(channel)?;
        let rows = channel.values.len();
        // Zero has no sign.
        let number = |row: usize| Some(channel.values[row] + 0.0).filter(|value| value.is_finite());
        let mut places: HashMap<Key, usize> = HashMap::new();
        let mut found: Vec<(String, Vec<usize>)> = Vec::new();
        for row in 0..rows {
            let key = match &channel.words {
                Some(words) => words.at(row).map(Key::Word),
                None => number(row).map(|value| Key::Number(value.to_bits())),
            };
            let Some(key) = key else { continue };
            let place = *places.entry(key).or_insert_with(|| {
                let name = match key {
                    Key::Word(word) => word.to_owned(),
                    Key::Number(bits) => f64::from_bits(bits).to_string(),
                };
                found.push((name, Vec::new()));
                found.len() - 1
            });
            if found.len() > MOST_PARTS {
                return None;
            }
            found[place].1.push(row);
        }
        let part = |(name, part): (String, Vec<usize>)| (name, self.of_rows(&part, rows));
        Some(found.into_iter().map(part).collect())
    }

    /// Some of the rows of the channels with so many rows.
    fn of_rows(&self, part: &[usize], rows: usize) -> Self {
        let has_rows = |k: &usize| self.channels[*k].values.len() == rows;
        let places: Vec<usize> = (0..self.channels.len()).filter(has_rows).collect();
        let channel = |k: &usize| {
            let whole = &self.channels[*k];
            let clock = match whole.clock {
                Clock::Channel(clock) => {
                    let place = places.iter().position(|k| *k == clock);
                    place.map_or(Clock::Unstated, Clock::Channel)
                }
                clock => clock,
            };
            Channel {
                name: whole.name.clone(),
                unit: whole.unit.clone(),
                values: part.iter().map(|row| whole.values[*row]).collect(),
                clock,
                not_a_number: whole.not_a_number.clone().filter(|_| has_words(whole, part)),
                words: whole.words.as_ref().map(|words| words.of_rows(part)),
            }
        };
        Self { channels: places.iter().map(channel).collect(), ..self.without_channels() }
    }
}

/// Whether a channel has cells that are no numbers in these rows.
fn has_words(channel: &Channel, rows: &[usize]) -> bool {
    rows.iter().any(|row| match &channel.words {
        Some(words) => words.at(*row).is_some() && channel.values[*row].is_nan(),
        None => channel.values[*row].is_nan(),
    })
}

/// The value of a row in a channel.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Key<'a> {
    Word(&'a str),
    /// The bits of a number.
    Number(u64),
}

/// The group of this path, if a name is in it, and the name within it.
fn of_group<'a>(name: &'a str, group: &str) -> Option<(&'a str, &'a str)> {
    let name = name.trim_start_matches('/');
    let group = group.trim_start_matches('/');
    let rest = name.strip_prefix(group)?;
    Some((&name[..group.len()], within(group, rest)?))
}

/// The group of a path that fits a pattern, if a name is in one, and the name within it.
fn of_pattern<'a>(name: &'a str, pattern: &str) -> Option<(&'a str, &'a str)> {
    let Some((before, after)) = pattern.trim_start_matches('/').split_once('*') else {
        return of_group(name, pattern);
    };
    let name = name.trim_start_matches('/');
    let rest = name.strip_prefix(before)?;
    let ends = rest.char_indices().map(|(k, c)| (k + c.len_utf8(), c));
    for (end, _) in ends.take_while(|(_, c)| *c != '/') {
        if let Some(after_group) = rest[end..].strip_prefix(after)
            && let Some(inner) = within(after, after_group)
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
    use crate::words::WordsBuilder;

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
        let stars = data(&[("x/q", &[0.0]), ("x*/q", &[1.0]), ("xy/q", &[2.0])]);
        let exact = stars.groups("x*");
        assert_eq!(names(&exact), [("x*".to_owned(), vec!["q".to_owned()])]);
        assert_eq!(named("b*_"), ["b1_: t", "b12_: t"]);
        assert_eq!(named("b1_"), ["b1_: t"]);
        let nested = data(&[("m/un_1/t", &[0.0]), ("m/un_2/t", &[0.0])]);
        for pattern in ["m/*", "m/un_*", "/m/un*"] {
            let groups: Vec<String> = nested.groups(pattern).into_iter().map(|(g, _)| g).collect();
            assert_eq!(groups, ["m/un_1", "m/un_2"], "{pattern}");
        }
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
    fn rows_of_the_same_value() {
        let mut log =
            data(&[("n", &[2.0, 1.0, 2.0, f64::NAN, 1.0]), ("q", &[0.0, 1.0, 2.0, 3.0, 4.0])]);
        let values = |log: &LogData| -> Vec<(String, Vec<f64>)> {
            let parts = log.by_value(0).unwrap();
            parts.into_iter().map(|(n, part)| (n, part.channels[1].values.clone())).collect()
        };
        let of = |name: &str, rows: &[f64]| (name.to_owned(), rows.to_vec());
        assert_eq!(values(&log), [of("2", &[0.0, 2.0]), of("1", &[1.0, 4.0])]);
        let mut words = WordsBuilder::default();
        for (row, word) in [(0, "cw"), (1, "ccw"), (4, "cw")] {
            words.push(row, word);
        }
        log.channels[0].words = words.finish(5);
        assert_eq!(values(&log), [of("cw", &[0.0, 4.0]), of("ccw", &[1.0])]);
        // What is no number in other rows does not count.
        log.channels[1].values[1] = f64::NAN;
        log.channels[1].not_a_number = Some((3, "n/c".to_owned()));
        let parts = log.by_value(0).unwrap();
        assert!(parts[0].1.channels[1].not_a_number.is_none());
        assert!(parts[1].1.channels[1].not_a_number.is_some());
    }
}
