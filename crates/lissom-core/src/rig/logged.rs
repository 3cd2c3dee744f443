//! Result of a simulated run.

use super::finding::RigFinding;
use super::settled::Settled;
use crate::record::Run;

/// A simulated run, and what the simulator knows about it.
#[derive(Debug, Clone)]
pub struct Logged {
    /// The log: current (commanded, or as its sensor reads it) and angles of motor and
    /// masses as their sensors read them.
    ///
    /// A commanded current of row k acts from the instant at which the angles of row k are read, or later by the delay.
    /// Times of the log are those of the reference, so that a periodic reference keeps its phase.
    pub run: Run,
    /// Time stamps of the log \[s\] if they are late. The rows of [`run`](Self::run) were taken evenly.
    pub stamps_s: Option<Vec<f64>>,
    /// Settling of the transient before the log.
    pub settled: Settled,
    /// True state at the first row of the log, `[θ_m, θ̇_m, q_1.., q̇_1..]` of [`Arm`](crate::arm::Arm) \[rad, rad/s\].
    pub start: Vec<f64>,
    /// Share of the record in which the joint stuck \[1\].
    pub stuck_share: f64,
    /// Findings about the run.
    pub findings: Vec<RigFinding>,
}

/// The true values at one row of a log.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RowTruth<'s> {
    /// State `[θ_m, θ̇_m, θ_1.., θ̇_1..]` of [`Arm`](crate::arm::Arm) \[rad, rad/s\].
    pub state: &'s [f64],
    /// Factor of the dry friction from this instant to the next sample \[1\].
    pub friction_factor: f64,
}
