//! The arm of a result, which predicts other logs.

use std::borrow::Cow;

use crate::identify::drive_estimates::{DriveEstimates, Method};
use crate::identify::judge::{Chosen, Evidence};
use crate::identify::methods::friction_law::{LagShape, delayed};
use crate::identify::output_error::starting_arms::flexible;
use crate::identify::output_error::{rigid, starts, starts_by_motor};
use crate::identify::thresholds::REFUSED_TORQUE;
use crate::identify::validation::torque::torque_error;
use crate::identify::validation::torque_arm::TorqueArm;
use crate::identify::validation::zeros::zeros;
use crate::record::{Campaign, CommandQuantity};
use crate::replay::ModalArm;

/// The method that an arm comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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
    /// Whether the arm's lag of the command is a delay or the time constant of a first-order filter.
    pub lag_shape: LagShape,
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
    /// The arm of the solution that was taken, whole: with the law of friction, if it has one. `None` where inertia or Coulomb
    /// friction is refused or the method gives no whole arm.
    pub(super) fn of(evidence: &Evidence<'_>, chosen: &Chosen) -> Option<Self> {
        let used = evidence.used;
        let law = evidence.methods.friction_law.as_ref();
        let lag = law.and_then(|law| law.lag);
        let shape = lag.map_or(LagShape::Delay, |lag| lag.shape);
        if let Some(oe) = evidence.replay() {
            let mut arm = oe.arm.clone();
            let before = lag.filter(|lag| !lag.is_delay_of(evidence.campaign));
            arm.command_lag_s += before.map_or(0.0, |lag| lag.time_s);
            let found = Self::with(arm, Vec::new(), ArmSource::OutputError, shape, used);
            return Some(found.of_logs(evidence.tip_lags_s));
        }
        let supported = &chosen.drive;
        let (Some(_), Some(_)) = (supported.inertia, supported.friction.coulomb) else {
            return None;
        };
        let drive = &chosen.solution;
        let (arm, coupling_alone) = of_drive(evidence, drive)
            .map(|arm| (arm, Vec::new()))
            .or_else(|| without_modes(used, drive))?;
        let arm = match (chosen.method?, law) {
            (Method::FrictionLaw, Some(law)) => {
                law.chosen.put_into(arm, used.channels.command.back_emf_viscous)?
            }
            _ => arm,
        };
        let found = Self::with(arm, coupling_alone, ArmSource::Regression, shape, used);
        Some(found.of_logs(evidence.tip_lags_s))
    }

    /// The arm of the logs as they are, whose tips are later by `lags_s` than those that it was found with.
    fn of_logs(mut self, lags_s: &[f64]) -> Self {
        let own = &mut self.arm.tip_lags_s;
        own.resize(own.len().max(lags_s.len()), 0.0);
        own.iter_mut().zip(lags_s).for_each(|(own, lag_s)| *own += lag_s);
        self
    }

    /// The same without its lag of the command, and a campaign whose commands are as late: a filter, and the late goal of a
    /// servo, are no delay of the torque.
    pub(super) fn in_time<'c>(&self, campaign: &'c Campaign) -> (Self, Cow<'c, Campaign>) {
        let goal = campaign.channels.command.quantity == CommandQuantity::PositionError;
        let time_s = self.arm.command_lag_s;
        if time_s == 0.0 || !(goal || self.lag_shape == LagShape::Filter) {
            return (self.clone(), Cow::Borrowed(campaign));
        }
        let mut found = self.clone();
        found.arm.command_lag_s = 0.0;
        (found, Cow::Owned(delayed(campaign, self.lag_shape, time_s)))
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

    fn with(
        arm: ModalArm,
        coupling_alone_nm_per_rad: Vec<f64>,
        source: ArmSource,
        lag_shape: LagShape,
        used: &Campaign,
    ) -> Self {
        let mut found =
            Self { arm, coupling_alone_nm_per_rad, source, lag_shape, torque_used: None };
        let (in_time, used) = found.in_time(used);
        let arm = in_time.for_torque();
        found.torque_used = torque_error(arm, &used, &zeros(arm, &used))
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
