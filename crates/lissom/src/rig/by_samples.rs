//! An arm that moves by the durations a loop has.

use super::{HeldStep, Hybrid, Motion, RigError};
use crate::arm::Arm;

/// [`Hybrid`] with a [`HeldStep`] for each duration that comes again and again.
#[derive(Debug, Clone)]
pub(super) struct BySamples<'a> {
    hybrid: Hybrid<'a>,
    steps: Vec<HeldStep>,
}

impl<'a> BySamples<'a> {
    /// From `state`; durations of zero need no step.
    pub(super) fn new(arm: &'a Arm, state: Vec<f64>, durations_s: &[f64]) -> Self {
        let steps = durations_s.iter().filter(|d| **d > 0.0).map(|d| HeldStep::new(arm, *d));
        Self { hybrid: Hybrid::with_state(arm, state), steps: steps.collect() }
    }
}

impl Motion for BySamples<'_> {
    fn state(&self) -> &[f64] {
        self.hybrid.state()
    }

    #[expect(clippy::float_cmp, reason = "a step is for one duration, to the bit")]
    fn advance(&mut self, torque_nm: f64, duration_s: f64) -> Result<(), RigError> {
        match self.steps.iter().find(|s| s.sample_time_s() == duration_s) {
            Some(step) => self.hybrid.advance_held(step, torque_nm),
            None => self.hybrid.advance(torque_nm, duration_s),
        }
        Ok(())
    }

    fn stuck_s(&self) -> f64 {
        self.hybrid.stuck_s()
    }

    fn tolerance(&self) -> Option<f64> {
        None
    }
}
