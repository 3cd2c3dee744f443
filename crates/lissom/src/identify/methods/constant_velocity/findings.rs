//! What speaks against an extrapolation to rest.

use crate::identify::finding::{Finding, Severity, key};
use crate::identify::methods::constant_velocity::ConstantVelocity;
use crate::identify::methods::constant_velocity::line::{FrictionLine, LineError, Shape};
use crate::record::{Campaign, Run};

/// Findings about the figures of constant velocities. `meant`: there are runs made for them, so
/// that what is missing is said too.
pub(crate) fn findings(campaign: &Campaign, found: &ConstantVelocity, meant: bool) -> Vec<Finding> {
    let constant = campaign.channels.command.torque_per_command.unwrap_or(1.0);
    let mut out = Vec::new();
    for (name, line) in found.lines() {
        out.extend(shape(name, line, constant));
    }
    if !meant {
        return out;
    }
    for (name, line) in [("forward", &found.forward), ("backward", &found.backward)] {
        out.extend(line.as_ref().err().map(|error| refused(name, *error, constant)));
    }
    out
}

/// A run that turns one way without any stretch at a constant velocity.
pub(crate) fn no_stretch(run: &Run) -> Finding {
    Finding::new(
        "no-steady-velocity",
        Severity::Warning,
        &[key::CLASSICAL],
        "the motor turns one way throughout, and no part of the run is at a constant velocity"
            .to_owned(),
        "hold each speed for seven time constants of the loop or more; where the joint sticks and \
         slips, turn faster",
    )
    .of(run.name())
}

fn shape(name: &str, line: &FrictionLine, constant: f64) -> Option<Finding> {
    let figure = line.coulomb.value / constant;
    let slowest = line.slowest.map_or(String::new(), |s| {
        format!(
            "; from the slowest third of the speeds alone it is {:.4e} ± {:.1e}",
            s.value / constant,
            s.std / constant.abs()
        )
    });
    let curved = |deviations: f64, how: &str, errs: &str| {
        let message = format!(
            "{name}, friction grows {how} with speed ({deviations:.1} deviations): the command \
             extrapolated to rest, {figure:.4e}, is too {errs}{slowest}"
        );
        Finding::new(
            "extrapolation-curved",
            Severity::Warning,
            &[key::CLASSICAL],
            message,
            "add speeds near rest, as slow as the motor still turns evenly, or identify from sines \
             at the speeds you work at",
        )
    };
    match line.shape {
        Shape::Straight => None,
        Shape::Concave { deviations } => {
            Some(curved(deviations, "less than in proportion", "high"))
        }
        Shape::Convex { deviations } => Some(curved(deviations, "more than in proportion", "low")),
        Shape::Scattered { rms } => Some(Finding::new(
            "speeds-scatter",
            Severity::Warning,
            &[key::CLASSICAL],
            format!(
                "{name}, the points lie off their line by {rms:.1} of their deviations (rms), to \
                 both sides: that scatter makes the interval of {figure:.4e}"
            ),
            "friction changes with position or warmth: hold each speed over whole turns, and the \
             same ones, after a warm-up",
        )),
        Shape::Unchecked => Some(Finding::new(
            "two-speeds",
            Severity::Warning,
            &[key::CLASSICAL],
            format!("{name}, there are two speeds: nothing tests whether friction lies on a line"),
            "add a third speed, well apart from both",
        )),
    }
}

fn refused(name: &str, error: LineError, constant: f64) -> Finding {
    let finding = |code, message, hint| {
        let affects = [key::CLASSICAL, key::COULOMB, key::OFFSET];
        Finding::new(code, Severity::Refusal, &affects, message, hint)
    };
    match error {
        LineError::NoPoints => finding(
            "one-direction",
            format!("{name}, no run turns at a constant velocity"),
            "run the speeds in both directions: one alone cannot tell friction from a load",
        ),
        LineError::TooFewSpeeds { found } => finding(
            "too-few-speeds",
            format!(
                "{name}, there is {found} speed: a line to rest needs two, and three to be tested"
            ),
            "add speeds well apart, the slowest as slow as the motor still turns evenly",
        ),
        LineError::TooClose { coulomb, std } => finding(
            "speeds-too-close",
            format!(
                "{name}, the command extrapolated to rest would be {:.4e} ± {:.1e}: not known",
                coulomb / constant,
                std / constant.abs()
            ),
            "add slower speeds: rest is too far from those there are for what they scatter by",
        ),
    }
}
