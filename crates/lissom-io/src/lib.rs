//! Reads measured logs and campaign descriptions; writes logs, models and results.

pub mod log;
mod nearest;
pub mod units;
