//! Settling of the transient before a log.

/// Settling of the transient before a log.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settled {
    /// Time from the start to the first row of the log \[s\].
    pub waited_s: f64,
    /// Bound on the remaining transient \[rad\]; `None` if it was not determined.
    pub left_rad: Option<f64>,
    /// Tolerance \[rad\]; `None` if the remaining transient was not determined.
    pub tolerance_rad: Option<f64>,
}
