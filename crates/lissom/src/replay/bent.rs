//! Deflection of the replayed bristles, with derivatives.

use super::lanes::Lanes;
use super::tangents::Answers;

/// Deflection of a replay's bristles, with its derivatives by every unknown.
#[derive(Debug, Clone, Default)]
pub(super) struct Bent {
    pub(super) z: f64,
    pub(super) by: Vec<Lanes>,
    /// Room for what a step asks of the law's own numbers.
    pub(super) own: Vec<Answers>,
}
