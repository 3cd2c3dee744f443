//! The arms that a campaign's output error starts from.

use super::models;
use super::output_error::{starts, starts_by_motor, starts_by_responses};
use super::rational::BeamFit;
use super::regression::{BeamRegression, MotorRegression, coupled_tips};
use super::response_table::ResponsePoint;
use crate::record::Campaign;
use crate::replay::ModalArm;

/// Those of the regressions and of the rational model `tips` first, then those of responses alone: the tips'
/// in `shown`, and the motor's without friction, which `corrected` makes.
pub(super) fn starting_arms(
    usable: &Campaign,
    motor: &MotorRegression,
    beam: Option<&BeamRegression>,
    tips: Option<&BeamFit>,
    shown: &[ResponsePoint],
    corrected: impl Fn() -> Vec<ResponsePoint>,
) -> Vec<ModalArm> {
    let constant = usable.channels.command.torque_per_command.unwrap_or(1.0);
    if coupled_tips(usable).is_empty() {
        let response = models::motor_model(&corrected(), constant, tips);
        return starts_by_motor(usable, motor, tips, response.as_ref());
    }
    let mut arms = starts(usable, motor, beam, tips);
    if let Some((omega_rad_s, tips)) = models::tip_responses(usable, shown) {
        let motor_data = models::motor_data(&corrected(), constant);
        arms.extend(starts_by_responses(usable, motor, &omega_rad_s, &tips, &motor_data));
    }
    arms
}
