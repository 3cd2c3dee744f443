//! An equivalent arm as an arm.toml.

use std::path::Path;

use lissom::drive::{Coulomb, Motor};
use lissom::identify::Equivalent;
use lissom::record::CommandQuantity;
use lissom_io::write::{self, WrittenArm};

use crate::shared::failure::Failure;
use crate::tasks::equivalent_input::Input;

/// The text of the arm.toml, or why there is no arm to write.
pub(crate) fn text(
    input_file: &Path,
    input: &Input,
    found: &Equivalent,
) -> Result<String, Failure> {
    let failed = |reason: String, hint| {
        let reason = format!("the arm cannot be saved: {reason}");
        Failure::Model { arm: input_file.to_owned(), reason, hint }
    };
    let Some(arm) = &found.arm else {
        let hint = "add the motor's response to the tables";
        return Err(failed("it has no torque without a usable response of the motor".into(), hint));
    };
    if !input.names.torque_known || input.names.command != CommandQuantity::Current {
        let hint = "give the torque per ampere, as in --torque-constant \"0.25 N*m/A\"";
        return Err(failed("the torque per current is unknown".into(), hint));
    }
    if found.strainless.is_none() {
        let hint = "give each point's response as an angle";
        return Err(failed("a point does not follow the motor at low frequency".into(), hint));
    }
    let hint = "keep fewer modes with --modes, or measure longer near the resonance of this mode";
    let beam = arm.modal_beam().map_err(|e| failed(e.to_string(), hint))?;
    let (inertia, viscous) = (arm.inertia.value, arm.viscous.value.max(0.0));
    let motor = Motor::new(inertia, viscous, arm.torque_per_command())
        .map_err(|e| failed(e.to_string(), hint))?;
    let coulomb = input.identified.as_ref().and_then(|known| known.coulomb);
    let coulomb =
        coulomb.and_then(|[forward, backward]| Coulomb::by_direction(forward, backward).ok());
    let points: Vec<&str> = found.points.iter().map(|&i| found.names[i].as_str()).collect();
    Ok(write::arm_text(&WrittenArm { motor, coulomb, beam: &beam, points: &points }))
}
