//! A sine whose frequency moves.

use crate::rig::RigError;
use crate::rig::error::positive;

/// How the frequency of a [`Chirp`] moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sweep {
    /// By the same difference each second.
    Linear,
    /// By the same factor each second.
    Logarithmic,
}

/// `A·sin φ(t)` with `dφ/dt` from ω_a to ω_b within D; ω_b from then on.
///
/// Linear: `φ = ω_a·t + (ω_b − ω_a)·t²/(2·D)`. Logarithmic, `r = ω_b/ω_a`:
/// `φ = ω_a·D/ln r·(r^(t/D) − 1)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Chirp {
    sweep: Sweep,
    from_rad_s: f64,
    to_rad_s: f64,
    amplitude: f64,
    duration_s: f64,
}

impl Chirp {
    /// Frequencies ω_a and ω_b \[rad/s\] (either may be the higher), amplitude \[rad or A\],
    /// duration D \[s\].
    ///
    /// # Errors
    /// [`RigError::NotPositive`].
    pub fn new(
        sweep: Sweep,
        (from_rad_s, to_rad_s): (f64, f64),
        amplitude: f64,
        duration_s: f64,
    ) -> Result<Self, RigError> {
        Ok(Self {
            sweep,
            from_rad_s: positive("from_rad_s", from_rad_s)?,
            to_rad_s: positive("to_rad_s", to_rad_s)?,
            amplitude: positive("amplitude", amplitude)?,
            duration_s: positive("duration_s", duration_s)?,
        })
    }

    /// A.
    pub fn amplitude(&self) -> f64 {
        self.amplitude
    }

    /// How the frequency moves.
    pub fn sweep(&self) -> Sweep {
        self.sweep
    }

    /// ω_a and ω_b \[rad/s\].
    pub fn ends_rad_s(&self) -> (f64, f64) {
        (self.from_rad_s, self.to_rad_s)
    }

    /// D \[s\].
    pub fn duration_s(&self) -> f64 {
        self.duration_s
    }

    /// The higher of both frequencies \[rad/s\].
    pub fn highest_rad_s(&self) -> f64 {
        self.from_rad_s.max(self.to_rad_s)
    }

    /// Phase φ at a time \[rad\].
    pub fn phase_rad(&self, time_s: f64) -> f64 {
        let (a, b, d) = (self.from_rad_s, self.to_rad_s, self.duration_s);
        let t = time_s.min(d);
        let swept = match self.sweep {
            Sweep::Linear => a * t + (b - a) * t * t / (2.0 * d),
            Sweep::Logarithmic => {
                let rate = (b / a).ln();
                // (r^(t/D) − 1)/ln r tends to t/D at r = 1.
                let grown = if rate == 0.0 { t / d } else { (rate * t / d).exp_m1() / rate };
                a * d * grown
            }
        };
        swept + b * (time_s - t)
    }

    /// Value at a time \[s\].
    pub fn value(&self, time_s: f64) -> f64 {
        self.amplitude * self.phase_rad(time_s).sin()
    }
}
