//! The arm of a result, which predicts other logs.

use crate::identify::drive_estimates::{DriveEstimates, Method};
use crate::identify::judge::{Chosen, Evidence, slip_phase_solution};
use crate::identify::methods::friction_law::FrictionLaw;
use crate::identify::methods::output_error::{rigid, starts, starts_by_motor};
use crate::identify::methods::starting_arms::flexible;
use crate::identify::thresholds::REFUSED_TORQUE;
use crate::identify::validation::torque::torque_error;
use crate::identify::validation::torque_arm::TorqueArm;
use crate::identify::validation::zeros::zeros;
use crate::record::Campaign;
use crate::replay::ModalArm;

/// The method that an arm comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ArmSource {
    /// The output-error method, whose arm describes the runs.
    OutputError,
    /// The regression in slip phases.
    Regression,
}

/// The arm of a result.
#[derive(Debug, Clone, PartialEq)]
pub struct FoundArm {
    /// Model of the arm. Its viscous friction includes the damping by back-EMF.
    pub arm: ModalArm,
    /// Coupling of each tip, torque on the motor per deflection \[N·m/rad\], if the logs show coupling but no modes.
    /// The arm then has no modes and predicts only torque. Otherwise empty.
    pub coupling_alone_nm_per_rad: Vec<f64>,
    /// The method that the arm comes from.
    pub source: ArmSource,
    /// Prediction of the torque of the logs that were used; `None` if the tips do not determine the coupling torque.
    pub torque_used: Option<TorqueUsed>,
}

/// How well the torque of the logs that were used is predicted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TorqueUsed {
    /// Relative error ‖logged − predicted‖/‖logged‖ \[1\].
    pub relative_error: f64,
    /// Length of the window over which both torques are averaged \[s\].
    pub window_s: f64,
}

impl FoundArm {
    /// The arm of the solution that was taken, whole; where that has a friction law that an arm cannot have, the arm
    /// of the regression without it, whole as well. `None` where inertia or Coulomb friction is refused or the method
    /// gives no whole arm.
    pub(super) fn of(evidence: &Evidence<'_>, chosen: &Chosen) -> Option<Self> {
        let used = evidence.used;
        if let Some(oe) = evidence.replay() {
            return Some(Self::with(oe.arm.clone(), Vec::new(), ArmSource::OutputError, used));
        }
        let supported = &chosen.drive;
        let (Some(_), Some(_)) = (supported.inertia, supported.friction.coulomb) else {
            return None;
        };
        let drive = &chosen.solution;
        let regression = evidence.methods.regression.as_ref();
        let law = evidence.methods.friction_law.as_ref();
        let arm = match chosen.method? {
            Method::FrictionLaw => lawful(evidence, law?, drive)
                .or_else(|| of_drive(evidence, &slip_phase_solution(regression, None)?.1)),
            _ => of_drive(evidence, drive),
        };
        let (mut arm, coupling_alone) =
            arm.map(|arm| (arm, Vec::new())).or_else(|| without_modes(used, drive))?;
        arm.command_lag_s += regression.and_then(|r| r.lag).map_or(0.0, |lag| lag.time_s);
        Some(Self::with(arm, coupling_alone, ArmSource::Regression, used))
    }

    /// Whether it predicts the torque of the logs that it is from, where these show it.
    pub(super) fn holds(&self) -> bool {
        self.torque_used.is_none_or(|used| used.relative_error < REFUSED_TORQUE)
    }

    /// Whether the arm predicts motion as well as torque.
    pub fn moves(&self) -> bool {
        self.for_torque().moves()
    }

    /// What of it predicts torque.
    pub(super) fn for_torque(&self) -> TorqueArm<'_> {
        let coupling_alone_nm_per_rad = &self.coupling_alone_nm_per_rad;
        TorqueArm { arm: &self.arm, coupling_alone_nm_per_rad }
    }

    fn with(arm: ModalArm, coupling_alone: Vec<f64>, source: ArmSource, used: &Campaign) -> Self {
        let mut found =
            Self { arm, coupling_alone_nm_per_rad: coupling_alone, source, torque_used: None };
        let arm = found.for_torque();
        found.torque_used = torque_error(arm, used, &zeros(arm, used))
            .map(|(window_s, relative_error)| TorqueUsed { relative_error, window_s });
        found
    }
}

/// The drive and the coupling of each tip, where no mode is known.
fn without_modes(used: &Campaign, drive: &DriveEstimates) -> Option<(ModalArm, Vec<f64>)> {
    let by_tip = drive.coupling_by_tip.iter().map(|c| c.map(|e| e.value));
    let coupling: Vec<f64> = by_tip.collect::<Option<_>>()?;
    if coupling.is_empty() || coupling.len() != used.channels.tips.len() {
        return None;
    }
    Some((rigid(used, drive)?, coupling))
}

/// An arm with the drive's estimates and the beam's own modes.
fn of_drive(evidence: &Evidence<'_>, drive: &DriveEstimates) -> Option<ModalArm> {
    let (used, methods) = (evidence.used, evidence.methods);
    // Without a tip's angle slip phases give no arm: what starts a replay there is not one yet.
    let arms = if used.channels.tips.is_empty() {
        let mode = methods.regression.as_ref().and_then(|r| r.mode);
        match mode {
            Some(mode) => flexible(used, drive, mode).into_iter().collect(),
            None => starts_by_motor(used, drive, None, None),
        }
    } else if drive.coupling.is_none() {
        // Of the equation without a beam; a tip is then no part of the arm.
        rigid(used, drive).into_iter().collect()
    } else {
        starts(used, drive, methods.beam_regression.as_ref(), methods.beam_model.as_ref())
    };
    arms.into_iter().next()
}

/// The same with the terms of a friction law; `None` where an arm cannot have one of them.
fn lawful(evidence: &Evidence<'_>, law: &FrictionLaw, drive: &DriveEstimates) -> Option<ModalArm> {
    let mut arm = of_drive(evidence, drive)?;
    law.chosen.put_terms_into(&mut arm).then_some(arm)
}
