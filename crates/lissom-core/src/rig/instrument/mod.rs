//! The instruments of Section 6.1: sensors with noise, converters, amplifier, delay.

mod amplifier;
mod current_sensor;
mod delay;
mod late_stamps;
mod noise;
mod quantiser;
mod sensor;
#[cfg(test)]
mod tests;

pub use amplifier::Amplifier;
pub(super) use current_sensor::CurrentTrace;
pub use current_sensor::{CurrentReading, CurrentSensor};
pub use delay::Delay;
pub(super) use delay::DelayLine;
pub use late_stamps::LateStamps;
pub use noise::Noise;
pub(super) use noise::Streams;
pub use quantiser::Quantiser;
pub use sensor::Sensor;

use super::RigError;
use super::error::positive;

/// The instruments between controller and arm.
///
/// Signals pass in this order at each sample: sensors → controller → D/A converter and limit → log → delay → dead zone
/// → motor. With a current sensor, the log contains its readings instead of the command.
///
/// ```
/// # use lissom::rig::{Amplifier, Instruments, Quantiser, Sensor};
/// let mut instruments = Instruments::ideal(0.003)?; // 3 ms
/// instruments.motor = Sensor::from(Quantiser::new(12, std::f64::consts::TAU)?);
/// instruments.amplifier = Amplifier::ideal().with_limit(4.12)?;
/// assert!(instruments.tips.is_empty()); // ideal
/// # Ok::<(), lissom::rig::RigError>(())
/// ```
///
/// # Source
/// `[Feliu1989, Section 6.1]`
#[derive(Debug, Clone, PartialEq)]
pub struct Instruments {
    /// Sample time T of the sensors \[s\].
    pub sample_time_s: f64,
    /// Sensor of the motor's angle.
    pub motor: Sensor,
    /// Sensors of the angles of the masses: an empty list means ideal sensors, one sensor is used for all masses,
    /// otherwise there is one for each mass.
    pub tips: Vec<Sensor>,
    /// D/A converter, limit and dead zone.
    pub amplifier: Amplifier,
    /// Sensor of the motor's current, whose readings are then logged; `None`: the command is logged.
    pub current: Option<CurrentSensor>,
    /// Late time stamps of the log; `None`: stamps are even.
    pub stamps: Option<LateStamps>,
    /// Time from the instant of the sensors until the current acts; `None`: no delay.
    pub delay: Option<Delay>,
    /// The controller acts at every n-th sample, n ≥ 1.
    pub control_every: usize,
    /// Every n-th sample is logged, n ≥ 1.
    pub log_every: usize,
}

impl Instruments {
    /// Ideal instruments with the given sample time \[s\]; change the fields that are not ideal.
    ///
    /// # Errors
    /// [`RigError::NotPositive`] if the sample time is not positive and finite.
    pub fn ideal(sample_time_s: f64) -> Result<Self, RigError> {
        Ok(Self::unchecked(positive("sample_time_s", sample_time_s)?))
    }

    /// The same, whatever the sample time.
    pub(super) fn unchecked(sample_time_s: f64) -> Self {
        Self {
            sample_time_s,
            motor: Sensor::IDEAL,
            tips: Vec::new(),
            amplifier: Amplifier::ideal(),
            current: None,
            stamps: None,
            delay: None,
            control_every: 1,
            log_every: 1,
        }
    }

    /// The sensor of mass `mass`.
    pub fn tip(&self, mass: usize) -> Sensor {
        match self.tips.as_slice() {
            [] => Sensor::IDEAL,
            [one] => *one,
            all => all.get(mass).copied().unwrap_or(Sensor::IDEAL),
        }
    }

    /// Time between two actions of the controller \[s\].
    pub fn control_time_s(&self) -> f64 {
        self.control_every as f64 * self.sample_time_s
    }

    /// Time between two rows of the log \[s\].
    pub fn log_time_s(&self) -> f64 {
        self.log_every as f64 * self.sample_time_s
    }

    /// Checks what the fields allow.
    pub(super) fn check(&self, masses: usize) -> Result<(), RigError> {
        positive("sample_time_s", self.sample_time_s)?;
        positive("control_every", self.control_every as f64)?;
        positive("log_every", self.log_every as f64)?;
        if let Some(stamps) = self.stamps {
            stamps.check(self.log_time_s())?;
        }
        if self.tips.len() > 1 && self.tips.len() != masses {
            return Err(RigError::SensorCount { found: self.tips.len(), masses });
        }
        Ok(())
    }

    /// The coarsest step or noise of all sensors \[rad\].
    pub(super) fn resolution_rad(&self) -> f64 {
        self.tips.iter().fold(self.motor.resolution(), |m, s| m.max(s.resolution()))
    }
}
