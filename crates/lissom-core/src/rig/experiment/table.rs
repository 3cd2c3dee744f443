//! A signal that is given as a table.

use crate::rig::RigError;

/// Value of a [`Table`] between its times.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TableHold {
    /// The value of the time before (zero-order hold).
    Zero,
    /// Linear interpolation.
    Linear,
}

/// A signal given by values at increasing times. Before the first time it has the first value,
/// after the last time the last value.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    time_s: Vec<f64>,
    value: Vec<f64>,
    hold: TableHold,
}

impl Table {
    /// Builds a table from times \[s\] and values \[rad or A\].
    ///
    /// # Errors
    /// [`RigError::TableLength`] if the columns differ in length; [`RigError::EmptyTable`] without rows;
    /// [`RigError::TableNotFinite`] for NaN or infinity; [`RigError::TableOrder`] if times do not increase.
    pub fn new(time_s: Vec<f64>, value: Vec<f64>, hold: TableHold) -> Result<Self, RigError> {
        if time_s.len() != value.len() {
            return Err(RigError::TableLength { times: time_s.len(), values: value.len() });
        }
        if time_s.is_empty() {
            return Err(RigError::EmptyTable);
        }
        for (row, (&time_s, &value)) in time_s.iter().zip(&value).enumerate() {
            if !(time_s.is_finite() && value.is_finite()) {
                return Err(RigError::TableNotFinite { row, time_s, value });
            }
        }
        if let Some(row) = (1..time_s.len()).find(|&k| time_s[k] <= time_s[k - 1]) {
            let (before_s, after_s) = (time_s[row - 1], time_s[row]);
            return Err(RigError::TableOrder { row, before_s, after_s });
        }
        Ok(Self { time_s, value, hold })
    }

    /// Last time \[s\].
    pub fn end_s(&self) -> f64 {
        self.time_s[self.time_s.len() - 1]
    }

    /// Largest magnitude of the values \[rad or A\].
    pub fn amplitude(&self) -> f64 {
        self.value.iter().fold(0.0, |m, v| m.max(v.abs()))
    }

    /// Value at a time \[s\], in rad or A.
    pub fn value(&self, time_s: f64) -> f64 {
        let next = self.time_s.partition_point(|t| *t <= time_s);
        let Some(before) = next.checked_sub(1) else { return self.value[0] };
        if next == self.value.len() || self.hold == TableHold::Zero {
            return self.value[before];
        }
        let part = (time_s - self.time_s[before]) / (self.time_s[next] - self.time_s[before]);
        self.value[before] + part * (self.value[next] - self.value[before])
    }
}
