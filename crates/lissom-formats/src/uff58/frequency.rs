//! Functions of the frequency: frequency responses and spectra.

use super::header::Header;
use crate::collected::Collected;
use crate::log_data::Channel;

/// Functions of the frequency while a file is read.
#[derive(Debug, Default)]
pub(super) struct Frequencies {
    /// The channels of frequencies.
    channels: Vec<usize>,
}

impl Frequencies {
    /// Appends the parts of a function, and its frequencies unless those of another function are the same. The first
    /// frequencies are the channel `frequency`.
    pub(super) fn collect(
        &mut self,
        name: &str,
        values: &[f64],
        header: &Header,
        found: &mut Collected,
    ) {
        let width = header.numbers_of_point();
        // A dataset that is cut off may end inside a point.
        let points = values.len() / width;
        if points == 0 {
            return;
        }
        let column = |k: usize| -> Vec<f64> {
            values.iter().skip(k).step_by(width).take(points).copied().collect()
        };
        let unit = header.abscissa_unit.clone().unwrap_or_else(|| "Hz".to_owned());
        let frequencies = match header.even() {
            Some((start, step)) => (0..points).map(|k| start + step * k as f64).collect(),
            None => column(0),
        };
        let first = width - if header.is_complex() { 2 } else { 1 };
        self.take(name, frequencies, unit, points < header.points, found);
        let unit = header.unit();
        let mut push = |name: String, values: Vec<f64>| {
            found.channels.push(Channel { unit: unit.clone(), ..Channel::of(name, values) });
        };
        if header.is_complex() {
            push(format!("{name}/real"), column(first));
            push(format!("{name}/imag"), column(first + 1));
        } else {
            push(name.to_owned(), column(first));
        }
    }

    /// Those of a dataset that is cut off are the first ones of another, if they can be.
    fn take(
        &mut self,
        name: &str,
        values: Vec<f64>,
        unit: String,
        is_cut: bool,
        found: &mut Collected,
    ) {
        let is_same = |k: &usize| {
            let of = |known: &Channel| match known.unit.as_deref() == Some(&unit) {
                true if is_cut => known.values.starts_with(&values),
                is_of_unit => is_of_unit && known.values == values,
            };
            found.channels.get(*k).is_some_and(of)
        };
        if self.channels.iter().any(is_same) {
            return;
        }
        let is_first = self.channels.is_empty();
        let name = if is_first { "frequency".to_owned() } else { format!("{name}/frequency") };
        self.channels.push(found.channels.len());
        found.channels.push(Channel { unit: Some(unit), ..Channel::of(name, values) });
    }
}
