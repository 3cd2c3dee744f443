//! Errors of an `arm.toml` whose keys are valid.

use std::path::Path;

use lissom_core::Error as CoreError;
use lissom_core::beam::BeamError;
use lissom_core::rig::RigError;

use crate::config::{ConfigError, ConfigPlace};

impl ConfigError {
    /// An `arm.toml` whose numbers make no arm or rig.
    pub fn of_arm(file: &Path, source: impl Into<CoreError>) -> Self {
        let place = ConfigPlace { file: file.display().to_string(), ..ConfigPlace::default() };
        unusable(place, source)
    }
}

/// Numbers at a place that make no part of an arm or rig.
pub(super) fn unusable(place: ConfigPlace, source: impl Into<CoreError>) -> ConfigError {
    let source = source.into();
    let hint = match &source {
        CoreError::Beam(error) => beam_hint(error),
        CoreError::Rig(RigError::Unsupported { .. }) => {
            "use fewer spans, or set `masses` in [rig] for a beam with mass along it"
        }
        _ => CHECK,
    };
    ConfigError::new(place, format!(": {source}"), hint)
}

const CHECK: &str = "check the numbers and their units";

fn beam_hint(error: &BeamError) -> &'static str {
    match error {
        BeamError::ModesAndPoints { .. } => {
            "give each mode one gain for each point, and as many modes as points"
        }
        BeamError::GainsSum { .. } => {
            "make the gains of each point add up to one: the highest mode takes what is missing"
        }
        BeamError::NoTip => "describe the beam by its spans, or remove [tip] and the payload",
        BeamError::TooManyMasses { .. } => "use fewer spans",
        BeamError::ModalDistributed => {
            "write damping = { mass_proportional = \"...\", stiffness_proportional = \"...\" }, or \
             give the beam point masses"
        }
        BeamError::ModalWithDampers => {
            "leave out the `damping` of the spans, or write damping = { mass_proportional = \
             \"...\", stiffness_proportional = \"...\" } instead of ratios"
        }
        _ => CHECK,
    }
}

/// A table that is not there.
pub(crate) fn absent(file: &Path, table: &str) -> ConfigError {
    let problem = format!("the table [{table}] is missing");
    ConfigError::of_file(file, problem, format!("add the table [{table}]"))
}

/// Gravity of a load on an arm with a beam.
pub(crate) fn load_on_beam(file: &Path) -> ConfigError {
    ConfigError::of_file(
        file,
        "[load] gives gravity to an arm with a beam, but gravity is simulated only for a rigid joint",
        "remove [load], or write `rigid = true` instead of the other keys of [beam]",
    )
}
