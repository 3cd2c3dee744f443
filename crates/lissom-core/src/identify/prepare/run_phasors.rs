//! Phasors of a sinusoidal run, as the third-harmonic method uses them.

use crate::spectrum::Phasor;

/// Phasors of one run: the command, with its zero-order hold taken into account, and the motor.
#[derive(Debug, Clone, Copy)]
pub struct RunPhasors {
    /// Drive frequency ω0 \[rad/s\].
    pub omega_rad_s: f64,
    /// Command at ω0, `i_1`, in its own unit.
    pub command_1: Phasor,
    /// Command at 3ω0, `i_3`, in its own unit.
    pub command_3: Phasor,
    /// Motor at ω0 \[rad or m\].
    pub motor_1: Phasor,
    /// Motor at 3ω0 \[rad or m\].
    pub motor_3: Phasor,
}
