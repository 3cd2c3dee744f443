//! Loads on the motor beside friction: gravity of an unbalanced mass.

use crate::record::{Campaign, Hold, Run};

/// The torque `g_s·sin θ + g_c·cos θ` that gravity takes of the motor, θ the motor's angle as logged.
///
/// The motor has to give it in addition: `J·θ̈ + V·θ̇ + friction + g_s·sin θ + g_c·cos θ = K·i`. A mass m at
/// the distance l from the axis has `m·g·l·sin(θ + φ)`, and hangs at rest at θ = −φ.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct GravityLoad {
    /// g_s \[N·m, or the command's unit where the torque constant is unknown\].
    pub sine_nm: f64,
    /// g_c, in the same unit.
    pub cosine_nm: f64,
}

impl GravityLoad {
    /// `mgl·sin(θ + φ)`: the largest torque \[N·m\] and the phase φ \[rad\].
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

    /// The largest torque, `√(g_s² + g_c²)`.
    pub fn amplitude_nm(&self) -> f64 {
        self.sine_nm.hypot(self.cosine_nm)
    }

    /// φ \[rad\], from −π to π: the load hangs at θ = −φ.
    pub fn phase_rad(&self) -> f64 {
        self.cosine_nm.atan2(self.sine_nm)
    }

    /// The torque at an angle.
    pub fn torque_nm(&self, angle_rad: f64) -> f64 {
        let (sin, cos) = angle_rad.sin_cos();
        self.sine_nm * sin + self.cosine_nm * cos
    }

    /// The campaign whose commands are less by this load at the logged angles: what is left moves an arm without it.
    ///
    /// Of a held command the mean torque over each sample is taken.
    #[must_use]
    pub fn taken_from(&self, campaign: &Campaign) -> Campaign {
        let command = &campaign.channels.command;
        let per_unit = command.torque_per_unit();
        let less = |run: &Run| {
            let load: Vec<f64> =
                run.motor().iter().map(|q| self.torque_nm(*q) / per_unit).collect();
            let acting = |k: usize| match command.hold {
                Hold::Measured => load[k],
                Hold::Sampled => 0.5 * (load[k] + load[(k + 1).min(load.len() - 1)]),
            };
            run.with_command(|k, u| u - acting(k))
        };
        Campaign {
            channels: campaign.channels.clone(),
            runs: campaign.runs.iter().map(less).collect(),
            gravity: false,
            mgl_nm: None,
        }
    }
}
