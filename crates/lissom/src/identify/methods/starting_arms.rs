//! The arms that a campaign's output error starts from.

use crate::identify::drive_estimates::DriveEstimates;
use crate::identify::methods::output_error::{starts, starts_by_motor, starts_by_responses};
use crate::identify::methods::regression::{BeamRegression, coupled_tips};
use crate::identify::responses::models;
use crate::identify::responses::rational::BeamFit;
use crate::identify::responses::response_point::ResponsePoint;
use crate::record::Campaign;
use crate::replay::ModalArm;

/// Those of the regressions and of the rational model `tips` first, then those of responses alone: the tips'
/// in `shown`, and the motor's without friction, which `corrected` makes.
pub(crate) fn starting_arms(
    usable: &Campaign,
    drive: &DriveEstimates,
    beam: Option<&BeamRegression>,
    tips: Option<&BeamFit>,
    shown: &[ResponsePoint],
    corrected: impl Fn() -> Vec<ResponsePoint>,
) -> Vec<ModalArm> {
    let mut arms = arms(usable, drive, beam, tips, shown, corrected);
    // With less viscous friction than none a replay runs away.
    for arm in &mut arms {
        arm.viscous_nm_s_per_rad.iter_mut().for_each(|v| *v = v.max(0.0));
    }
    arms
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
