//! State space models.

use nalgebra::DMatrix;
use num_complex::Complex64;

/// A state space model, `ẋ = A·x + B·u`, `y = C·x + D·u`.
#[derive(Debug, Clone, PartialEq)]
pub struct StateSpace {
    /// A, n × n.
    pub a: DMatrix<f64>,
    /// B, n × inputs.
    pub b: DMatrix<f64>,
    /// C, outputs × n.
    pub c: DMatrix<f64>,
    /// D, outputs × inputs.
    pub d: DMatrix<f64>,
    /// Name of each state, with its unit.
    pub states: Vec<String>,
    /// Name of each input, with its unit.
    pub inputs: Vec<String>,
    /// Name of each output, with its unit.
    pub outputs: Vec<String>,
}

impl StateSpace {
    /// Frequency response `C(jωI − A)⁻¹B + D` at ω \[rad/s\], outputs × inputs; `None` exactly on a pole.
    pub fn response(&self, omega_rad_s: f64) -> Option<DMatrix<Complex64>> {
        let n = self.a.nrows();
        let matrix = DMatrix::from_fn(n, n, |i, j| {
            let s = if i == j { Complex64::new(0.0, omega_rad_s) } else { Complex64::ZERO };
            s - self.a[(i, j)]
        });
        let x = matrix.lu().solve(&self.b.map(Complex64::from))?;
        Some(self.c.map(Complex64::from) * x + self.d.map(Complex64::from))
    }
}
