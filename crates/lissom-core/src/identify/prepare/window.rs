//! The smooth window of the regression.
#![expect(clippy::inline_always, reason = "compiled for wide registers as one: half the time")]

use std::f64::consts::PI;
use std::ops::Deref;
use std::sync::Arc;

use crate::record::Run;

/// Distance from one window to the next, as a part of its length: neighbours then share nearly all that they show.
pub(crate) const WINDOW_STEP: f64 = 0.25;
/// Longest smoothing of the velocity, as a part of a window's length: what is smoothed away is then small in the window.
pub(crate) const SMOOTHED_PART: f64 = 1.0 / 3.0;
/// Fewest sample intervals in a window.
const LEAST_SAMPLES: usize = 4;

/// `w(x) = sin⁴(πx)` on a span of n samples, with derivatives and integrals.
///
/// w and its first three derivatives vanish at both ends: integrating by parts twice moves the
/// derivatives of a measured signal onto w and leaves no boundary terms.
#[derive(Debug, Clone)]
pub(crate) struct Window {
    /// w at samples 0..=n.
    pub(crate) value: Weights,
    /// ẇ at samples 0..=n \[1/s\].
    pub(crate) first: Weights,
    /// ẅ at samples 0..=n \[1/s²\].
    pub(crate) second: Weights,
    /// ∫w over each sample interval \[s\], length n: what a held signal is weighted with.
    pub(crate) held: Weights,
    /// ∫ẇ over each sample interval, length n.
    pub(crate) rise: Weights,
    /// ∫w over all of it \[s\].
    pub(crate) area: f64,
    /// 1/√∫ẅ²: scales a row to the noise that white noise in the angle puts into it.
    pub(crate) row_scale: f64,
}

impl Window {
    /// A window of `n` sample intervals.
    pub(crate) fn new(n: usize, sample_time_s: f64) -> Self {
        let length = n as f64 * sample_time_s;
        let rate = PI / length;
        let mut value = vec![0.0; n + 1];
        let (mut first, mut second, mut integral) = (value.clone(), value.clone(), value.clone());
        for k in 0..=n {
            let y = PI * k as f64 / n as f64;
            let (s, c) = y.sin_cos();
            value[k] = s.powi(4);
            first[k] = 4.0 * rate * s.powi(3) * c;
            second[k] = rate * rate * (12.0 * s * s * c * c - 4.0 * s.powi(4));
            // ∫ sin⁴y dy = 3y/8 − sin(2y)/4 + sin(4y)/32, with sin 2y = 2·s·c, sin 4y = 2·sin 2y·cos 2y.
            integral[k] = (0.375 * y - 0.5 * s * c + 0.125 * s * c * (1.0 - 2.0 * s * s)) / rate;
        }
        let differences = |x: &[f64]| x.windows(2).map(|x| x[1] - x[0]).collect::<Vec<f64>>();
        let (held, rise) = (differences(&integral), differences(&value));
        let power: f64 = second.iter().map(|v| v * v).sum::<f64>() * sample_time_s;
        let area = held.iter().sum();
        let row_scale = 1.0 / power.sqrt();
        let [value, first, second, held, rise] =
            [value, first, second, held, rise].map(Weights::new);
        Self { value, first, second, held, rise, area, row_scale }
    }

    /// Windows of one length in seconds for every run, shared where the sample times are the same;
    /// `None` where a run does not hold one, or `wanted` does not want it for the run of this index at so
    /// many samples.
    pub(crate) fn of_runs(
        runs: &[Run],
        length_s: f64,
        wanted: impl Fn(usize, usize) -> bool,
    ) -> Vec<Option<Arc<Self>>> {
        let mut made: Vec<(f64, Arc<Self>)> = Vec::new();
        let of = |(index, run): (usize, &Run)| {
            let t = run.sample_time_s();
            let n = (length_s / t).round() as usize;
            if n < LEAST_SAMPLES || n >= run.len() || !wanted(index, n) {
                return None;
            }
            let known = made.iter().find(|(time, _)| time.total_cmp(&t).is_eq());
            if let Some((_, window)) = known {
                return Some(Arc::clone(window));
            }
            let window = Arc::new(Self::new(n, t));
            made.push((t, Arc::clone(&window)));
            Some(window)
        };
        runs.iter().enumerate().map(of).collect()
    }

    /// Sample intervals spanned.
    pub(crate) fn len(&self) -> usize {
        self.held.len()
    }
}

/// Numbers to weigh samples with, and zeros after them: sums go by whole groups of lanes.
#[derive(Debug, Clone)]
pub(crate) struct Weights {
    padded: Vec<f64>,
    len: usize,
}

impl Deref for Weights {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        &self.padded[..self.len]
    }
}

impl Weights {
    pub(crate) fn new(mut weights: Vec<f64>) -> Self {
        let len = weights.len();
        weights.resize(len.next_multiple_of(LANES), 0.0);
        Self { padded: weights, len }
    }

    /// Σ w·x over the first samples of `x`; those that follow save time.
    #[inline(always)]
    pub(crate) fn dot(&self, x: &[f64]) -> f64 {
        sum(&self.padded, x, x, |w, x, _| w * x)
    }

    /// Σ w·(x − origin) over the first samples of `x`; those that follow save time.
    #[inline(always)]
    pub(crate) fn dot_from(&self, x: &[f64], origin: f64) -> f64 {
        sum(&self.padded, x, x, |w, x, _| w * (x - origin))
    }

    /// Σ w·(x − y) over the first samples of both; those that follow save time.
    #[inline(always)]
    pub(crate) fn dot_difference(&self, x: &[f64], y: &[f64]) -> f64 {
        sum(&self.padded, x, y, |w, x, y| w * (x - y))
    }
}

/// Σ a·b over the shorter of two slices.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    sum(a, b, b, |a, b, _| a * b)
}

/// Sums kept side by side: a single one would wait for each addition.
const LANES: usize = 8;

/// Σ f(a, b, c) over the shortest of three slices. Inlined, to be
/// compiled for the widest registers that there are.
#[inline(always)]
fn sum(a: &[f64], b: &[f64], c: &[f64], f: impl Fn(f64, f64, f64) -> f64) -> f64 {
    let n = a.len().min(b.len()).min(c.len());
    let ((a, a_rest), (b, b_rest), (c, c_rest)) =
        (a[..n].as_chunks::<LANES>(), b[..n].as_chunks::<LANES>(), c[..n].as_chunks::<LANES>());
    let mut lanes = [0.0; LANES];
    for ((a, b), c) in a.iter().zip(b).zip(c) {
        for lane in 0..LANES {
            lanes[lane] += f(a[lane], b[lane], c[lane]);
        }
    }
    let mut rest = 0.0;
    for ((a, b), c) in a_rest.iter().zip(b_rest).zip(c_rest) {
        rest += f(*a, *b, *c);
    }
    lanes.iter().sum::<f64>() + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What integration by parts leaves of `∫w·ẍ − ∫ẅ·x` for a sinusoid over 0.4 s.
    fn left_over(n: usize) -> f64 {
        let t = 0.4 / n as f64;
        let w = Window::new(n, t);
        let x: Vec<f64> = (0..=n).map(|k| (3.0 * k as f64 * t).sin()).collect();
        let a: Vec<f64> = x.iter().map(|x| -9.0 * x).collect();
        (dot(&w.value, &a) - dot(&w.second, &x)).abs() * t
    }

    #[test]
    fn integration_by_parts_holds_to_the_fourth_order() {
        let (coarse, fine) = (left_over(20), left_over(40));
        assert!(coarse < 2e-4, "{coarse}");
        assert!(fine < coarse / 15.0, "{fine} {coarse}");
    }

    #[test]
    fn held_weights_sum_to_the_integral() {
        let w = Window::new(37, 0.01);
        assert!((w.area - 0.375 * 0.37).abs() < 1e-14);
    }

    #[test]
    fn sums_side_by_side_are_the_sums() {
        let of = |shift: f64| (0..37).map(|k| (f64::from(k) + shift).sin()).collect::<Vec<f64>>();
        let (a, b, c) = (of(0.0), of(0.3), of(1.7));
        for n in [0, 1, 7, 8, 9, 16, 37] {
            let weights = Weights::new(a[..n].to_vec());
            assert_eq!(weights[..], a[..n]);
            let one = |f: &dyn Fn(usize) -> f64| (0..n).map(f).sum::<f64>();
            // With samples behind the last one that counts, and without.
            for most in [n, 37] {
                let (b, c) = (&b[..most], &c[..most]);
                let pairs = [
                    (weights.dot(b), one(&|k| a[k] * b[k])),
                    (weights.dot_from(b, 0.4), one(&|k| a[k] * (b[k] - 0.4))),
                    (weights.dot_difference(b, c), one(&|k| a[k] * (b[k] - c[k]))),
                ];
                assert!(pairs.iter().all(|(x, y)| (x - y).abs() < 1e-14), "{n} {pairs:?}");
            }
        }
        assert!((dot(&a[..5], &b) - dot(&a[..5], &b[..5])).abs() < 1e-15);
    }
}
