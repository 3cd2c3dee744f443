//! Gravity of an unbalanced mass.

use super::PositionTorque;
use crate::record::Campaign;

/// The torque of gravity on the motor, `g_s·sin θ + g_c·cos θ`, with the motor's angle θ as logged.
///
/// It is on the same side of the equation as friction, so the motor has to supply it:
/// `J·θ̈ + V·θ̇ + friction + g_s·sin θ + g_c·cos θ = K·i`. A mass m at the distance l from the axis gives
/// `m·g·l·sin(θ + φ)` and hangs at rest at θ = −φ.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct GravityLoad {
    /// g_s \[N·m; unit of the command where the torque constant is unknown\].
    #[cfg_attr(feature = "serde", serde(rename = "sine"))]
    pub sine_nm: f64,
    /// g_c, in the unit of g_s.
    #[cfg_attr(feature = "serde", serde(rename = "cosine"))]
    pub cosine_nm: f64,
}

impl GravityLoad {
    /// Builds the load from its largest torque m·g·l \[N·m\] and its phase φ \[rad\]: `m·g·l·sin(θ + φ)`.
    ///
    /// ```
    /// use lissom::load::GravityLoad;
    /// let load = GravityLoad::of_amplitude(2.0, std::f64::consts::FRAC_PI_2); // horizontal at θ = 0
    /// assert!((load.torque_nm(0.0) - 2.0).abs() < 1e-15 && load.sine_nm.abs() < 1e-15);
    /// ```
    pub fn of_amplitude(mgl_nm: f64, phase_rad: f64) -> Self {
        let (sin, cos) = phase_rad.sin_cos();
        Self { sine_nm: mgl_nm * cos, cosine_nm: mgl_nm * sin }
    }

    /// Largest torque m·g·l = `√(g_s² + g_c²)`, in the unit of g_s.
    pub fn amplitude_nm(&self) -> f64 {
        self.sine_nm.hypot(self.cosine_nm)
    }

    /// Phase φ \[rad\], from −π to π: the load hangs at θ = −φ.
    pub fn phase_rad(&self) -> f64 {
        self.cosine_nm.atan2(self.sine_nm)
    }

    /// Torque at an angle of the motor, in the unit of g_s; positive if the motor has to push forward.
    pub fn torque_nm(&self, angle_rad: f64) -> f64 {
        let (sin, cos) = angle_rad.sin_cos();
        self.sine_nm * sin + self.cosine_nm * cos
    }

    /// Returns the campaign with the torque of this load at the logged angles subtracted from the commands: the
    /// remaining command moves an arm without the load.
    ///
    /// For a sampled (held) command, the mean of the load at both ends of the sample is subtracted.
    #[must_use]
    pub fn taken_from(&self, campaign: &Campaign) -> Campaign {
        PositionTorque::new(Some(*self), &[]).taken_from(campaign)
    }
}
