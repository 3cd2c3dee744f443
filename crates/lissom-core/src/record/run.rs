//! One run: uniformly sampled channels.

use super::{Note, RecordError};

/// Fewest samples a run may have.
const LEAST_SAMPLES: usize = 8;

/// How the stamps of a log lie about a uniform grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeBase {
    /// Time of the first sample \[s\].
    pub start_s: f64,
    /// Sample time \[s\].
    pub sample_time_s: f64,
    /// Largest distance of a step between stamps from the sample time \[s\]; 0 where the motion shows when the samples
    /// were taken.
    pub jitter_max_s: f64,
    /// Root mean square of that distance \[s\].
    pub jitter_rms_s: f64,
}

impl TimeBase {
    /// A perfectly uniform time base.
    pub fn uniform(start_s: f64, sample_time_s: f64) -> Self {
        Self { start_s, sample_time_s, jitter_max_s: 0.0, jitter_rms_s: 0.0 }
    }
}

/// One uniformly sampled run.
#[derive(Debug, Clone)]
pub struct Run {
    name: String,
    time: TimeBase,
    command: Vec<f64>,
    motor: Vec<f64>,
    tips: Vec<Vec<f64>>,
    omega_rad_s: Option<f64>,
    notes: Vec<Note>,
}

impl Run {
    /// Takes the channels of one run; all must have one length and hold finite numbers.
    ///
    /// `command` in its own unit, `motor` in rad or m, `tips` as their
    /// [`TipQuantity`](super::TipQuantity) says.
    ///
    /// # Errors
    /// [`RecordError::SampleTime`], [`RecordError::TooShort`], [`RecordError::Length`],
    /// [`RecordError::NotFinite`].
    pub fn new(
        name: impl Into<String>,
        time: TimeBase,
        command: Vec<f64>,
        motor: Vec<f64>,
        tips: Vec<Vec<f64>>,
    ) -> Result<Self, RecordError> {
        let name = name.into();
        if !(time.sample_time_s > 0.0 && time.sample_time_s.is_finite()) {
            return Err(RecordError::SampleTime { run: name, found_s: time.sample_time_s });
        }
        if motor.len() < LEAST_SAMPLES {
            return Err(RecordError::TooShort {
                run: name,
                found: motor.len(),
                least: LEAST_SAMPLES,
            });
        }
        let tip_names: Vec<String> = (1..=tips.len()).map(|i| format!("tip {i}")).collect();
        let channels = [("command", &command), ("motor", &motor)]
            .into_iter()
            .chain(tip_names.iter().map(String::as_str).zip(&tips));
        for (channel, samples) in channels {
            if samples.len() != motor.len() {
                return Err(RecordError::Length {
                    run: name,
                    channel: channel.to_owned(),
                    expected: motor.len(),
                    found: samples.len(),
                });
            }
            if let Some(sample) = samples.iter().position(|v| !v.is_finite()) {
                return Err(RecordError::NotFinite {
                    run: name,
                    channel: channel.to_owned(),
                    sample,
                });
            }
        }
        Ok(Self { name, time, command, motor, tips, omega_rad_s: None, notes: Vec::new() })
    }

    /// States the frequency at which the run was driven.
    ///
    /// # Errors
    /// [`RecordError::Omega`] unless it lies between 0 and the Nyquist frequency.
    pub fn with_omega(mut self, omega_rad_s: f64) -> Result<Self, RecordError> {
        let nyquist_rad_s = std::f64::consts::PI / self.time.sample_time_s;
        if !(omega_rad_s > 0.0 && omega_rad_s < nyquist_rad_s) {
            return Err(RecordError::Omega {
                run: self.name,
                found_rad_s: omega_rad_s,
                nyquist_rad_s,
            });
        }
        self.omega_rad_s = Some(omega_rad_s);
        Ok(self)
    }

    /// Adds what the reader did to the log and a user should know (a gap cut, rows merged).
    #[must_use]
    pub fn with_note(mut self, note: Note) -> Self {
        self.notes.push(note);
        self
    }

    /// The run with another command: `of` gives that of each sample from its index and what was logged.
    #[must_use]
    pub(crate) fn with_command(&self, of: impl Fn(usize, f64) -> f64) -> Self {
        let command = self.command.iter().enumerate().map(|(k, u)| of(k, *u)).collect();
        Self { command, ..self.clone() }
    }

    /// Name, as reports give it.
    pub fn name(&self) -> &str {
        &self.name
    }
    /// Time base.
    pub fn time(&self) -> TimeBase {
        self.time
    }
    /// Sample time \[s\].
    pub fn sample_time_s(&self) -> f64 {
        self.time.sample_time_s
    }
    /// Number of samples.
    pub fn len(&self) -> usize {
        self.motor.len()
    }
    /// Never true: a run has samples.
    pub fn is_empty(&self) -> bool {
        self.motor.is_empty()
    }
    /// Logged command.
    pub fn command(&self) -> &[f64] {
        &self.command
    }
    /// Motor angle \[rad\] or position \[m\].
    pub fn motor(&self) -> &[f64] {
        &self.motor
    }
    /// Tip channels, each as long as the motor's.
    pub fn tips(&self) -> &[Vec<f64>] {
        &self.tips
    }
    /// Stated drive frequency \[rad/s\].
    pub fn omega_rad_s(&self) -> Option<f64> {
        self.omega_rad_s
    }
    /// What the reader did to the log.
    pub fn notes(&self) -> &[Note] {
        &self.notes
    }
}
