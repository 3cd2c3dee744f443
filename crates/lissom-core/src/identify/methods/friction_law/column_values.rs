//! The functions of speed and angle that a law's columns integrate, where windows lie.
#![expect(clippy::inline_always, reason = "compiled for wide registers as one")]

use std::ops::Range;

use crate::drive::Falloff;
use crate::friction::Root;
use crate::identify::methods::friction_law::law_term::Column;

/// Values of every column at the samples from `base` to `end`.
pub(super) struct ColumnValues<'a> {
    columns: &'a [Column],
    knots: &'a [f64],
    base: usize,
    end: usize,
    values: Vec<Vec<f64>>,
}

impl<'a> ColumnValues<'a> {
    pub(super) fn new(columns: &'a [Column], knots: &'a [f64]) -> Self {
        Self { columns, knots, base: 0, end: 0, values: vec![Vec::new(); columns.len()] }
    }

    /// Makes the values of samples that ascend from call to call; each is found once.
    #[inline(always)]
    pub(super) fn reach(&mut self, samples: Range<usize>, velocity: &[f64], angle: &[f64]) {
        if samples.start >= self.end {
            (self.base, self.end) = (samples.start, samples.start);
            self.values.iter_mut().for_each(Vec::clear);
        }
        let new = self.end.max(samples.start)..samples.end;
        let (velocity, angle) = (&velocity[new.clone()], &angle[new]);
        for (column, values) in self.columns.iter().zip(&mut self.values) {
            if matches!(column, Column::Lag | Column::Rate(_)) {
                continue;
            }
            let before = values.len();
            values.resize(before + velocity.len(), 0.0);
            let values = values[before..].iter_mut().zip(velocity);
            match *column {
                Column::Hat(j) => {
                    values.for_each(|(value, v)| *value = hat(self.knots, j, v.abs()));
                }
                Column::NearRest(fall, Falloff::Exponential) => {
                    for (value, v) in values {
                        *value = exp_of_negative(-v.abs() / fall);
                    }
                }
                Column::NearRest(fall, Falloff::Gaussian) => {
                    for (value, v) in values {
                        *value = exp_of_negative(-(v / fall) * (v / fall));
                    }
                }
                Column::Root => values.for_each(|(value, v)| *value = Root::growth(v.abs())),
                column => {
                    let both = values.zip(angle);
                    both.for_each(|((value, v), x)| *value = column.at(v.abs(), *x));
                }
            }
        }
        self.end = samples.end;
    }

    /// Values of column number `index` from a sample on.
    #[inline(always)]
    pub(super) fn from(&self, index: usize, sample: usize) -> &[f64] {
        &self.values[index][sample - self.base..]
    }
}

/// e^x of x ≤ 0 to a few units of the last place, without branches: many are found side by side.
#[inline(always)]
fn exp_of_negative(x: f64) -> f64 {
    /// Added to a number below 2^51, its last digits are those of the nearest whole number.
    const WHOLE: f64 = 6_755_399_441_055_744.0;
    /// ln 2 in two parts, the first with few digits.
    const LN_2: [f64; 2] = [0.693_147_180_369_123_8, 1.908_214_929_270_587_7e-10];
    /// 1/k! from 13 to 0.
    const TAYLOR: [f64; 14] = {
        let mut terms = [1.0; 14];
        let mut k = 12;
        loop {
            terms[k] = terms[k + 1] * (13 - k) as f64;
            if k == 0 {
                break;
            }
            k -= 1;
        }
        let mut inverse = [0.0; 14];
        let mut k = 0;
        while k < 14 {
            inverse[k] = 1.0 / terms[k];
            k += 1;
        }
        inverse
    };
    // Below it the result is no normal number, and nothing beside others.
    let x = x.max(-700.0);
    let shifted = x * std::f64::consts::LOG2_E + WHOLE;
    let whole = shifted - WHOLE;
    let rest = (x - whole * LN_2[0]) - whole * LN_2[1];
    let mut sum = TAYLOR[0];
    for term in &TAYLOR[1..] {
        sum = sum * rest + term;
    }
    sum * f64::from_bits(shifted.to_bits().wrapping_add(1023) << 52)
}

/// One at knot `j`, falling to zero at its neighbours; beyond the first and the last knot the lines go on, so
/// that friction that grows in proportion to speed is a sum of hats everywhere.
pub(super) fn hat(knots: &[f64], j: usize, speed: f64) -> f64 {
    let last = knots.len().saturating_sub(2);
    let left = knots.partition_point(|knot| *knot <= speed).saturating_sub(1).min(last);
    let Some(right) = knots.get(left + 1) else { return 1.0 };
    let share = (speed - knots[left]) / (right - knots[left]);
    match j {
        j if j == left => 1.0 - share,
        j if j == left + 1 => share,
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_exponential_is_that_of_the_library() {
        for k in 0..70_000 {
            let x = -0.01 * f64::from(k);
            assert!((exp_of_negative(x) / x.exp() - 1.0).abs() < 1e-15, "{x}");
        }
        assert!(exp_of_negative(-1e9) < 1e-300);
    }

    #[test]
    fn hats_add_up_to_one() {
        let knots = [0.1, 0.2, 0.5, 1.0];
        for speed in [0.0, 0.1, 0.15, 0.3, 0.7, 1.0, 3.0] {
            let sum: f64 = (0..4).map(|j| hat(&knots, j, speed)).sum();
            assert!((sum - 1.0).abs() < 1e-12, "{speed}: {sum}");
            let line: f64 = (0..4).map(|j| hat(&knots, j, speed) * knots[j]).sum();
            assert!((line - speed).abs() < 1e-12, "{speed}: {line}");
        }
    }
}
