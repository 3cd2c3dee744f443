//! The arms from which the output-error method starts.

use crate::identify::drive_estimates::DriveEstimates;
use crate::identify::methods::friction_law::{FrictionLaw, LawTerm};
use crate::identify::methods::output_error::{
    starts, starts_by_motor, starts_by_responses, with_hidden_mode,
};
use crate::identify::methods::regression::{
    BeamRegression, HiddenMode, MotorRegression, coupled_tips,
};
use crate::identify::responses::models;
use crate::identify::responses::rational::BeamFit;
use crate::identify::responses::response_point::ResponsePoint;
use crate::record::Campaign;
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
    if lag_s == 0.0 {
        return arms;
    }
    // A search that starts without a delay may miss one of several samples; one that starts with the delay that stands for
    // something else ends beside the arm.
    let late = |arm: &ModalArm| ModalArm { command_lag_s: lag_s, ..arm.clone() };
    arms.iter().map(late).chain(arms.iter().cloned()).collect()
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
