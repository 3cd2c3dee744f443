//! Ends a search early: another thread requests it, or a time limit is reached.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// A request to end a search early. The thread that waits and the search share it; all clones are the same request.
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
    /// A request that is made automatically after a time. Results then depend on the speed of the machine.
    pub fn after(limit: Duration) -> Self {
        Self { until: Instant::now().checked_add(limit), ..Self::default() }
    }

    /// The same request, made automatically after a time too.
    #[must_use]
    pub fn or_after(&self, limit: Duration) -> Self {
        Self { shared: Arc::clone(&self.shared), until: Instant::now().checked_add(limit) }
    }

    /// Requests that the search end with the best result so far.
    pub fn ask(&self) {
        self.shared.asked.store(true, Ordering::Relaxed);
    }

    /// Whether the search is requested to end.
    pub fn is_asked(&self) -> bool {
        self.shared.asked.load(Ordering::Relaxed)
            || self.until.is_some_and(|until| Instant::now() >= until)
    }

    /// Number of evaluations that the search has made so far, to show progress.
    pub fn evaluations(&self) -> u64 {
        self.shared.evaluations.load(Ordering::Relaxed)
    }

    /// Counts evaluations.
    pub(crate) fn count(&self, evaluations: u64) {
        self.shared.evaluations.fetch_add(evaluations, Ordering::Relaxed);
    }
}
