//! A limit of evaluations for a search. It does not depend on the speed of the machine.

use std::sync::atomic::{AtomicU64, Ordering};

use crate::identify::interrupt::Interrupt;

/// Evaluations of a sample whose residual is filtered.
const FILTERED: u64 = 3;

/// Evaluations that a fit has made, the most that it may make, and whether somebody asks it to end.
///
/// One evaluation is one sample of a log replayed, or the derivative of one by one parameter: a replay of n samples with
/// derivatives by p parameters is n·(1 + p) of them, and [`FILTERED`] times as many where its residuals are filtered for noise of
/// the command, which takes so much longer.
#[derive(Debug)]
pub(crate) struct Budget {
    spent: AtomicU64,
    most: u64,
    interrupt: Interrupt,
}

impl Budget {
    pub(crate) fn new(most: u64, interrupt: Interrupt) -> Self {
        Self { spent: AtomicU64::new(0), most, interrupt }
    }

    /// Counts a replay of so many samples with derivatives by so many parameters, filtered or not.
    pub(crate) fn count(&self, samples: usize, parameters: usize, filtered: bool) {
        let each = if filtered { FILTERED } else { 1 };
        let evaluations = each * samples as u64 * (1 + parameters as u64);
        self.spent.fetch_add(evaluations, Ordering::Relaxed);
        self.interrupt.count(evaluations);
    }

    /// Evaluations made so far.
    pub(crate) fn spent(&self) -> u64 {
        self.spent.load(Ordering::Relaxed)
    }

    /// Whether the search is to end with what it has.
    pub(crate) fn is_spent(&self) -> bool {
        self.spent() >= self.most || self.interrupt.is_asked()
    }
}
