//! Columns of text while they are read.

use super::cells::{Cell, Decimal};
use super::stamps::{DAY_S, HALF_DAY_S, Stamp};
use crate::log_data::{Channel, Clock};
use crate::words::WordsBuilder;

/// A column that is being read.
pub(crate) struct Column {
    values: Vec<f64>,
    /// The imaginary parts, up to the last complex number.
    imaginary: Vec<f64>,
    /// The first stamp, from which stamps are counted: so their decimals are kept.
    first: Option<Stamp>,
    /// A time of day that goes back by more than half a day passed midnight.
    last_s: f64,
    not_a_number: Option<(usize, String)>,
    words: WordsBuilder,
}

impl Column {
    pub(crate) fn new(rows: usize) -> Self {
        let values = Vec::with_capacity(rows);
        Self {
            values,
            imaginary: Vec::new(),
            first: None,
            last_s: 0.0,
            not_a_number: None,
            words: WordsBuilder::default(),
        }
    }

    /// Makes room for so many rows.
    pub(crate) fn expect(&mut self, rows: usize) {
        self.values.reserve_exact(rows);
    }

    pub(crate) fn take(&mut self, cell: &str, decimal: Decimal, row: usize) {
        let value = match Cell::of(cell, decimal) {
            Cell::Number(value) => {
                if !self.words.is_empty() {
                    self.words.push(self.values.len(), &value.to_string());
                }
                value
            }
            Cell::Complex([real, imag]) => {
                self.imaginary.resize(self.values.len(), 0.0);
                self.imaginary.push(imag);
                real
            }
            Cell::Stamp(stamp) => {
                let mut since_s = stamp.since_s(*self.first.get_or_insert(stamp));
                if !stamp.has_date() && self.last_s - since_s > HALF_DAY_S {
                    since_s += DAY_S;
                }
                self.last_s = since_s;
                since_s
            }
            Cell::Blank => f64::NAN,
            Cell::Words => {
                if self.not_a_number.is_none() {
                    self.not_a_number = Some((row, cell.chars().take(40).collect()));
                    for (k, value) in self.values.iter().enumerate().filter(|(_, v)| v.is_finite())
                    {
                        self.words.push(k, &value.to_string());
                    }
                }
                self.words.push(self.values.len(), cell);
                f64::NAN
            }
        };
        self.values.push(value);
    }

    pub(crate) fn channel(self, name: String, unit: Option<String>) -> Channel {
        let unit = if self.first.is_some() { Some("s".to_owned()) } else { unit };
        let Self { values, not_a_number, words, .. } = self;
        let words = words.finish(values.len());
        Channel { unit, not_a_number, words, ..Channel::of(name, values) }
    }

    /// Appends its channel, or two if it has complex numbers: `NAME/real` and `NAME/imag`.
    pub(crate) fn push_channels(
        mut self,
        name: String,
        unit: Option<String>,
        channels: &mut Vec<Channel>,
    ) {
        if self.imaginary.is_empty() {
            channels.push(self.channel(name, unit));
            return;
        }
        let mut imag = std::mem::take(&mut self.imaginary);
        imag.resize(self.values.len(), 0.0);
        for (imag, real) in imag.iter_mut().zip(&self.values).filter(|(_, real)| real.is_nan()) {
            *imag = *real;
        }
        channels.push(self.channel(format!("{name}/real"), unit.clone()));
        channels.push(Channel { unit, ..Channel::of(format!("{name}/imag"), imag) });
    }

    /// Appends a number.
    pub(crate) fn push(&mut self, value: f64) {
        self.values.push(value);
    }

    pub(crate) fn values(&self) -> &[f64] {
        &self.values
    }
}

/// Appends a channel and the channel of its time stamps, which may have a unit.
pub(crate) fn push_timed(
    name: &str,
    (stamps, unit): (Column, Option<&str>),
    values: Column,
    channels: &mut Vec<Channel>,
) {
    let clock = Clock::Channel(channels.len());
    channels.push(stamps.channel(format!("{name}/time"), unit.map(str::to_owned)));
    channels.push(Channel { clock, ..values.channel(name.to_owned(), None) });
}
