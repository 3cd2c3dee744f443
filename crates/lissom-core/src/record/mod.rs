//! Runs and campaigns in memory: uniformly sampled signals in SI units, with what is known of
//! each channel (quantity, hold, calibration).

mod channel;
pub mod clock;
mod error;
mod note;
mod run;

pub use channel::{Axis, Channels, Command, CommandQuantity, Hold, Tip, TipQuantity};
pub use error::RecordError;
pub use note::Note;
pub use run::{Run, TimeBase};

/// Several runs of one machine, all with the same channels.
#[derive(Debug, Clone)]
pub struct Campaign {
    /// What each channel is.
    pub channels: Channels,
    /// The runs, in the order in which they were given. Sample times may differ between runs.
    pub runs: Vec<Run>,
    /// Whether a load with gravity acts on the motor, `g_s·sin θ + g_c·cos θ`, to be identified.
    pub gravity: bool,
    /// Largest torque m·g·l of that load, where it is known \[N·m\]: it gives the torque constant.
    pub mgl_nm: Option<f64>,
}

impl AsRef<Self> for Campaign {
    fn as_ref(&self) -> &Self {
        self
    }
}

impl Campaign {
    /// Checks that every run has the channels it should have.
    ///
    /// # Errors
    /// [`RecordError::NoRuns`] without runs, [`RecordError::TipCount`] where a run has another
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
        Ok(Self { channels, runs, gravity: false, mgl_nm: None })
    }

    /// The same with a load of gravity `g_s·sin θ + g_c·cos θ` on the motor, θ the motor's angle, to be identified.
    ///
    /// # Errors
    /// [`RecordError::Gravity`] on linear axes, and with tips: a beam's angles would need a load each.
    pub fn with_gravity(mut self) -> Result<Self, RecordError> {
        if self.channels.axis == Axis::Linear || !self.channels.tips.is_empty() {
            return Err(RecordError::Gravity { linear: self.channels.axis == Axis::Linear });
        }
        self.gravity = true;
        Ok(self)
    }

    /// The same, that load's largest torque m·g·l being known \[N·m\].
    ///
    /// # Errors
    /// As [`Self::with_gravity`], and [`RecordError::Mgl`] unless it is positive and finite.
    pub fn with_known_gravity(self, mgl_nm: f64) -> Result<Self, RecordError> {
        if !(mgl_nm > 0.0 && mgl_nm.is_finite()) {
            return Err(RecordError::Mgl { found_nm: mgl_nm });
        }
        Ok(Self { mgl_nm: Some(mgl_nm), ..self.with_gravity()? })
    }
}
