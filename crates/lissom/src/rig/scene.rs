//! What an arm is set in: the joint's friction, the world at the tip, payloads to come.

use super::by_samples::BySamples;
use super::{Hybrid, Motion, RigError, TipWorld};
use crate::arm::Arm;
use crate::drive::DryFriction;

/// What of a rig's physics is not in its [`Arm`]. The default is nothing: Coulomb friction as the
/// arm has it, a free tip.
///
/// ```
/// use lissom::rig::{Scene, TipWorld};
/// let air_table = TipWorld { viscous_n_s_per_m: 0.003, ..TipWorld::default() };
/// let scene = Scene { tip: air_table, ..Scene::default() };
/// assert!(scene.check().is_ok());
/// ```
///
/// # Source
/// `[Feliu1989, Sections 2.2, 6.1, 6.2.1]`
#[derive(Debug, Clone, Default)]
pub struct Scene {
    /// The joint's dry friction; `None`: the arm's Coulomb friction.
    pub friction: Option<DryFriction>,
    /// The world at the tip.
    pub tip: TipWorld,
    /// Arms that take over at times \[s\], counted from the start: another payload.
    pub later: Vec<(f64, Arm)>,
}

impl Scene {
    /// Checks the numbers.
    ///
    /// # Errors
    /// [`RigError`] as [`TipWorld::check`].
    pub fn check(&self) -> Result<(), RigError> {
        self.tip.check()
    }

    /// What moves `arm` from `state` on; `durations_s` are those that come at every sample.
    pub(super) fn motion<'a>(
        &'a self,
        arm: &'a Arm,
        state: Vec<f64>,
        durations_s: &[f64],
    ) -> Result<Box<dyn Motion + 'a>, RigError> {
        if self.friction.is_none() && self.tip.is_empty() && self.later.is_empty() {
            return Ok(Box::new(BySamples::new(arm, state, durations_s)));
        }
        let mut hybrid = Hybrid::with_state(arm, state);
        if let Some(law) = self.friction {
            hybrid = hybrid.with_friction(law);
        }
        let later: Vec<(f64, &Arm)> = self.later.iter().map(|(t, arm)| (*t, arm)).collect();
        Ok(Box::new(hybrid.with_world(self.tip.clone())?.with_changes(&later)?))
    }
}
