//! The instrument chain of 6.1: sensors, their noise, converters, amplifier, delay.

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

/// Everything between the controller and the arm.
///
/// At each sample: sensors → controller → D/A converter and limit → log → delay → dead band →
/// motor. With a sensor of the current the log has its readings in place of the command.
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
    /// Sensors of the masses' angles: none is ideal ones, one is alike for all, else one for each.
    pub tips: Vec<Sensor>,
    /// D/A converter, limit and dead band.
    pub amplifier: Amplifier,
    /// Sensor of the motor's current, which the log then has; `None`: the log has the command.
    pub current: Option<CurrentSensor>,
    /// Time stamps of the log that are late; `None`: they are even.
    pub stamps: Option<LateStamps>,
    /// Time from the instant of the sensors to the current's acting; `None`: at once.
    pub delay: Option<Delay>,
    /// The controller acts at one sample in so many, 1 at least.
    pub control_every: usize,
    /// One sample in so many is logged, 1 at least.
    pub log_every: usize,
}

impl Instruments {
    /// Perfect instruments at a sample time \[s\]; change what is not.
    ///
    /// # Errors
    /// [`RigError::NotPositive`].
    pub fn ideal(sample_time_s: f64) -> Result<Self, RigError> {
        Ok(Self {
            sample_time_s: positive("sample_time_s", sample_time_s)?,
            motor: Sensor::IDEAL,
            tips: Vec::new(),
            amplifier: Amplifier::ideal(),
            current: None,
            stamps: None,
            delay: None,
            control_every: 1,
            log_every: 1,
        })
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
