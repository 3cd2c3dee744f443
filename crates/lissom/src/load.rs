//! Loads on the motor beside friction: gravity of an unbalanced mass.

use crate::record::{Campaign, Hold, Run};

/// The torque `g_s·sin θ + g_c·cos θ` that gravity takes of the motor, θ the motor's angle as logged.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct GravityLoad {
    /// g_s \[N·m, or the command's unit where the torque constant is unknown\].
    pub sine_nm: f64,
    /// g_c, in the same unit.
    pub cosine_nm: f64,
}

impl GravityLoad {
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
