//! Taylor coefficients of the sine and cosine of an angle along a motion.

use super::taylor_row::Row;

/// Coefficients of `s = sin kθ` and `c = cos kθ`, one after the other:
/// `n·s_n = Σ j·k·θ_j·c_{n−j}`, `n·c_n = −Σ j·k·θ_j·s_{n−j}`.
#[derive(Debug, Clone, Default)]
pub(crate) struct PhaseSeries {
    sine: Row,
    cosine: Row,
}

impl PhaseSeries {
    /// Sine and cosine of order `order`, from the angle's coefficients up to that order; `per_rad` is k.
    pub(crate) fn next(&mut self, per_rad: f64, order: usize, angle: &Row) -> (f64, f64) {
        if order == 0 {
            (self.sine[0], self.cosine[0]) = (per_rad * angle[0]).sin_cos();
        } else {
            let (mut sine, mut cosine) = (0.0, 0.0);
            for (j, turned) in angle[..=order].iter().enumerate() {
                let rate = j as f64 * per_rad * turned;
                sine += rate * self.cosine[order - j];
                cosine -= rate * self.sine[order - j];
            }
            self.sine[order] = sine / order as f64;
            self.cosine[order] = cosine / order as f64;
        }
        (self.sine[order], self.cosine[order])
    }
}
