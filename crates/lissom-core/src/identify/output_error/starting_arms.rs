//! The arms from which the output-error method starts.

use crate::identify::drive_estimates::DriveEstimates;
use crate::identify::methods::friction_law::{FrictionLaw, LawTerm};
use crate::identify::methods::regression::{
    BeamRegression, HiddenMode, MotorRegression, beam_regression, coupled_tips, motor_regression,
};
use crate::identify::options::Options;
use crate::identify::output_error::{
    starts, starts_by_motor, starts_by_responses, with_hidden_mode,
};
use crate::identify::prepare::prepared::Prepared;
use crate::identify::responses::models;
use crate::identify::responses::rational::BeamFit;
use crate::identify::responses::response_point::ResponsePoint;
use crate::record::{Campaign, Tip, TipQuantity};
use crate::replay::ModalArm;

/// Those of the regressions and of the rational model `tips` first, then those of responses alone: the tips'
/// in `shown`, and the motor's without friction, which `corrected` makes; then the mode that slip phases show without a tip.
pub(crate) fn starting_arms(
    usable: &Campaign,
    (drive, motor, lag_s): (&DriveEstimates, &MotorRegression, f64),
    beam: Option<&BeamRegression>,
    tips: Option<&BeamFit>,
    shown: &[ResponsePoint],
    corrected: impl Fn() -> Vec<ResponsePoint>,
) -> Vec<ModalArm> {
    let mut arms = arms(usable, drive, beam, tips, shown, corrected);
    arms.extend(motor.mode.and_then(|mode| flexible(usable, drive, mode)));
    // With less viscous friction than none a replay runs away.
    for arm in &mut arms {
        arm.viscous_nm_s_per_rad.iter_mut().for_each(|v| *v = v.max(0.0));
    }
    if let Some(late) = beam.filter(|beam| beam.lags_s.iter().any(|lag_s| *lag_s != 0.0)) {
        let of_late = arms.iter().map(|arm| with_late_tips(arm, usable, drive, &late.lags_s));
        arms = of_late.chain(arms.iter().cloned()).collect();
    }
    if lag_s == 0.0 {
        return arms;
    }
    // A search that starts without a delay may miss one of several samples; one that starts with the delay that stands for
    // something else ends beside the arm.
    let late = |arm: &ModalArm| ModalArm { command_lag_s: lag_s, ..arm.clone() };
    arms.iter().map(late).chain(arms.iter().cloned()).collect()
}

/// The arm with tips that are read late: what a lag adds to the torque of the coupling, viscous friction seems to lack.
fn with_late_tips(
    arm: &ModalArm,
    usable: &Campaign,
    drive: &DriveEstimates,
    lags_s: &[f64],
) -> ModalArm {
    let coupling = drive.coupling_by_tip.iter().map(|c| c.map_or(0.0, |c| c.value));
    let lacking: f64 = coupling.zip(lags_s).map(|(k, lag_s)| k * lag_s).sum();
    let found = drive.friction.viscous.map_or(0.0, |v| v.value);
    let back_emf = usable.channels.command.back_emf_viscous;
    let viscous = (found + back_emf + lacking).max(0.0);
    let viscous_nm_s_per_rad = arm.viscous_nm_s_per_rad.map(|_| viscous);
    ModalArm { viscous_nm_s_per_rad, tip_lags_s: lags_s.to_vec(), ..arm.clone() }
}

/// Starting arms where no tip shows an angle: a gauge of unknown scale, or an accelerometer.
///
/// Their readings y are then taken for deflections in a unit of their own, with which both regressions hold. An acceleration is
/// `−ω²` times the deflection of its mode.
pub(crate) fn starts_by_bending(prepared: &Prepared<'_>, options: &Options) -> Vec<ModalArm> {
    let mut used = prepared.used().clone();
    if used.channels.tips.is_empty() || !coupled_tips(&used).is_empty() {
        return Vec::new();
    }
    let accelerates = |tip: &Tip| tip.quantity == TipQuantity::Acceleration;
    let accelerations: Vec<bool> = used.channels.tips.iter().map(accelerates).collect();
    for tip in &mut used.channels.tips {
        (tip.quantity, tip.calibrated) = (TipQuantity::Deflection, true);
    }
    let bent = prepared.using(used);
    let (Some(motor), Some(beam)) = (motor_regression(&bent, options), beam_regression(&bent))
    else {
        return Vec::new();
    };
    let mut arms = starts(bent.used(), &motor.estimates(), Some(&beam), None);
    for arm in &mut arms {
        let of_tips = arm.shapes.iter_mut().zip(&accelerations);
        for (row, _) in of_tips.filter(|(_, accelerates)| **accelerates) {
            let of_mode = row.iter_mut().zip(&arm.modes);
            of_mode.for_each(|(share, mode)| *share /= -mode.omega_rad_s.powi(2));
        }
    }
    arms
}

/// The same arms with the law of friction that predicts best first. Ripples of torque are not estimated by a replay.
pub(crate) fn with_law(
    law: Option<&FrictionLaw>,
    arms: Vec<ModalArm>,
    usable: &Campaign,
) -> Vec<ModalArm> {
    let cogs = |(term, _): &(LawTerm, _)| matches!(term, LawTerm::TorqueRipple { .. });
    let law = law.map(|law| &law.chosen);
    let Some(law) = law.filter(|law| law.departs() && !law.terms.iter().any(cogs)) else {
        return arms;
    };
    let back_emf = usable.channels.command.back_emf_viscous;
    let lawful = |arm: &ModalArm| {
        let with = law.put_into(arm.clone(), back_emf)?;
        // The delay is that of the arm.
        Some(ModalArm { command_lag_s: arm.command_lag_s, ..with })
    };
    let lawful: Vec<ModalArm> = arms.iter().filter_map(lawful).collect();
    lawful.into_iter().chain(arms).collect()
}

/// An axis without tips with a mode.
pub(crate) fn flexible(
    campaign: &Campaign,
    drive: &DriveEstimates,
    mode: HiddenMode,
) -> Option<ModalArm> {
    let rigid = starts_by_motor(campaign, drive, None, None).into_iter().next()?;
    Some(with_hidden_mode(rigid, mode.shape()))
}

fn arms(
    usable: &Campaign,
    drive: &DriveEstimates,
    beam: Option<&BeamRegression>,
    tips: Option<&BeamFit>,
    shown: &[ResponsePoint],
    corrected: impl Fn() -> Vec<ResponsePoint>,
) -> Vec<ModalArm> {
    let constant = usable.channels.command.torque_per_unit();
    if coupled_tips(usable).is_empty() {
        let response = models::motor_model(&corrected(), constant, tips);
        return starts_by_motor(usable, drive, tips, response.as_ref());
    }
    let mut arms = starts(usable, drive, beam, tips);
    if let Some((omega_rad_s, tips)) = models::tip_responses(usable, shown) {
        let motor_data = models::motor_data(&corrected(), constant);
        arms.extend(starts_by_responses(usable, drive, &omega_rad_s, &tips, &motor_data));
    }
    arms
}
