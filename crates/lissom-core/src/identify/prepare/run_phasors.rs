//! Phasors of a sinusoidal run, as the third-harmonic method uses them.

use crate::spectrum::Phasor;

/// Phasors of one run: the command with its hold taken into account, and the motor.
#[derive(Debug, Clone, Copy)]
pub struct RunPhasors {
    /// Drive frequency ω0 \[rad/s\].
    pub omega_rad_s: f64,
    /// Command at ω0, `i_1`.
    pub command_1: Phasor,
    /// Command at 3ω0, `i_3`.
    pub command_3: Phasor,
    /// Motor at ω0.
    pub motor_1: Phasor,
    /// Motor at 3ω0.
    pub motor_3: Phasor,
}
