//! The arm that stands for a result: what predicts other logs.

use super::friction_law::{LawFit, LawTerm};
use super::identified::Identified;
use super::output_error::starts;
use super::validation::{torque, zeros};
use crate::record::Campaign;
use crate::replay::{ModalArm, NearRest, Ripple};

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
            let zeros = zeros(used, &oe.windows);
            return Some(Self::with(oe.arm.clone(), ArmSource::OutputError, used, &zeros));
        }
        let (Some(motor), Some(_), Some(_)) = (&id.regression, id.inertia, id.friction.coulomb)
        else {
            return None;
        };
        let beam = id.beam_regression.as_ref();
        let mut arm = starts(used, motor, beam, id.beam_model.as_ref()).into_iter().next()?;
        if let Some(split) = motor.viscous_by_direction {
            let back_emf = used.channels.command.back_emf_viscous;
            arm.viscous_nm_s_per_rad = [split.forward.value, split.backward.value];
            arm.viscous_nm_s_per_rad.iter_mut().for_each(|v| *v += back_emf);
            // The offset that goes with one constant for both directions is another.
            arm.offset_nm = split.offset.value;
        }
        if let Some(law) = id.friction_law.as_ref().filter(|law| law.chosen.departs()) {
            follow(&mut arm, &law.chosen, used);
        }
        Some(Self::with(arm, ArmSource::Regression, used, &[]))
    }

    fn with(arm: ModalArm, source: ArmSource, used: &Campaign, zeros: &[Vec<f64>]) -> Self {
        let torque_used = torque(&arm, used, zeros, None)
            .map(|t| TorqueUsed { relative_error: t.relative_error, window_s: t.window_s });
        Self { arm, source, torque_used }
    }
}

/// Takes the motor's figures under a law of friction where the replay knows all of its terms.
fn follow(arm: &mut ModalArm, law: &LawFit, used: &Campaign) {
    let root = law.terms.iter().any(|(term, _)| *term == LawTerm::Root);
    let (Some(inertia), Some(viscous), Some(coulomb)) = (law.inertia, law.viscous, law.coulomb)
    else {
        return;
    };
    if root {
        return;
    }
    let back_emf = used.channels.command.back_emf_viscous;
    arm.inertia_kg_m2 = inertia.value;
    arm.viscous_nm_s_per_rad = [viscous.value + back_emf; 2];
    arm.coulomb_nm = coulomb.value;
    arm.offset_nm = law.offset.map_or(0.0, |o| o.value);
    if let Some(total) = law.total_coupling {
        let factor = total.value / arm.coupling_nm_per_rad();
        arm.modes.iter_mut().for_each(|m| m.stiffness_nm_per_rad *= factor);
    }
    for (term, amplitude) in &law.terms {
        match (*term, &amplitude[..]) {
            (LawTerm::ViscousByDirection, [d]) => {
                arm.viscous_nm_s_per_rad[0] += d.value;
                arm.viscous_nm_s_per_rad[1] -= d.value;
            }
            (LawTerm::NearRest { speed }, [a]) => {
                let near = NearRest { torque_nm: a.value, speed_rad_s: speed };
                arm.dry_terms.near_rest = Some(near);
            }
            (LawTerm::Ripple { per_angle }, [cosine, sine]) => {
                arm.dry_terms.ripples.push(Ripple {
                    per_rad: per_angle,
                    cosine_nm: cosine.value,
                    sine_nm: sine.value,
                });
            }
            (LawTerm::CommandLag, [lag]) => arm.command_lag_s = lag.value,
            _ => {}
        }
    }
}
