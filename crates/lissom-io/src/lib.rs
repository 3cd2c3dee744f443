//! Reads measured logs and campaign descriptions; writes logs, models and results.

mod nearest;
pub mod units;
