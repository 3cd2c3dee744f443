//! What a log file contains.

use crate::format::Format;
use crate::unit;
use crate::words::{Words, WordsBuilder};

/// The content of a log file.
#[derive(Debug, Clone, PartialEq)]
pub struct LogData {
    /// The format of the file.
    pub format: Format,
    /// Its channels, in the order of the file.
    pub channels: Vec<Channel>,
    /// Whether the numbers have a decimal comma.
    pub decimal_comma: bool,
    /// What was left out or changed while the file was read, in words.
    pub notes: Vec<String>,
}

impl LogData {
    /// A table in memory: columns of numbers with their names, NaN where a value is missing.
    pub fn of_columns<N: Into<String>>(columns: impl IntoIterator<Item = (N, Vec<f64>)>) -> Self {
        let (channels, notes) = (Vec::new(), Vec::new());
        let empty = Self { format: Format::Memory, channels, decimal_comma: false, notes };
        columns.into_iter().fold(empty, |log, (name, values)| log.with_column(name, values))
    }

    /// The same with a column of numbers, NaN where a value is missing.
    #[must_use]
    pub fn with_column(mut self, name: impl Into<String>, values: Vec<f64>) -> Self {
        let mut channel = Channel::of(name, values);
        channel.take_unit_of_name();
        self.channels.push(channel);
        self
    }

    /// The same with a column of words, such as the name of the run of each row; a blank is a missing word.
    #[must_use]
    pub fn with_words<'w>(
        mut self,
        name: impl Into<String>,
        words: impl IntoIterator<Item = &'w str>,
    ) -> Self {
        let mut builder = WordsBuilder::default();
        let mut rows = 0;
        for (row, word) in words.into_iter().enumerate() {
            builder.push(row, word);
            rows = row + 1;
        }
        let words = builder.finish(rows);
        let not_a_number = words.as_ref().and_then(Words::first).map(|first| (0, first.to_owned()));
        let channel = Channel::of(name, vec![f64::NAN; rows]);
        self.channels.push(Channel { not_a_number, words, ..channel });
        self
    }

    /// The same with a channel `time` \[s\] for each even clock, which its channels then have as their time stamps.
    #[must_use]
    pub fn with_time_stamps(mut self) -> Self {
        let mut clocks: Vec<(f64, f64, usize)> = Vec::new();
        for channel in &self.channels {
            if let Clock::Even { start_s, step_s } = channel.clock {
                // A channel that is not read has no values: its clock counts only if no other channel has it.
                let values = channel.values.len();
                let same = |clock: &&mut (f64, f64, usize)| {
                    (clock.0, clock.1) == (start_s, step_s)
                        && (clock.2 == values || clock.2 == 0 || values == 0)
                };
                match clocks.iter_mut().find(same) {
                    Some(clock) => clock.2 = clock.2.max(values),
                    None => clocks.push((start_s, step_s, values)),
                }
            }
        }
        let first = self.channels.len();
        for channel in &mut self.channels {
            if let Clock::Even { start_s, step_s } = channel.clock {
                let values = channel.values.len();
                let same = |clock: &(f64, f64, usize)| {
                    (clock.0, clock.1) == (start_s, step_s) && (clock.2 == values || values == 0)
                };
                let place = clocks.iter().position(same);
                channel.clock = place.map_or(channel.clock, |k| Clock::Channel(first + k));
            }
        }
        let only = clocks.len() == 1;
        for (k, (start_s, step_s, values)) in clocks.into_iter().enumerate() {
            let name = if only { "time".to_owned() } else { format!("time[{}]", k + 1) };
            let values = (0..values).map(|i| start_s + step_s * i as f64).collect();
            let unit = Some("s".to_owned());
            self.channels.push(Channel { unit, ..Channel::of(name, values) });
        }
        self
    }
}

/// A channel of a log file.
#[derive(Debug, Clone, PartialEq)]
pub struct Channel {
    /// Its name, with the path inside the file; empty if the file has no names.
    pub name: String,
    /// Its unit, as the file states it.
    pub unit: Option<String>,
    /// Its values; NaN where the file has none. Empty if the channel was not asked for.
    pub values: Vec<f64>,
    /// The clock of its values.
    pub clock: Clock,
    /// The first cell that is not a number: its row, counted from 1 as an editor does (0 if the format has no rows), and
    /// its text.
    pub not_a_number: Option<(usize, String)>,
    /// Its words, if it has such in place of numbers.
    pub words: Option<Words>,
}

/// When the values of a [`Channel`] were measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Clock {
    /// The file does not say: any channel of the same length may contain the time.
    Unstated,
    /// The values of another channel, by its index, are the time stamps.
    Channel(usize),
    /// Evenly spaced.
    Even {
        /// Time of the first value \[s\].
        start_s: f64,
        /// Time between two values \[s\].
        step_s: f64,
    },
}

impl Channel {
    /// A channel of numbers, without a unit, on an unstated clock.
    pub(crate) fn of(name: impl Into<String>, values: Vec<f64>) -> Self {
        Self {
            name: name.into(),
            unit: None,
            values,
            clock: Clock::Unstated,
            not_a_number: None,
            words: None,
        }
    }

    /// Takes the unit in its name, if it has no other one.
    pub(crate) fn take_unit_of_name(&mut self) {
        if self.unit.is_none() {
            self.unit = unit::in_name(&self.name);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_clocks_do_not_depend_on_what_is_read() {
        let channel = |name: &str, step_s: f64, values: usize| Channel {
            clock: Clock::Even { start_s: 0.0, step_s },
            ..Channel::of(name, vec![0.0; values])
        };
        let log = |fast: usize, slow: usize| {
            let channels = vec![channel("a", 0.1, fast), channel("b", 0.5, slow)];
            let (format, notes) = (Format::Tdms, Vec::new());
            LogData { format, channels, decimal_comma: false, notes }.with_time_stamps()
        };
        for (fast, slow) in [(10, 2), (0, 2), (10, 0)] {
            let found = log(fast, slow);
            assert_eq!(found.channels[2].name, "time[1]");
            assert_eq!(found.channels[3].name, "time[2]");
            assert_eq!(
                (found.channels[2].values.len(), found.channels[3].values.len()),
                (fast, slow)
            );
            assert_eq!(found.channels[1].clock, Clock::Channel(3));
        }
    }
}
