//! The arm that stands for a result: what predicts other logs.

use super::identified::Identified;
use super::output_error::{starts, starts_by_motor};
use super::validation::{torque, zeros};
use crate::record::Campaign;
use crate::replay::ModalArm;

/// Which method an arm is from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ArmSource {
    /// The output error, whose arm describes the runs.
    OutputError,
    /// The regressions on slip phases.
    Regression,
}

/// The arm of a result.
#[derive(Debug, Clone, PartialEq)]
pub struct FoundArm {
    /// Its numbers, the back-EMF's damping in the viscous ones.
    pub arm: ModalArm,
    /// Where they are from.
    pub source: ArmSource,
    /// The torque of the logs used as it predicts it; `None` where the tips do not give the coupling
    /// torque.
    pub torque_used: Option<TorqueUsed>,
}

/// How the torque of the logs used is predicted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TorqueUsed {
    /// ‖logged − predicted‖/‖logged‖.
    pub relative_error: f64,
    /// Length of the window that both sides were averaged with \[s\].
    pub window_s: f64,
}

impl FoundArm {
    /// The arm of the method that the verdict takes the figures from; `None` where it refuses
    /// inertia or Coulomb friction or their method gives no whole arm. `used` are the runs that the
    /// methods used.
    pub(super) fn of(id: &Identified, used: &Campaign) -> Option<Self> {
        let stands = id.output_error.as_ref().filter(|oe| oe.stands());
        if let Some(oe) = stands {
            return Some(Self::with(oe.arm.clone(), ArmSource::OutputError, used));
        }
        let (Some(motor), Some(_), Some(_)) = (&id.regression, id.inertia, id.friction.coulomb)
        else {
            return None;
        };
        let beam = id.beam_regression.as_ref();
        // Without a tip's angle slip phases give no arm: what starts a replay there is not one yet.
        let arms = if used.channels.tips.is_empty() {
            starts_by_motor(used, motor, None, None)
        } else {
            starts(used, motor, beam, id.beam_model.as_ref())
        };
        let mut arm = arms.into_iter().next()?;
        if let Some(split) = motor.viscous_by_direction {
            let back_emf = used.channels.command.back_emf_viscous;
            arm.viscous_nm_s_per_rad = [split.forward.value, split.backward.value];
            arm.viscous_nm_s_per_rad.iter_mut().for_each(|v| *v += back_emf);
            // The offset that goes with one constant for both directions is another.
            arm.offset_nm = split.offset.value;
        }
        if let Some(law) = id.friction_law.as_ref().filter(|law| law.chosen.departs()) {
            law.chosen.put_into(&mut arm, used.channels.command.back_emf_viscous);
        }
        Some(Self::with(arm, ArmSource::Regression, used))
    }

    fn with(arm: ModalArm, source: ArmSource, used: &Campaign) -> Self {
        let torque_used = torque(&arm, used, &zeros(&arm, used), None)
            .map(|t| TorqueUsed { relative_error: t.relative_error, window_s: t.window_s });
        Self { arm, source, torque_used }
    }
}
