//! Noise of the sensors in a run.

use crate::identify::prepare::channel_noise::independent_noise;
use crate::identify::prepare::phases::needed_smoothing;
use crate::record::Run;

/// Standard deviation of what is independent from sample to sample in each channel of a run.
#[derive(Debug, Clone)]
pub(crate) struct RunNoise {
    pub(crate) motor: f64,
    /// That of the command, in its unit.
    pub(crate) command: f64,
    pub(crate) tips: Vec<f64>,
    /// Samples over which the motor's velocity has a sure sign.
    pub(crate) needed_smoothing: usize,
}

impl RunNoise {
    pub(crate) fn of(run: &Run) -> Self {
        let tips = run.tips().iter().map(|tip| independent_noise(tip)).collect();
        let needed_smoothing = needed_smoothing(run.motor());
        let (motor, command) = (independent_noise(run.motor()), independent_noise(run.command()));
        Self { motor, command, tips, needed_smoothing }
    }
}
