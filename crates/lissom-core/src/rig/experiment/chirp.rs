//! A sine whose frequency changes.

use crate::rig::RigError;
use crate::rig::error::positive;

/// How the frequency of a [`Chirp`] changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sweep {
    /// Linearly in time.
    Linear,
    /// Exponentially in time: by the same factor each second.
    Logarithmic,
}

/// A chirp, `A·sin φ(t)`: the frequency dφ/dt goes from ω_a to ω_b \[rad/s\] within the duration
/// D \[s\] and then stays at ω_b.
///
/// Linear: `φ = ω_a·t + (ω_b − ω_a)·t²/(2·D)`. Logarithmic, with `r = ω_b/ω_a`: `φ = ω_a·D/ln r·(r^(t/D) − 1)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Chirp {
    sweep: Sweep,
    from_rad_s: f64,
    to_rad_s: f64,
    amplitude: f64,
    duration_s: f64,
}

impl Chirp {
    /// Builds a chirp from the frequencies ω_a and ω_b \[rad/s\] (either may be the higher), the amplitude \[rad or A\]
    /// and the duration D \[s\].
    ///
    /// # Errors
    /// [`RigError::NotPositive`] if one of them is not positive and finite.
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

    /// Amplitude A \[rad or A\].
    pub fn amplitude(&self) -> f64 {
        self.amplitude
    }

    /// How the frequency changes.
    pub fn sweep(&self) -> Sweep {
        self.sweep
    }

    /// First and last frequency, ω_a and ω_b \[rad/s\].
    pub fn ends_rad_s(&self) -> (f64, f64) {
        (self.from_rad_s, self.to_rad_s)
    }

    /// Duration D \[s\].
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

    /// Value at a time \[s\], in rad or A.
    pub fn value(&self, time_s: f64) -> f64 {
        self.amplitude * self.phase_rad(time_s).sin()
    }
}
