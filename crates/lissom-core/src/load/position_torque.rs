//! All torques on a motor that depend on its angle only.

use super::{GravityLoad, TorqueRipple};
use crate::record::{Campaign, Hold, Run};

/// All torques on a motor that depend on its angle only: gravity, as a wave with one period per turn, and torque ripples.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PositionTorque(Vec<TorqueRipple>);

impl PositionTorque {
    /// Builds it from gravity and torque ripples.
    ///
    /// ```
    /// use lissom::load::{GravityLoad, PositionTorque, TorqueRipple};
    /// let cogging = TorqueRipple { per_rad: 6.0, cosine_nm: 0.1, sine_nm: 0.0 };
    /// let whole = PositionTorque::new(Some(GravityLoad::of_amplitude(2.0, 0.0)), &[cogging]);
    /// assert!((whole.torque_nm(0.0) - 0.1).abs() < 1e-15);
    /// ```
    pub fn new(gravity: Option<GravityLoad>, ripples: &[TorqueRipple]) -> Self {
        let wave = |g: GravityLoad| TorqueRipple {
            per_rad: 1.0,
            cosine_nm: g.cosine_nm,
            sine_nm: g.sine_nm,
        };
        Self(gravity.map(wave).into_iter().chain(ripples.iter().copied()).collect())
    }

    /// Whether there is neither gravity nor a ripple.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Torque at an angle of the motor \[N·m\]; positive if the motor has to push forward.
    pub fn torque_nm(&self, angle_rad: f64) -> f64 {
        self.0.iter().map(|wave| wave.torque_nm(angle_rad)).sum()
    }

    /// A bound on its size, the sum of the amplitudes \[N·m\].
    pub fn largest_nm(&self) -> f64 {
        self.0.iter().map(TorqueRipple::amplitude_nm).sum()
    }

    /// A bound on its change with the angle \[N·m/rad\].
    pub(crate) fn stiffness_nm_per_rad(&self) -> f64 {
        self.0.iter().map(|wave| wave.per_rad.abs() * wave.amplitude_nm()).sum()
    }

    /// Its waves.
    pub(crate) fn waves(&self) -> &[TorqueRipple] {
        &self.0
    }

    /// Returns the campaign with this torque at the logged angles subtracted from the commands: the remaining command
    /// moves an arm without it.
    ///
    /// For a sampled (held) command, the mean of the torque at both ends of the sample is subtracted.
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
            hold_assumed: campaign.hold_assumed,
        }
    }
}
