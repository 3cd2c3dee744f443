//! Runs and campaigns in memory: uniformly sampled signals in SI units, with the quantity, hold
//! and calibration of each channel.

mod channel;
pub mod clock;
mod error;
pub(crate) mod extent;
pub mod note;
pub mod other_clock;
mod rest_readings;
mod run;
pub(crate) mod spikes;
mod undriven;

pub use channel::{Axis, Channels, Command, CommandQuantity, Hold, Tip, TipQuantity};
pub use error::RecordError;
pub use rest_readings::{RestingReadings, rest_at_zero};
pub(crate) use run::shifted;
pub use run::{Run, TimeBase};
pub use spikes::{ReplacedReading, replace_spikes};
pub use undriven::undriven;

/// Several runs of one machine, all with the same channels.
#[derive(Debug, Clone)]
pub struct Campaign {
    /// Description of each channel.
    pub channels: Channels,
    /// The runs, in the order given. Sample times may differ between runs.
    pub runs: Vec<Run>,
    /// Whether gravity of an unbalanced load, `g_s·sin θ + g_c·cos θ`, acts on the motor and is to be identified.
    pub gravity: bool,
    /// Largest torque m·g·l of that load \[N·m\], if it is known; it determines the torque constant.
    pub mgl_nm: Option<f64>,
    /// Whether [`Command::hold`](Command) is assumed: what it changes is then reported.
    pub hold_assumed: bool,
}

impl AsRef<Self> for Campaign {
    fn as_ref(&self) -> &Self {
        self
    }
}

impl Campaign {
    /// Joins runs to a campaign.
    ///
    /// # Errors
    /// [`RecordError::NoRuns`] without runs; [`RecordError::TipCount`] if a run has a different
    /// number of tips than `channels`.
    pub fn new(channels: Channels, runs: Vec<Run>) -> Result<Self, RecordError> {
        if runs.is_empty() {
            return Err(RecordError::NoRuns);
        }
        for run in &runs {
            if run.tips().len() != channels.tips.len() {
                return Err(RecordError::TipCount {
                    run: run.name().to_owned(),
                    expected: channels.tips.len(),
                    found: run.tips().len(),
                });
            }
        }
        Ok(Self { channels, runs, gravity: false, mgl_nm: None, hold_assumed: false })
    }

    /// Returns this campaign with gravity of an unbalanced load, `g_s·sin θ + g_c·cos θ` on the motor at its angle θ,
    /// which is to be identified.
    ///
    /// # Errors
    /// [`RecordError::Gravity`] on a linear axis, and with tips, because each point of the
    /// beam would need a load of its own.
    pub fn with_gravity(mut self) -> Result<Self, RecordError> {
        if self.channels.axis == Axis::Linear || !self.channels.tips.is_empty() {
            return Err(RecordError::Gravity { linear: self.channels.axis == Axis::Linear });
        }
        self.gravity = true;
        Ok(self)
    }

    /// Returns this campaign with gravity of a load whose largest torque m·g·l is known \[N·m\].
    ///
    /// # Errors
    /// Those of [`Self::with_gravity`], and [`RecordError::Mgl`] unless the torque is positive and finite.
    pub fn with_known_gravity(self, mgl_nm: f64) -> Result<Self, RecordError> {
        if !(mgl_nm > 0.0 && mgl_nm.is_finite()) {
            return Err(RecordError::Mgl { found_nm: mgl_nm });
        }
        Ok(Self { mgl_nm: Some(mgl_nm), ..self.with_gravity()? })
    }
}
