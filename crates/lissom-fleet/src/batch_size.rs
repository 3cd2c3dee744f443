//! How many logs a batch has.

/// Time that a batch should take \[s\]: the start of its process, about 0.05 s, and its way through a scheduler are then
/// far below 5 % of it.
const TARGET_S: f64 = 10.0;
/// Size of batches until the first rows are there.
const FIRST: usize = 8;
/// Largest size: rows of a batch are in memory, and work that a killed worker loses.
const MOST: usize = 2000;
/// Batches for each worker that the remaining logs are divided into: the last batches are small, so that all workers finish at
/// about the same time.
const SHARES: usize = 3;
/// Time that the last batches take at least \[s\].
const LEAST_S: f64 = 0.5;

/// Sizes of batches, from the time that logs have taken.
#[derive(Debug, Clone, Default)]
pub(crate) struct BatchSize {
    logs: usize,
    seconds: f64,
}

impl BatchSize {
    /// Takes the time of a batch into account.
    pub(crate) fn learn(&mut self, logs: usize, seconds: f64) {
        self.logs += logs;
        self.seconds += seconds;
    }

    /// Size of the next batch.
    pub(crate) fn next(&self, waiting: usize, workers: usize) -> usize {
        let share = waiting.div_ceil(SHARES * workers.max(1));
        if self.logs == 0 {
            return FIRST.min(share);
        }
        let each = (self.seconds / self.logs as f64).max(f64::MIN_POSITIVE);
        let logs_in = |seconds: f64| (seconds / each).min(MOST as f64) as usize;
        share.clamp(logs_in(LEAST_S), logs_in(TARGET_S)).max(1).min(waiting)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_follow_the_time_of_logs() {
        let mut size = BatchSize::default();
        assert_eq!(size.next(1_000_000, 2), FIRST);
        size.learn(8, 0.16);
        assert_eq!(size.next(1_000_000, 2), 500);
        assert_eq!(size.next(600, 2), 100);
        assert_eq!((size.next(60, 2), size.next(20, 2)), (25, 20));
        assert_eq!((size.next(1, 8), size.next(0, 8)), (1, 0));
        let mut slow = BatchSize::default();
        slow.learn(1, 300.0);
        assert_eq!(slow.next(1_000_000, 100), 1);
        let mut fast = BatchSize::default();
        fast.learn(10, 0.0);
        assert_eq!(fast.next(1_000_000, 1), MOST);
    }
}
