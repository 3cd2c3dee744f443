//! A signal on an even grid, averaged over a block around each point.

/// A signal on an even grid. Its blocks are symmetric, so that averaging does not shift it.
#[derive(Debug, Clone)]
pub(super) struct EvenSignal {
    pub(super) start_s: f64,
    pub(super) step_s: f64,
    pub(super) values: Vec<f64>,
}

impl EvenSignal {
    /// A signal with uneven, increasing stamps, at its own median step, averaged over blocks of `block_s`.
    pub(super) fn of(stamps_s: &[f64], values: &[f64], step_s: f64, block_s: f64) -> Self {
        let (first, last) = (stamps_s[0], stamps_s[stamps_s.len() - 1]);
        let count = ((last - first) / step_s) as usize + 1;
        let mut even = Vec::with_capacity(count);
        let mut k = 0;
        for j in 0..count {
            let at = first + j as f64 * step_s;
            while k + 2 < stamps_s.len() && stamps_s[k + 1] <= at {
                k += 1;
            }
            let share = ((at - stamps_s[k]) / (stamps_s[k + 1] - stamps_s[k])).clamp(0.0, 1.0);
            even.push(values[k] + share * (values[k + 1] - values[k]));
        }
        Self { start_s: first, step_s, values: even }.averaged((block_s / step_s).round() as usize)
    }

    /// Means over `rows` steps around each point; over an even number of steps both ends count half.
    fn averaged(self, rows: usize) -> Self {
        if rows < 2 || self.values.len() <= rows + 1 {
            return self;
        }
        let half = rows / 2;
        let mut sums = Vec::with_capacity(self.values.len() + 1);
        let mut sum = 0.0;
        sums.push(sum);
        for value in &self.values {
            sum += value;
            sums.push(sum);
        }
        let ends = if rows.is_multiple_of(2) { 0.5 } else { 0.0 };
        let mean = |k: usize| {
            let (first, last) = (k - half, k + half);
            let whole = sums[last + 1] - sums[first];
            (whole - ends * (self.values[first] + self.values[last])) / rows as f64
        };
        let values = (half..self.values.len() - half).map(mean).collect();
        Self { start_s: self.start_s + half as f64 * self.step_s, values, ..self }
    }

    /// Every n-th point, so that the points are at least `step_s` apart.
    pub(super) fn every(&self, step_s: f64) -> Self {
        let n = ((step_s / self.step_s).round() as usize).max(1);
        let values = self.values.iter().copied().step_by(n).collect();
        Self { start_s: self.start_s, step_s: self.step_s * n as f64, values }
    }

    /// The part of at most so many points in which the signal changes most.
    pub(super) fn liveliest(&self, points: usize) -> Self {
        if self.values.len() <= points {
            return self.clone();
        }
        let change = |k: usize| (self.values[k + 1] - self.values[k]).powi(2);
        let mut sum: f64 = (0..points - 1).map(change).sum();
        let (mut first, mut most) = (0, sum);
        for k in 1..=self.values.len() - points {
            sum += change(k + points - 2) - change(k - 1);
            if sum > most {
                (first, most) = (k, sum);
            }
        }
        let values = self.values[first..first + points].to_vec();
        Self { start_s: self.time_s(first), values, ..*self }
    }

    pub(super) fn end_s(&self) -> f64 {
        self.start_s + self.step_s * self.values.len().saturating_sub(1) as f64
    }

    pub(super) fn time_s(&self, k: usize) -> f64 {
        self.start_s + self.step_s * k as f64
    }

    /// The value at a time, by the cubic through the four nearest points; that of the end outside.
    pub(super) fn at(&self, time_s: f64) -> f64 {
        let last = self.values.len() - 1;
        let place = ((time_s - self.start_s) / self.step_s).clamp(0.0, last as f64);
        if last < 3 {
            return self.values[place.round() as usize];
        }
        let first = (place as usize).saturating_sub(1).min(last - 3);
        let x = place - first as f64;
        let y = &self.values[first..first + 4];
        let (a, b, c, d) = (x, x - 1.0, x - 2.0, x - 3.0);
        -b * c * d / 6.0 * y[0] + a * c * d / 2.0 * y[1] - a * b * d / 2.0 * y[2]
            + a * b * c / 6.0 * y[3]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn averaging_does_not_shift() {
        let stamps: Vec<f64> = (0..400).map(|k| 0.001 * f64::from(k)).collect();
        let line: Vec<f64> = stamps.iter().map(|t| 3.0 * t).collect();
        for block in [0.001, 0.004, 0.005] {
            let even = EvenSignal::of(&stamps, &line, 0.001, block);
            for t in [0.05, 0.123_4, 0.35] {
                assert!((even.at(t) - 3.0 * t).abs() < 1e-12, "{block}");
            }
            let fewer = even.every(0.01);
            assert!((fewer.at(0.2) - 0.6).abs() < 1e-12 && (fewer.step_s - 0.01).abs() < 1e-12);
        }
    }

    #[test]
    fn a_cubic_is_interpolated_exactly() {
        let stamps: Vec<f64> = (0..40).map(|k| 0.1 * f64::from(k)).collect();
        let cubic = |t: f64| 1.0 - t + 0.5 * t * t * t;
        let values: Vec<f64> = stamps.iter().map(|t| cubic(*t)).collect();
        let even = EvenSignal::of(&stamps, &values, 0.1, 0.1);
        for t in [0.01, 1.234, 3.88] {
            assert!((even.at(t) - cubic(t)).abs() < 1e-9, "{t}");
        }
    }
}
