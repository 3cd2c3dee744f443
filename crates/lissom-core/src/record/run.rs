//! One run: uniformly sampled channels.

use super::RecordError;
use crate::finding::Finding;

/// Fewest samples a run may have.
const LEAST_SAMPLES: usize = 8;

/// Start and sample time of a run, and how far the stamps of its log were from even.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeBase {
    /// Time of the first sample \[s\].
    pub start_s: f64,
    /// Sample time \[s\].
    pub sample_time_s: f64,
    /// Largest difference between a step of the stamps and the sample time \[s\]; 0 if the motion shows when the
    /// samples were taken.
    pub jitter_max_s: f64,
    /// Root mean square of that difference \[s\].
    pub jitter_rms_s: f64,
}

impl TimeBase {
    /// A time base without jitter.
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
    notes: Vec<Finding>,
}

impl Run {
    /// Builds a run from its channels. All must have the same length, at least eight samples, and finite values.
    ///
    /// `command` is in its own unit, `motor` in rad or m; the unit of `tips` follows from their
    /// [`TipQuantity`](super::TipQuantity).
    ///
    /// # Errors
    /// [`RecordError::SampleTime`], [`RecordError::TooShort`], [`RecordError::Length`] or [`RecordError::NotFinite`].
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

    /// Sets the frequency at which the run was driven \[rad/s\].
    ///
    /// # Errors
    /// [`RecordError::Omega`] unless it is between 0 and the Nyquist frequency.
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

    /// Adds a note about a change that was made to the log, for example that it was cut at a gap.
    #[must_use]
    pub fn with_note(mut self, note: impl Into<Finding>) -> Self {
        self.notes.push(note.into());
        self
    }

    /// The run with another command: `of` gives that of each sample from its index and what was logged.
    #[must_use]
    pub(crate) fn with_command(&self, of: impl Fn(usize, f64) -> f64) -> Self {
        let command = self.command.iter().enumerate().map(|(k, u)| of(k, *u)).collect();
        Self { command, ..self.clone() }
    }

    /// The same run with readings of a tip that were taken so much earlier than they are logged.
    pub(crate) fn with_tip_taken_earlier(mut self, tip: usize, by_s: f64) -> Self {
        self.tips[tip] = shifted(&self.tips[tip], -by_s / self.time.sample_time_s);
        self
    }

    /// Name in results and messages.
    pub fn name(&self) -> &str {
        &self.name
    }
    /// Start, sample time and jitter.
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
    /// Logged command, in its own unit.
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
    /// Frequency at which the run was driven \[rad/s\], if it was given.
    pub fn omega_rad_s(&self) -> Option<f64> {
        self.omega_rad_s
    }
    /// Notes about changes that were made to the log.
    pub fn notes(&self) -> &[Finding] {
        &self.notes
    }
}

/// The values of so many samples before, straight between samples.
pub(crate) fn shifted(values: &[f64], samples: f64) -> Vec<f64> {
    let last = (values.len() - 1) as f64;
    let at = |k: usize| {
        let place = (k as f64 - samples).clamp(0.0, last);
        let before = place as usize;
        let share = place - before as f64;
        let after = (before + 1).min(values.len() - 1);
        values[before] + share * (values[after] - values[before])
    };
    (0..values.len()).map(at).collect()
}
