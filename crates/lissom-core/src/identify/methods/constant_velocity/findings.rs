//! What speaks against an extrapolation to zero speed.

use crate::identify::estimate::Estimate;
use crate::identify::findings::{EstimateUnits, Finding, rows};
use crate::identify::methods::constant_velocity::ConstantVelocity;
use crate::identify::methods::constant_velocity::line::{FrictionLine, LineError, LineShape};
use crate::record::Campaign;

/// Findings about friction from constant velocities. `meant`: there are runs made for it, so that what is missing
/// is reported, too.
pub(crate) fn findings(campaign: &Campaign, found: &ConstantVelocity, meant: bool) -> Vec<Finding> {
    let command = CommandScale {
        torque_per_command: campaign.channels.command.torque_per_unit(),
        unit: EstimateUnits::new(&campaign.channels).command(),
    };
    let lines = [("forward", &found.forward), ("backward", &found.backward)];
    let known =
        lines.iter().filter_map(|(direction, line)| Some((*direction, line.as_ref().ok()?)));
    let mut out: Vec<_> =
        known.filter_map(|(direction, line)| shape(direction, line, command)).collect();
    if meant {
        let errors =
            lines.iter().filter_map(|(direction, line)| Some((*direction, line.as_ref().err()?)));
        out.extend(errors.map(|(direction, error)| refused(direction, *error, command)));
    }
    out
}

/// The command of a torque.
#[derive(Debug, Clone, Copy)]
struct CommandScale {
    torque_per_command: f64,
    unit: &'static str,
}

impl CommandScale {
    fn of(self, torque: Estimate) -> Estimate {
        torque.scaled(1.0 / self.torque_per_command)
    }
}

fn shape(direction: &'static str, line: &FrictionLine, scale: CommandScale) -> Option<Finding> {
    let (command, unit) = (scale.of(line.coulomb).value, scale.unit);
    let curved = |concave: bool, standard_errors: f64| {
        Some(Finding::new(rows::ExtrapolationCurved {
            direction,
            concave,
            standard_errors,
            command,
            of_slowest: line.slowest.map(|slowest| scale.of(slowest)),
            unit,
        }))
    };
    match line.shape {
        LineShape::Straight => None,
        LineShape::Concave { standard_errors } => curved(true, standard_errors),
        LineShape::Convex { standard_errors } => curved(false, standard_errors),
        LineShape::Scattered { rms } => Some(Finding::new(rows::SpeedsScatter {
            direction,
            rms_standard_errors: rms,
            command,
            unit,
        })),
        LineShape::Unchecked => Some(Finding::new(rows::TwoSpeeds { direction })),
    }
}

fn refused(direction: &'static str, error: LineError, scale: CommandScale) -> Finding {
    match error {
        LineError::NoPoints => rows::OneDirection { direction }.into(),
        LineError::TooFewSpeeds { found } => rows::TooFewSpeeds { direction, speeds: found }.into(),
        LineError::TooClose { coulomb, std } => rows::SpeedsTooClose {
            direction,
            command: scale.of(Estimate { value: coulomb, std }),
            unit: scale.unit,
        }
        .into(),
    }
}
