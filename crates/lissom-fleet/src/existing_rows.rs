//! What is done with rows that a folder has already.

use crate::row::Failure;

/// What is done with rows that a folder has already.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum ExistingRows {
    /// The folder must have none.
    Refuse,
    /// They stay: their logs are not done again.
    #[default]
    Keep,
    /// They stay, but for those with these failures, whose logs are done again.
    KeepBut(Vec<Failure>),
}
