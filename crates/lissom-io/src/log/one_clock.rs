//! Channels of one log with different stamps, brought onto the stamps of one of them.

use lissom_core::record::Hold;

/// Channels whose stamps differ are interpolated only if each has a value in at least this share of the rows: single
/// missing cells are an error, not another clock.
const SHARE_LEAST: f64 = 0.02;

/// A channel with a stamp for each value.
pub(crate) struct Series {
    time: Vec<f64>,
    value: Vec<f64>,
    hold: Hold,
    /// Share of the rows that have a value.
    share: f64,
}

impl Series {
    /// Of stamps and values, without the rows in which the value is missing.
    pub(crate) fn of(time: &[f64], value: &[f64], hold: Hold) -> Self {
        let present = |(t, v): &(&f64, &f64)| t.is_finite() && v.is_finite();
        let (t, v): (Vec<f64>, Vec<f64>) =
            time.iter().zip(value).filter(present).map(|(t, v)| (*t, *v)).unzip();
        let share = v.len() as f64 / value.len().max(1) as f64;
        Self { time: t, value: v, hold, share }
    }

    fn increases(&self) -> bool {
        self.time.len() > 3 && self.time.windows(2).all(|pair| pair[1] > pair[0])
    }

    /// The value at a time within the stamps: of a held signal the last one, of a measured one by a cubic through the
    /// four nearest. There must be at least four.
    pub(crate) fn at(&self, time: f64) -> f64 {
        let next = self.time.partition_point(|t| *t <= time);
        if self.hold == Hold::Sampled || next >= self.time.len() {
            return self.value[next.saturating_sub(1)];
        }
        let first = next.saturating_sub(2).min(self.time.len() - 4);
        let (t, v) = (&self.time[first..first + 4], &self.value[first..first + 4]);
        let weight = |k: usize| {
            let others = (0..4).filter(|j| *j != k);
            others.map(|j| (time - t[j]) / (t[k] - t[j])).product::<f64>()
        };
        (0..4).map(|k| weight(k) * v[k]).sum()
    }
}

/// Stamps and values on the clock of the command if it is held (its steps cannot be interpolated), else on that of the
/// motor. `series` are command, motor and further channels. `None` if a clock does not increase, if the channels share
/// no time, or if single values are missing.
pub(super) fn on_one_clock(series: &[Series]) -> Option<Vec<Vec<f64>>> {
    let complete = |s: &Series| s.share < 1.0 - SHARE_LEAST || s.share >= 1.0;
    if !series.iter().all(|s| s.increases() && s.share > SHARE_LEAST && complete(s)) {
        return None;
    }
    let base =
        series.iter().position(|s| s.hold == Hold::Sampled).unwrap_or(1.min(series.len() - 1));
    let first = series.iter().map(|s| s.time[0]).fold(f64::NEG_INFINITY, f64::max);
    let last = series.iter().map(|s| s.time[s.time.len() - 1]).fold(f64::INFINITY, f64::min);
    let within = |t: &f64| (first..=last).contains(t);
    let time: Vec<f64> = series[base].time.iter().copied().filter(within).collect();
    if time.len() < 2 {
        return None;
    }
    let values = series.iter().map(|s| time.iter().map(|t| s.at(*t)).collect::<Vec<f64>>());
    let values: Vec<Vec<f64>> = values.collect();
    Some(std::iter::once(time.clone()).chain(values).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_measured_channel_is_interpolated_and_a_held_one_is_not() {
        let held: Vec<f64> = (0..100).map(|k| 0.01 * f64::from(k)).collect();
        let late: Vec<f64> = held.iter().map(|t| t + 0.004).collect();
        let sine = |t: &f64| (6.0 * t).sin();
        let command: Vec<f64> = (0..100).map(f64::from).collect();
        let motor: Vec<f64> = late.iter().map(sine).collect();
        let series =
            [Series::of(&held, &command, Hold::Sampled), Series::of(&late, &motor, Hold::Measured)];
        let found = on_one_clock(&series).unwrap();
        assert!((found[0][0] - 0.01).abs() < 1e-12 && (found[1][0] - 1.0).abs() < 1e-12);
        for (t, q) in found[0].iter().zip(&found[2]) {
            assert!((q - sine(t)).abs() < 1e-5, "{t}: {q}");
        }
    }

    #[test]
    fn single_missing_cells_are_no_clock_of_their_own() {
        let time: Vec<f64> = (0..100).map(f64::from).collect();
        let mut value = time.clone();
        value[40] = f64::NAN;
        let series =
            [Series::of(&time, &time, Hold::Measured), Series::of(&time, &value, Hold::Measured)];
        assert_eq!(on_one_clock(&series), None);
    }
}
