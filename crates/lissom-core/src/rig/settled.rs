//! How the transient before a log went.

/// How the transient before a log went.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settled {
    /// Time that passed before the log \[s\].
    pub waited_s: f64,
    /// What is left of the transient at most \[rad\]; `None` where that was not judged.
    pub left_rad: Option<f64>,
    /// What was allowed \[rad\]; `None` where that was not judged.
    pub tolerance_rad: Option<f64>,
}
