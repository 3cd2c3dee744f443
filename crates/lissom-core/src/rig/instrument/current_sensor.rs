//! A sensor of the motor's current.

use std::collections::VecDeque;

use super::{Noise, Sensor};

/// Time to which a row of a measured current belongs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum CurrentReading {
    /// Mean over one row time, centred at the time of the row: neither early nor late, as
    /// [`Hold::Measured`](crate::record::Hold::Measured) assumes.
    #[default]
    Centred,
    /// Current at the instant at which the angles are read, just before the controller changes it: late by half a
    /// sample of the controller.
    AtInstant,
    /// Mean over the row time that ends at the time of the row: late by half a row.
    MeanBefore,
}

/// A sensor of the current that flows through the motor, after amplifier and delay.
///
/// ```
/// # use lissom::rig::{CurrentReading, CurrentSensor, Instruments, Noise};
/// let mut instruments = Instruments::ideal(0.001)?; // 1 ms
/// instruments.current = Some(CurrentSensor::from(Noise::new(0.02)?)); // A
/// assert_eq!(instruments.current.unwrap().reading, CurrentReading::Centred);
/// # Ok::<(), lissom::rig::RigError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CurrentSensor {
    /// Noise and rounding, in A.
    pub sensor: Sensor,
    /// Time to which a row belongs.
    pub reading: CurrentReading,
}

impl From<Noise> for CurrentSensor {
    fn from(noise: Noise) -> Self {
        Self { sensor: noise.into(), reading: CurrentReading::default() }
    }
}

/// The mean current of every sample of the sensors \[A\], as far back as rows need it.
#[derive(Debug, Clone)]
pub(in crate::rig) struct CurrentTrace {
    mean_a: VecDeque<f64>,
    /// Samples kept while the transient goes.
    before: usize,
    /// Whether all further samples are kept.
    recording: bool,
}

impl CurrentTrace {
    /// A trace for rows of `every` samples; before its start no current flows.
    pub(in crate::rig) fn new(every: usize) -> Self {
        Self { mean_a: std::iter::repeat_n(0.0, every).collect(), before: every, recording: false }
    }

    /// Adds the mean current of a sample.
    pub(in crate::rig) fn push(&mut self, mean_a: f64) {
        self.mean_a.push_back(mean_a);
        if !self.recording {
            self.mean_a.pop_front();
        }
    }

    /// From here on samples belong to the log.
    pub(in crate::rig) fn record(&mut self) {
        self.recording = true;
    }

    /// The current of row `row`, without noise \[A\].
    pub(in crate::rig) fn row_a(&self, row: usize, reading: CurrentReading) -> f64 {
        let at = self.before + row * self.before;
        match reading {
            CurrentReading::AtInstant => self.mean_a[at - 1],
            CurrentReading::MeanBefore => self.mean(2 * (at - self.before), 2 * at),
            CurrentReading::Centred => self.mean(2 * at - self.before, 2 * at + self.before),
        }
    }

    /// The mean from half sample `from` to half sample `to`.
    fn mean(&self, from: usize, to: usize) -> f64 {
        // A record is as long as its rows: the last one has the half of its time that follows.
        let sum: f64 = (from..to).map(|half| self.mean_a[half / 2]).sum();
        sum / (to - from) as f64
    }
}

#[cfg(test)]
mod tests {
    #![expect(clippy::float_cmp, reason = "hand-computed values that are exact in binary")]

    use super::*;

    /// Currents 1, 2, 3 … A of the samples of a record, after 0 A.
    fn rows(every: usize, reading: CurrentReading) -> [f64; 3] {
        let mut trace = CurrentTrace::new(every);
        for _ in 0..5 {
            trace.push(0.0);
        }
        trace.record();
        for k in 1..=4 * every {
            trace.push(k as f64);
        }
        [0, 1, 2].map(|row| trace.row_a(row, reading))
    }

    #[test]
    fn a_row_reads_what_its_kind_says() {
        use CurrentReading::{AtInstant, Centred, MeanBefore};
        // Rows at every sample: the controller changes the current at the row's instant.
        assert_eq!(rows(1, AtInstant), [0.0, 1.0, 2.0]);
        assert_eq!(rows(1, MeanBefore), [0.0, 1.0, 2.0]);
        assert_eq!(rows(1, Centred), [0.5, 1.5, 2.5]);
        // One row in four: row 1 is the instant between samples 4 and 5.
        assert_eq!(rows(4, AtInstant), [0.0, 4.0, 8.0]);
        assert_eq!(rows(4, MeanBefore), [0.0, 2.5, 6.5]);
        assert_eq!(rows(4, Centred), [0.75, 4.5, 8.5]);
        // One row in three: half of a sample at each end.
        assert_eq!(rows(3, Centred), [(1.0 + 0.5 * 2.0) / 3.0, 3.5, 6.5]);
    }
}
