//! Responses at chosen frequencies.

use num_complex::Complex64;

/// Responses over frequency; frequency runs along the last index.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Responses {
    /// Frequencies \[rad/s\].
    pub omega_rad_s: Vec<f64>,
    /// The masses, counted from 0 at the base.
    pub masses: Vec<usize>,
    /// θ_i/θ_m of each of these masses \[1\].
    pub tips: Vec<Vec<Complex64>>,
    /// C_t/θ_m \[N·m/rad\].
    pub coupling: Vec<Complex64>,
    /// θ_m/i \[rad/A\]; `None` without a drive.
    pub motor: Option<Vec<Complex64>>,
}
