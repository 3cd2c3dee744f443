//! A window that slides over a log: means of a signal, of its rates and of a held command.
#![expect(clippy::inline_always, reason = "compiled for wide registers as one")]

use crate::identify::prepare::window::{Weights, Window};
use crate::record::Hold;

/// The half-power frequency of a sin⁴ window is this over its length.
const HALF_POWER: f64 = 0.93;

/// A sin⁴ window of weight one, with the same for a command that acts later than it is logged.
#[derive(Debug, Clone)]
pub(super) struct Kernel {
    window: Window,
    sample_time_s: f64,
    /// Weights of the command's samples from `first` on, relative to the window's first sample.
    command: Weights,
    first: isize,
    /// 1/∫w.
    scale: f64,
}

impl Kernel {
    /// A window of `n` sample intervals; the command acts `lag_s` later than it is logged.
    pub(super) fn new(n: usize, sample_time_s: f64, hold: Hold, lag_s: f64) -> Self {
        let window = Window::new(n, sample_time_s);
        let total: f64 = window.held.iter().sum();
        let samples = lag_s / sample_time_s;
        let (whole, share) = (samples.floor(), samples - samples.floor());
        // Of a held command the weight of whole intervals, of a measured one that of its samples.
        let undelayed: Vec<f64> = match hold {
            Hold::Sampled => window.held.to_vec(),
            Hold::Measured => window.value.iter().map(|w| w * sample_time_s).collect(),
        };
        let at = |i: usize| undelayed.get(i).copied().unwrap_or(0.0);
        let before = |i: usize| i.checked_sub(1).map_or(0.0, at);
        let command = (0..=undelayed.len())
            .map(|i| ((1.0 - share) * before(i) + share * at(i)) / total)
            .collect();
        let command = Weights::new(command);
        Self { window, sample_time_s, command, first: -(whole as isize) - 1, scale: 1.0 / total }
    }

    /// Sample intervals spanned.
    pub(super) fn len(&self) -> usize {
        self.window.len()
    }

    /// Half-power frequency \[Hz\].
    pub(super) fn half_power_hz(&self) -> f64 {
        HALF_POWER / (self.len() as f64 * self.sample_time_s)
    }

    /// Mean of `of(sample)` under the window that begins at sample `k`.
    pub(super) fn mean(&self, k: usize, of: impl Fn(usize) -> f64) -> f64 {
        let sum: f64 = self.window.value.iter().enumerate().map(|(i, w)| w * of(k + i)).sum();
        sum * self.sample_time_s * self.scale
    }

    /// Mean rate of a signal, by parts.
    pub(super) fn rate(&self, k: usize, of: impl Fn(usize) -> f64) -> f64 {
        let origin = of(k);
        let weights = self.window.first.iter().enumerate();
        let sum: f64 = weights.map(|(i, w)| w * (of(k + i) - origin)).sum();
        -sum * self.sample_time_s * self.scale
    }

    /// Mean second derivative of a signal, by parts.
    pub(super) fn acceleration(&self, k: usize, of: impl Fn(usize) -> f64) -> f64 {
        let origin = of(k);
        let weights = self.window.second.iter().enumerate();
        let sum: f64 = weights.map(|(i, w)| w * (of(k + i) - origin)).sum();
        sum * self.sample_time_s * self.scale
    }

    /// [`Self::mean`] of samples from the window's first on.
    #[inline(always)]
    pub(super) fn mean_of(&self, x: &[f64]) -> f64 {
        self.window.value.dot(x) * (self.sample_time_s * self.scale)
    }

    /// [`Self::rate`] of samples from the window's first on.
    #[inline(always)]
    pub(super) fn rate_of(&self, x: &[f64]) -> f64 {
        -self.window.first.dot_from(x, x[0]) * (self.sample_time_s * self.scale)
    }

    /// [`Self::acceleration`] of samples from the window's first on.
    #[inline(always)]
    pub(super) fn acceleration_of(&self, x: &[f64]) -> f64 {
        self.window.second.dot_from(x, x[0]) * (self.sample_time_s * self.scale)
    }

    /// Mean of the command that acts under the window.
    #[inline(always)]
    pub(super) fn command(&self, k: usize, command: &[f64]) -> f64 {
        let begin = k.cast_signed() + self.first;
        let within = usize::try_from(begin).ok().and_then(|begin| command.get(begin..));
        if let Some(acting) = within.filter(|acting| acting.len() >= self.command.len()) {
            return self.command.dot(acting);
        }
        let last = command.len().cast_signed() - 1;
        let at = |i: usize| {
            let j = k.cast_signed() + self.first + i.cast_signed();
            command[j.clamp(0, last).cast_unsigned()]
        };
        self.command.iter().enumerate().map(|(i, w)| w * at(i)).sum()
    }

    /// Whether all that [`Self::command`] takes is among `len` samples.
    pub(super) fn reads_command(&self, k: usize, len: usize) -> bool {
        let at = |i: usize| k.cast_signed() + self.first + i.cast_signed();
        let used = |w: &f64| *w != 0.0;
        let (first, last) =
            (self.command.iter().position(used), self.command.iter().rposition(used));
        first.is_none_or(|i| at(i) >= 0) && last.is_none_or(|i| at(i) < len.cast_signed())
    }

    /// Where the window at `k` begins in a signal that comes `lag_s` later, in whole samples, and what is
    /// left of the lag \[s\].
    pub(super) fn late(&self, k: usize, lag_s: f64) -> (isize, f64) {
        let whole = (lag_s / self.sample_time_s).round();
        (k.cast_signed().saturating_add(whole as isize), lag_s - whole * self.sample_time_s)
    }

    /// Standard error of a mean rate by white noise of deviation one in the samples.
    pub(super) fn rate_noise(&self) -> f64 {
        self.noise(&self.window.first)
    }

    /// Standard error of a mean second derivative by the same.
    pub(super) fn acceleration_noise(&self) -> f64 {
        self.noise(&self.window.second)
    }

    fn noise(&self, weights: &[f64]) -> f64 {
        weights.iter().map(|w| w * w).sum::<f64>().sqrt() * self.sample_time_s * self.scale
    }
}
