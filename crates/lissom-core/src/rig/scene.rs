//! The surroundings of an arm: friction, gravity and torque ripple at the joint, forces at the tip, later payloads.

use super::error::finite;
use super::{FrictionWander, HeldArm, HeldMotion, Hybrid, LuGreMotion, Motion, RigError, TipWorld};
use crate::arm::Arm;
use crate::drive::{DryFriction, LuGre};
use crate::load::{GravityLoad, PositionTorque, TorqueRipple};

/// Friction law of the joint.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub enum JointFriction {
    /// The Coulomb friction of the arm. Exact to rounding.
    #[default]
    Arm,
    /// Another law of dry friction. Exact to rounding if it is constant in slip, otherwise to 1e-15 per step.
    Dry(DryFriction),
    /// LuGre bristles in place of the arm's Coulomb friction, solved to a relative tolerance per step.
    Bristles {
        /// The friction law.
        law: LuGre,
        /// Tolerance of a step, 1e-12 to 1e-2 \[1\].
        tolerance: f64,
    },
}

impl From<DryFriction> for JointFriction {
    fn from(law: DryFriction) -> Self {
        Self::Dry(law)
    }
}

/// The physics of a rig that is not part of its [`Arm`]. By default there is nothing: the arm's own Coulomb friction,
/// and nothing at the tip.
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
    /// Friction law of the joint.
    pub friction: JointFriction,
    /// Random change of that friction over time; `None`: it is constant. Not possible with bristles.
    pub wander: Option<FrictionWander>,
    /// Constant torque of a load against the motor \[N·m\], for example a weight on a hoist or a preload; positive if
    /// the motor has to push forward.
    pub load_nm: f64,
    /// Gravity of an unbalanced load on the motor, a function of the motor's true angle; `None`: no load.
    pub gravity: Option<GravityLoad>,
    /// Torque ripples (cogging) of the motor, functions of the motor's true angle.
    pub torque_ripples: Vec<TorqueRipple>,
    /// What acts on the tip.
    pub tip: TipWorld,
    /// Arms that replace the first one at given times \[s\] since the start, for example with another payload.
    pub later: Vec<(f64, Arm)>,
}

impl Scene {
    /// Checks the numbers.
    ///
    /// # Errors
    /// [`RigError`] of [`TipWorld::check`]; [`RigError::NotFinite`] if gravity, a torque ripple or the constant load is not
    /// finite;
    /// [`RigError::Unsupported`] for bristles whose friction wanders.
    pub fn check(&self) -> Result<(), RigError> {
        if let Some(load) = self.gravity {
            finite("gravity of the load in N*m", load.amplitude_nm())?;
        }
        for ripple in &self.torque_ripples {
            finite("waves per rad of a torque ripple", ripple.per_rad)?;
            finite("torque ripple in N*m", ripple.amplitude_nm())?;
        }
        finite("constant load in N*m", self.load_nm)?;
        if self.wander.is_some() && matches!(self.friction, JointFriction::Bristles { .. }) {
            return Err(RigError::Unsupported { what: "bristles whose friction wanders" });
        }
        self.tip.check()
    }

    /// Relative tolerance of a step of the motion; `None` if it is exact to rounding.
    pub fn tolerance(&self) -> Option<f64> {
        match &self.friction {
            JointFriction::Dry(law) if !law.is_constant() => Some(Hybrid::BENT),
            JointFriction::Bristles { tolerance, .. } => Some(*tolerance),
            _ if !self.position_torque().is_empty() => Some(Hybrid::BENT),
            _ => None,
        }
    }

    /// Dry friction of the joint without its random change; `None` with bristles.
    pub fn dry_friction(&self, arm: &Arm) -> Option<DryFriction> {
        match &self.friction {
            JointFriction::Arm => Some(arm.coulomb.into()),
            JointFriction::Dry(law) => Some(law.clone()),
            JointFriction::Bristles { .. } => None,
        }
    }

    /// Gravity and torque ripples together.
    pub fn position_torque(&self) -> PositionTorque {
        PositionTorque::new(self.gravity, &self.torque_ripples)
    }

    /// What friction holds at rest, the lesser of both directions \[N·m\].
    pub(super) fn holds_nm(&self, arm: &Arm) -> f64 {
        let rest = match &self.friction {
            JointFriction::Arm => arm.coulomb,
            JointFriction::Dry(law) => law.at(0.0, 0.0),
            JointFriction::Bristles { law, .. } => law.at_rest(),
        };
        rest.forward().min(rest.backward())
    }

    /// Whether `arm` stays at rest at angle zero without a torque of the motor.
    pub(super) fn rests_at_zero(&self, arm: &Arm) -> bool {
        let load = self.load_nm + self.position_torque().torque_nm(0.0);
        // Bristles give way by some of their travel.
        let gives_way = matches!(self.friction, JointFriction::Bristles { .. });
        load == 0.0 || !gives_way && load.abs() < self.holds_nm(arm)
    }

    fn is_alone(&self) -> bool {
        self.tip.is_empty() && self.later.is_empty()
    }

    /// `arm` made ready for `durations_s`, those that come at every sample, where nothing but its own
    /// friction acts on it.
    pub(super) fn held<'a>(
        &self,
        arm: &'a Arm,
        durations_s: &[f64],
    ) -> Result<Option<HeldArm<'a>>, RigError> {
        let fixed = self.friction == JointFriction::Arm && self.wander.is_none();
        if !fixed || !self.position_torque().is_empty() || !self.is_alone() {
            return Ok(None);
        }
        let durations_s: Vec<f64> = durations_s.iter().copied().filter(|d| *d > 0.0).collect();
        HeldArm::new(arm, &durations_s)
    }

    /// What moves `arm` from `state` on; `held` is [`Self::held`] of it.
    pub(super) fn motion<'a>(
        &'a self,
        arm: &'a Arm,
        held: Option<&'a HeldArm<'a>>,
        state: Vec<f64>,
    ) -> Result<Box<dyn Motion + 'a>, RigError> {
        if let Some(held) = held {
            return Ok(Box::new(HeldMotion::with_state(held, &state)?));
        }
        let dry = match &self.friction {
            JointFriction::Arm => arm.coulomb.into(),
            JointFriction::Dry(law) => law.clone(),
            JointFriction::Bristles { .. } if !self.is_alone() => {
                return Err(RigError::Unsupported {
                    what: "bristles beside a world at the tip or changing payloads",
                });
            }
            JointFriction::Bristles { law, tolerance } => {
                let motion = LuGreMotion::with_state(arm, *law, *tolerance, &state, 0.0)?;
                return Ok(Box::new(motion.with_position_torque(self.position_torque())));
            }
        };
        let later: Vec<(f64, &Arm)> = self.later.iter().map(|(t, arm)| (*t, arm)).collect();
        let hybrid = Hybrid::with_state(arm, state).with_friction(dry);
        let hybrid = hybrid.with_torque_ripples(&self.torque_ripples);
        let hybrid = match self.gravity {
            Some(load) => hybrid.with_gravity(load),
            None => hybrid,
        };
        Ok(Box::new(hybrid.with_world(self.tip.clone())?.with_changes(&later)?))
    }
}
