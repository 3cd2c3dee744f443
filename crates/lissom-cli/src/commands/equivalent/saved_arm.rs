//! An equivalent arm as an arm.toml.

use std::path::Path;

use lissom::identify::Equivalent;
use lissom::{EquivalentArmError, EquivalentInput};

use crate::shared::failure::Failure;

/// The text of the arm.toml, or why there is no arm to write.
pub(crate) fn text(
    input_file: &Path,
    input: &EquivalentInput,
    found: &Equivalent,
) -> Result<String, Failure> {
    input.arm_text(found).map_err(|error| {
        let hint = match &error {
            EquivalentArmError::NoTorqueConstant => {
                "give the torque per ampere, as in --torque-constant \"0.25 N*m/A\""
            }
            EquivalentArmError::Arm { .. } => {
                "keep fewer modes with --modes, or measure longer near the resonance of this mode"
            }
            other => other.hint(),
        };
        let reason = format!("the arm cannot be saved: {error}");
        Failure::Model { arm: input_file.to_owned(), reason, hint }
    })
}
