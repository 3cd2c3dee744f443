//! Torque ripple of a motor (cogging).

/// Torque ripple (cogging): a torque of position, `B·cos kθ + C·sin kθ`, with the motor's angle θ as logged.
///
/// It is on the same side of the equation as friction and gravity, so the motor has to supply it:
/// `J·θ̈ + V·θ̇ + friction + B·cos kθ + C·sin kθ = K·i`. Unlike a [ripple of friction](crate::replay::Ripple) it does not
/// depend on the direction of motion, and it acts at rest, too.
///
/// ```
/// use lissom::load::TorqueRipple;
/// let cogging = TorqueRipple { per_rad: 6.0, cosine_nm: 0.0, sine_nm: 0.02 };
/// assert!(cogging.torque_nm(0.0).abs() < 1e-15); // it rests here
/// assert!(cogging.torque_nm(0.1) > 0.0); // and is pulled back to it
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TorqueRipple {
    /// k \[1/rad, or rad/m on a linear axis\]: waves per turn on a rotary axis.
    #[cfg_attr(feature = "serde", serde(rename = "wave_number"))]
    pub per_rad: f64,
    /// B \[N·m; unit of the command where the torque constant is unknown\].
    #[cfg_attr(feature = "serde", serde(rename = "cosine"))]
    pub cosine_nm: f64,
    /// C, in the unit of B.
    #[cfg_attr(feature = "serde", serde(rename = "sine"))]
    pub sine_nm: f64,
}

impl TorqueRipple {
    /// Builds the ripple `A·cos(kθ + φ)` from its largest torque A \[N·m\], k \[1/rad\] and φ \[rad\].
    pub fn of_amplitude(torque_nm: f64, per_rad: f64, phase_rad: f64) -> Self {
        let (sin, cos) = phase_rad.sin_cos();
        Self { per_rad, cosine_nm: torque_nm * cos, sine_nm: -torque_nm * sin }
    }

    /// Largest torque √(B² + C²), in the unit of B.
    pub fn amplitude_nm(&self) -> f64 {
        self.cosine_nm.hypot(self.sine_nm)
    }

    /// Phase φ of `A·cos(kθ + φ)` \[rad\], from −π to π.
    pub fn phase_rad(&self) -> f64 {
        (-self.sine_nm).atan2(self.cosine_nm)
    }

    /// Torque at an angle of the motor, in the unit of B; positive if the motor has to push forward.
    pub fn torque_nm(&self, angle_rad: f64) -> f64 {
        let (sin, cos) = (self.per_rad * angle_rad).sin_cos();
        self.sine_nm * sin + self.cosine_nm * cos
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn amplitude_and_phase_give_the_wave() {
        let ripple = TorqueRipple::of_amplitude(0.3, 6.0, 0.4);
        assert!((ripple.amplitude_nm() - 0.3).abs() < 1e-15);
        assert!((ripple.phase_rad() - 0.4).abs() < 1e-15);
        assert!((ripple.torque_nm(1.2) - 0.3 * (6.0_f64 * 1.2 + 0.4).cos()).abs() < 1e-15);
    }
}
