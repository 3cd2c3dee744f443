//! Ends a search before it is done: another thread asks for it, or a time is over.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// Shared by who waits for a result and by the search: all clones are one.
///
/// ```
/// use lissom::identify::Interrupt;
/// let waiting = Interrupt::default();
/// let searching = waiting.clone();
/// waiting.ask();
/// assert!(searching.is_asked());
/// ```
#[derive(Debug, Clone, Default)]
pub struct Interrupt {
    shared: Arc<Shared>,
    until: Option<Instant>,
}

#[derive(Debug, Default)]
struct Shared {
    asked: AtomicBool,
    evaluations: AtomicU64,
}

impl Interrupt {
    /// One that asks by itself after a time; results then depend on how fast the machine is.
    pub fn after(limit: Duration) -> Self {
        Self { until: Instant::now().checked_add(limit), ..Self::default() }
    }

    /// Asks the search to end with the best that it has found so far.
    pub fn ask(&self) {
        self.shared.asked.store(true, Ordering::Relaxed);
    }

    /// Whether the search is to end.
    pub fn is_asked(&self) -> bool {
        self.shared.asked.load(Ordering::Relaxed)
            || self.until.is_some_and(|until| Instant::now() >= until)
    }

    /// Evaluations that the search has made so far, for a display of its progress.
    pub fn evaluations(&self) -> u64 {
        self.shared.evaluations.load(Ordering::Relaxed)
    }

    /// Counts evaluations.
    pub(crate) fn count(&self, evaluations: u64) {
        self.shared.evaluations.fetch_add(evaluations, Ordering::Relaxed);
    }
}
