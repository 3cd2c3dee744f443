//! Responses at chosen frequencies.

use num_complex::Complex64;
use serde_json::{Value, json};

use super::complex;

/// Responses over frequency; frequency runs along the last index.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Responses {
    /// Frequencies \[rad/s\].
    pub omega_rad_s: Vec<f64>,
    /// Which masses, from 0 at the base.
    pub masses: Vec<usize>,
    /// θ_i/θ_m of each of those \[1\].
    pub tips: Vec<Vec<Complex64>>,
    /// C_t/θ_m \[N·m/rad\].
    pub coupling: Vec<Complex64>,
    /// θ_m/i \[rad/A\]; `None` without a drive.
    pub motor: Option<Vec<Complex64>>,
}

pub(super) fn json(r: &Responses) -> Value {
    json!({
        "omega_rad_s": r.omega_rad_s,
        "to": r.masses.iter().map(|i| format!("theta_{}", i + 1)).collect::<Vec<_>>(),
        "tips": r.tips.iter().map(|tip| complex(tip)).collect::<Vec<_>>(),
        "coupling_nm_per_rad": complex(&r.coupling),
        "motor_rad_per_a": r.motor.as_ref().map(|motor| complex(motor)),
    })
}
