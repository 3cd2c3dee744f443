//! Responses of a campaign at one frequency.

use std::f64::consts::PI;

use crate::identify::responses::correct::Response;
use crate::identify::responses::thresholds::POINT_VOUCHED_FOR;
use crate::identify::thresholds::NORMAL_95;

/// Responses of a campaign at one frequency.
#[derive(Debug, Clone)]
pub struct ResponsePoint {
    /// Frequency \[rad/s\].
    pub omega_rad_s: f64,
    /// Index of the sinusoidal run; `None` for a band of other runs.
    pub run: Option<usize>,
    /// θ_m per unit of command as measured, including friction.
    pub motor_raw: Response,
    /// θ_m per unit of command, corrected for friction; `None` if friction is unknown.
    pub motor_corrected: Option<Response>,
    /// Response of each tip to the motor's angle, in the quantity that the tip measures.
    pub tips: Vec<Option<Response>>,
    /// Whether a finding speaks against the corrected response.
    pub flagged: bool,
    /// Whether the correction takes friction for a square wave, because no arm was found that gives its waveform: the
    /// standard error then leaves out what that assumption does.
    pub square_wave: bool,
}

impl ResponsePoint {
    /// Whether the corrected response is vouched for: no finding speaks against it, the waveform of friction is known,
    /// and its 95 % interval is within 5 % of its value.
    pub fn is_vouched_for(&self) -> bool {
        let known = |r: Response| NORMAL_95 * r.std <= POINT_VOUCHED_FOR * r.value.norm();
        !self.flagged && !self.square_wave && self.motor_corrected.is_some_and(known)
    }
}

/// Relative error of friction's fundamental in (30) where the joint sticks for `share` of the
/// cycle: sticking begins at each reversal and lasts π·share in phase; the square wave is late by
/// half of that.
pub(crate) fn sticking_error(share: f64) -> f64 {
    0.5 * PI * share
}
