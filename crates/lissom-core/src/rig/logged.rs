//! What a virtual run gives.

use super::finding::RigFinding;
use super::settled::Settled;
use crate::record::Run;

/// A simulated run, and what is known of it.
#[derive(Debug, Clone)]
pub struct Logged {
    /// The log: commanded current, or the current as its sensor reads it, and the angles of motor and masses as
    /// their sensors give them.
    ///
    /// Row k of a commanded current acts from the instant of row k of the angles on, or as much later as
    /// the delay says. The log's time begins when the log does on the clock of the reference, so that a
    /// periodic one keeps its phase.
    pub run: Run,
    /// The log's time stamps \[s\], where they are late: the rows of [`run`](Self::run) were taken evenly.
    pub stamps_s: Option<Vec<f64>>,
    /// How the transient went.
    pub settled: Settled,
    /// The true state at the log's first row, `[θ_m, θ̇_m, q_1.., q̇_1..]` of [`Arm`](crate::arm::Arm).
    pub start: Vec<f64>,
    /// Part of the record in which the joint stuck \[1\].
    pub stuck_share: f64,
    /// What a user should know.
    pub findings: Vec<RigFinding>,
}

/// What is true at a row of a log.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RowTruth<'s> {
    /// State `[θ_m, θ̇_m, θ_1.., θ̇_1..]` of [`Arm`](crate::arm::Arm) \[rad, rad/s\].
    pub state: &'s [f64],
    /// What multiplies the dry friction from this instant on, to the next sample \[1\].
    pub friction_factor: f64,
}
