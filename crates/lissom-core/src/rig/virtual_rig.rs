//! A virtual rig: what it is made of, and what its logs have.

use std::ops::Range;

use super::{ControlLaw, Instruments, RigError, Scene};
use crate::arm::Arm;
use crate::record::{Axis, Channels, Command, CommandQuantity, Hold, Tip, TipQuantity};

/// Most steps of the engines in a sample: at some 100 ns a step, a second for a hundred samples.
const STEPS_MOST: f64 = 1e5;

/// A virtual rig: an arm, its instruments and a controller in a sampled loop.
#[derive(Debug, Clone)]
pub struct Rig {
    /// The arm.
    pub arm: Arm,
    /// Friction of the joint if it is not the arm's, gravity, and what acts on the tip.
    pub scene: Scene,
    /// Sample time, sensors, amplifier and delay.
    pub instruments: Instruments,
    /// The controller. It is not used in experiments with an open drive.
    pub controller: ControlLaw,
}

impl Rig {
    /// Builds a rig with the arm's own Coulomb friction and nothing at the tip.
    pub fn new(arm: Arm, instruments: Instruments, controller: ControlLaw) -> Self {
        Self { arm, scene: Scene::default(), instruments, controller }
    }

    /// The channels of this rig's logs with only the masses `tips` (counted from 0, base to tip): the current,
    /// commanded or measured, and the angles.
    ///
    /// # Errors
    /// [`RigError::TipRange`] if the beam does not have these masses.
    pub fn channels(&self, tips: Range<usize>) -> Result<Channels, RigError> {
        let masses = self.arm.beam().len();
        if tips.start > tips.end || tips.end > masses {
            return Err(RigError::TipRange { found: tips, masses });
        }
        Ok(self.channels_of(tips))
    }

    /// The same of masses that the beam has.
    pub(crate) fn channels_of(&self, tips: Range<usize>) -> Channels {
        let instruments = &self.instruments;
        let held = instruments.current.is_none()
            && instruments.control_every.is_multiple_of(instruments.log_every);
        let tip = |mass: usize| Tip {
            name: format!("theta_{}", mass + 1),
            quantity: TipQuantity::Angle,
            calibrated: true,
        };
        Channels {
            axis: Axis::Rotary,
            command: Command {
                quantity: CommandQuantity::Current,
                hold: if held { Hold::Sampled } else { Hold::Measured },
                torque_per_command: Some(self.arm.motor.torque_constant_nm_per_a()),
                back_emf_viscous: 0.0,
                limit: instruments.amplifier.limit_a(),
            },
            tips: tips.map(tip).collect(),
        }
    }

    /// Checks the values of the fields.
    ///
    /// # Errors
    /// [`RigError`] if times are not positive, sensors do not fit the beam, or the arm changes too fast for the sample
    /// time to be simulated.
    pub fn check(&self) -> Result<(), RigError> {
        self.instruments.check(self.arm.beam().len())?;
        self.scene.check()?;
        let sample_time_s = self.instruments.sample_time_s;
        for arm in std::iter::once(&self.arm).chain(self.scene.later.iter().map(|(_, arm)| arm)) {
            let rate_per_s = arm.rate_bound();
            let steps = rate_per_s * sample_time_s;
            if steps > STEPS_MOST || steps.is_nan() {
                let most = STEPS_MOST;
                return Err(RigError::TooStiff { rate_per_s, steps, sample_time_s, most });
            }
        }
        Ok(())
    }
}
