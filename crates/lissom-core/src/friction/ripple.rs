//! Friction that changes periodically over the travel.

use super::phase_series::PhaseSeries;
use super::place::Place;
use super::taylor_row::Row;

/// Largest phase that may pass over a step with friction linear in time \[rad\].
const PHASE_PER_STEP: f64 = 0.4;

/// Ripple: friction that changes periodically over the travel, `s·(B_r·cos k_rθ + C_r·sin k_rθ)`, with
/// the direction of motion s = ±1.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Ripple {
    /// k_r \[1/rad, or rad/m on a linear axis\]: waves per turn on a rotary axis.
    #[cfg_attr(feature = "serde", serde(rename = "wave_number"))]
    pub per_rad: f64,
    /// B_r \[N·m\], the cosine part.
    #[cfg_attr(feature = "serde", serde(rename = "cosine"))]
    pub cosine_nm: f64,
    /// C_r \[N·m\], the sine part.
    #[cfg_attr(feature = "serde", serde(rename = "sine"))]
    pub sine_nm: f64,
}

/// A parameter of [`Ripple`] that a search may change.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RippleNumber {
    /// B_r, the cosine part.
    Cosine,
    /// C_r, the sine part.
    Sine,
    /// k_r, waves per turn.
    Rate,
}

impl RippleNumber {
    /// All of them.
    pub(super) const ALL: [Self; 3] = [Self::Cosine, Self::Sine, Self::Rate];

    /// Its name in results, that of ripple number one, two and so on follows.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Cosine => "ripple-cosine",
            Self::Sine => "ripple-sine",
            Self::Rate => "ripple-rate",
        }
    }

    /// Its value.
    pub(super) fn of(self, term: &Ripple) -> f64 {
        match self {
            Self::Cosine => term.cosine_nm,
            Self::Sine => term.sine_nm,
            Self::Rate => term.per_rad,
        }
    }

    /// Its place in the term.
    pub(super) fn in_term(self, term: &mut Ripple) -> &mut f64 {
        match self {
            Self::Cosine => &mut term.cosine_nm,
            Self::Sine => &mut term.sine_nm,
            Self::Rate => &mut term.per_rad,
        }
    }
}

impl Ripple {
    /// Largest torque √(B² + C²) \[N·m\].
    pub fn amplitude_nm(&self) -> f64 {
        self.cosine_nm.hypot(self.sine_nm)
    }

    /// Torque against the motion \[N·m\].
    pub(super) fn braking_nm(&self, at: Place) -> f64 {
        let (sine, cosine) = (self.per_rad * at.angle).sin_cos();
        self.cosine_nm * cosine + self.sine_nm * sine
    }

    /// Derivative of the torque against the motion by the angle.
    pub(super) fn slope(&self, at: Place) -> f64 {
        let (sine, cosine) = (self.per_rad * at.angle).sin_cos();
        self.per_rad * (self.sine_nm * cosine - self.cosine_nm * sine)
    }

    /// Derivative of the torque against the motion by one of its numbers.
    pub(super) fn braking_by(&self, number: RippleNumber, at: Place) -> f64 {
        let (sine, cosine) = (self.per_rad * at.angle).sin_cos();
        match number {
            RippleNumber::Cosine => cosine,
            RippleNumber::Sine => sine,
            RippleNumber::Rate => at.angle * (self.sine_nm * cosine - self.cosine_nm * sine),
        }
    }

    /// Longest step over which it may be taken for linear in time \[s\], for a motor that turns at `turning` at most.
    pub(super) fn step_s(&self, turning: f64) -> f64 {
        PHASE_PER_STEP / (self.per_rad * turning).abs()
    }
}

/// Taylor coefficients along a motion.
#[derive(Debug, Clone, Default)]
pub(super) struct RippleSeries {
    phase: PhaseSeries,
}

impl RippleSeries {
    /// The coefficient of order `k` of the torque against the motion.
    pub(super) fn next(&mut self, law: &Ripple, k: usize, angle: &Row) -> f64 {
        let (sine, cosine) = self.phase.next(law.per_rad, k, angle);
        law.cosine_nm * cosine + law.sine_nm * sine
    }
}
