//! What was done to a log, counted: one note of each kind.

use super::interpolation_error::InterpolationError;
use crate::finding::Finding;
use crate::record::note;

/// Counts over a whole log.
#[derive(Debug, Clone, Default)]
pub(super) struct Tally {
    pub(super) repeated: Option<Finding>,
    pub(super) restart: Option<Finding>,
    pub(super) rates: Option<Finding>,
    pub(super) gaps: usize,
    /// The longest gap: the stamp before it, its length.
    pub(super) longest_gap: (f64, f64),
    pub(super) dropped: usize,
    pub(super) dropped_samples: usize,
    pub(super) dropped_at_s: f64,
    pub(super) filled: usize,
    pub(super) samples: usize,
    pub(super) resampled: Option<Resampled>,
    pub(super) counted: Option<Counted>,
}

/// Stretches whose samples are not on a grid.
#[derive(Debug, Clone, Copy)]
pub(super) struct Resampled {
    pub(super) step_s: f64,
    pub(super) agreement: Option<f64>,
    pub(super) error: f64,
    pub(super) error_share: f64,
    pub(super) noise: f64,
}

impl Resampled {
    pub(super) fn new(step_s: f64, agreement: Option<f64>, found: InterpolationError) -> Self {
        let error_share = if found.bend > 0.0 { found.rms / found.bend } else { 0.0 };
        Self { step_s, agreement, error: found.rms, error_share, noise: found.noise }
    }
}

/// Stretches whose stamps are not believed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Counted {
    pub(super) step_s: f64,
    pub(super) jitter_rms_share: f64,
    pub(super) agreement: f64,
}

impl Tally {
    pub(super) fn gap(&mut self, at_s: f64, length_s: f64) {
        if self.gaps == 0 || length_s > self.longest_gap.1 {
            self.longest_gap = (at_s, length_s);
        }
        self.gaps += 1;
    }

    pub(super) fn drop(&mut self, at_s: f64, samples: usize) {
        if self.dropped == 0 {
            self.dropped_at_s = at_s;
        }
        self.dropped += 1;
        self.dropped_samples += samples;
    }

    pub(super) fn resample(&mut self, more: Resampled) {
        if self.resampled.is_none_or(|found| more.error_share > found.error_share) {
            self.resampled = Some(more);
        }
    }

    pub(super) fn count(&mut self, more: Counted) {
        if self.counted.is_none_or(|found| more.jitter_rms_share > found.jitter_rms_share) {
            self.counted = Some(more);
        }
    }

    pub(super) fn notes(self) -> Vec<Finding> {
        let mut notes: Vec<Finding> =
            [self.repeated, self.restart, self.rates].into_iter().flatten().collect();
        if let Some(Counted { step_s, jitter_rms_share, agreement }) = self.counted {
            notes.push(note::SampleCount { step_s, jitter_rms_share, agreement }.into());
        }
        if let Some(Resampled { step_s, agreement, error, error_share, noise }) = self.resampled {
            notes.push(note::Resampled { step_s, agreement, error, error_share, noise }.into());
        }
        if self.filled > 0 {
            let share = self.filled as f64 / self.samples.max(1) as f64;
            notes.push(note::RowsFilled { count: self.filled, share }.into());
        }
        if self.gaps > 0 {
            let (at_s, length_s) = self.longest_gap;
            notes.push(note::Gap { count: self.gaps, at_s, length_s }.into());
        }
        if self.dropped > 0 {
            let (count, at_s, samples) = (self.dropped, self.dropped_at_s, self.dropped_samples);
            notes.push(note::PieceDropped { count, at_s, samples }.into());
        }
        notes
    }
}
