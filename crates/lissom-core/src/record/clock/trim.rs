//! Times of a log that are left out.

use super::{ClockError, LogRows};

/// Which times of a log are left out. Times count from its first stamp.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Trim {
    /// Length of the beginning that is left out \[s\].
    pub skip_s: f64,
    /// Time after which everything is left out \[s\]; nothing if absent.
    pub until_s: Option<f64>,
    /// Stretches that are left out, from and to \[s\].
    pub left_out_s: Vec<[f64; 2]>,
}

impl Trim {
    /// Whether nothing but the beginning is left out.
    pub fn is_head(&self) -> bool {
        self.until_s.is_none() && self.left_out_s.is_empty()
    }

    /// Removes the rows that are left out; the log is cut where rows between others are removed.
    pub(super) fn apply(&self, log: &mut LogRows, cuts: &mut Vec<usize>) -> Result<(), ClockError> {
        let start_s = log.stamps_s.first().copied().unwrap_or(0.0);
        // Where the clock starts again, the beginning is that of the first stretch.
        let stretch = &log.stamps_s[..cuts.first().copied().unwrap_or(log.stamps_s.len())];
        let first = stretch.partition_point(|stamp| stamp - start_s < self.skip_s);
        let is_kept = |stamp_s: f64| {
            let time_s = stamp_s - start_s;
            self.until_s.is_none_or(|until_s| time_s <= until_s)
                && !self.left_out_s.iter().any(|[from, to]| (*from..=*to).contains(&time_s))
        };
        let rows = first..log.stamps_s.len();
        let kept: Vec<usize> = rows.filter(|row| is_kept(log.stamps_s[*row])).collect();
        if kept.len() < 2 {
            let length_s = log.stamps_s.last().map_or(0.0, |end| end - start_s);
            return Err(ClockError::NothingLeft { left: kept.len(), length_s });
        }
        if kept.len() == log.stamps_s.len() {
            return Ok(());
        }
        let gaps = (1..kept.len()).filter(|k| kept[*k] > kept[*k - 1] + 1);
        let known = cuts.iter().map(|cut| kept.partition_point(|row| row < cut));
        let mut all: Vec<usize> = known.chain(gaps).collect();
        all.retain(|cut| (1..kept.len()).contains(cut));
        all.sort_unstable();
        all.dedup();
        *cuts = all;
        let channels = [&mut log.stamps_s, &mut log.command, &mut log.motor];
        for channel in channels.into_iter().chain(&mut log.tips) {
            *channel = kept.iter().map(|&row| channel[row]).collect();
        }
        Ok(())
    }
}
