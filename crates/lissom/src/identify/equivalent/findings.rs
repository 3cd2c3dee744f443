//! What to know of an equivalent arm.

use crate::identify::equivalent::EquivalentError;
use crate::identify::equivalent::arm::EquivalentArm;
use crate::identify::equivalent::data::{Deviations, Equivalent, EquivalentData};
use crate::identify::equivalent::refusal::side;
use crate::identify::equivalent::thresholds::{
    ERRORS_TOO_LARGE, GAIN_CHANGED, GIVEN_TO_LAST_MODE, MISFIT, MOTOR_LEFT, MOTOR_WORSE,
};
use crate::identify::estimate::Estimate;
use crate::identify::finding::{Finding, Severity, key};
use crate::identify::responses::correct::Response;
use crate::identify::responses::rational::{Damping, Spurious};
use crate::identify::thresholds::CLEARLY_PRESENT;

/// Largest change, as a share, of a gain for use as an arm.
fn changed(whole: &Equivalent) -> f64 {
    let each = whole.beam.completed.iter().zip(&whole.beam.gains);
    each.map(|(used, fitted)| (used / fitted - 1.0).abs())
        .filter(|c| c.is_finite())
        .fold(0.0, f64::max)
}

/// What the arm leaves of the motor's response, as a share of it, root mean square.
fn left_of_motor(data: &EquivalentData, arm: &EquivalentArm) -> f64 {
    let Some(motor) = &data.motor else { return 0.0 };
    let share = |(w, r): (&f64, &Response)| {
        (r.value - arm.motor_response(*w)).norm_sqr() / r.value.norm_sqr()
    };
    let shares = motor.omega_rad_s.iter().zip(&motor.response).map(share);
    (shares.sum::<f64>() / motor.response.len().max(1) as f64).sqrt()
}

/// Whether the arm describes the motor's response.
fn of_motor(
    data: &EquivalentData,
    whole: &Equivalent,
    arm: &EquivalentArm,
    add: &mut impl FnMut(&'static str, Severity, String, &'static str),
) {
    let (left, points) = (left_of_motor(data, arm), whole.relative_residual);
    let known = data.deviations != Deviations::FromResidual;
    if known && arm.weighted_rms > MISFIT {
        let message = format!(
            "the motor's response lies {:.1} times its deviations off the model: friction left in it, or modes \
             that are not in the arm. Intervals count it",
            arm.weighted_rms
        );
        let hint = "look at the plot of the motor";
        add("equivalent-motor-misfit", Severity::Warning, message, hint);
    } else if !known && left > MOTOR_LEFT && left > MOTOR_WORSE * points {
        let message = format!(
            "the arm leaves {:.1} % of the motor's response (rms), and {:.2} % of the points': friction left in it, \
             modes that are not in the arm, another quantity than angle per command, or a poor channel",
            100.0 * left,
            100.0 * points
        );
        let hint = "look at the plot of the motor; deviations (columns that end in _std) tell noise from misfit";
        add("equivalent-motor-misfit", Severity::Warning, message, hint);
    }
    if let Some(late) = arm.delay_s {
        let message = format!(
            "the motor comes {:.4} ms ± {:.4} ms {} against the command: the delay was taken out, and intervals count \
             that it is estimated",
            1e3 * late.value.abs(),
            1e3 * late.std,
            side(late.value)
        );
        let hint =
            "sample command and angle at one time, with one filter, or correct the response by it";
        add("equivalent-motor-delay", Severity::Warning, message, hint);
    }
    if arm.friction_left.abs() > CLEARLY_PRESENT {
        let message = format!(
            "the motor's response has a torque against the motion that does not grow with its speed, {:.1} deviations \
             from zero, as Coulomb friction leaves it: viscous friction and inertia may be off by more than their \
             intervals",
            arm.friction_left.abs()
        );
        let hint = "take the friction out first (`lissom identify` of the logs does), or measure at larger amplitudes";
        add("equivalent-motor-friction", Severity::Warning, message, hint);
    }
}

pub(super) fn findings(
    data: &EquivalentData,
    whole: &Equivalent,
    modes_found: usize,
    given: f64,
    no_torque: Option<EquivalentError>,
) -> Vec<Finding> {
    let mut findings = Vec::new();
    let mut add = |code, severity, message: String, hint| {
        findings.push(Finding::new(code, severity, &[key::EQUIVALENT], message, hint));
    };
    for (pole, why) in whole.fit.poles.iter().zip(&whole.spurious) {
        let why = match why {
            Some(Spurious::Outside) => "lies outside the frequencies measured",
            Some(Spurious::Damped) => "is damped as no mode of a beam is",
            Some(Spurious::Unfelt) => "moves no point by four deviations",
            None => continue,
        };
        let message =
            format!("a pole at {:.4} rad/s {why}: it is none of the arm's modes", pole.omega_rad_s);
        let hint = "nothing, where it stands for modes beyond the frequencies or for noise";
        add("equivalent-spurious-pole", Severity::Info, message, hint);
    }
    if whole.modes.len() < modes_found {
        let message = format!("{} of {modes_found} modes are kept", whole.modes.len());
        let hint = "the arm holds below the first mode left out";
        add("equivalent-modes-left-out", Severity::Info, message, hint);
    }
    let unused: Vec<&str> = (0..data.names.len())
        .filter(|i| !whole.points.contains(i))
        .map(|i| data.names[i].as_str())
        .collect();
    if !unused.is_empty() {
        let message = format!(
            "{} modes take as many points: {} not in the arm, its response is in the poles",
            whole.modes.len(),
            format_args!("{} {}", unused.join(", "), if unused.len() == 1 { "is" } else { "are" })
        );
        let hint = "measure at higher frequencies, to see as many modes as points";
        add("equivalent-points-left-out", Severity::Info, message, hint);
    }
    of_phase(whole, &mut add);
    let rms = whole.fit.weighted_rms;
    let known = data.deviations != Deviations::FromResidual;
    if known && rms > MISFIT {
        let message = format!(
            "the points' responses lie {rms:.1} times their deviations off the model: there is more in them \
             than modes of an arm, or the deviations are too small. Intervals count it"
        );
        let hint = "look at the plot: a misfit at one frequency is a disturbance, one everywhere a wrong deviation";
        add("equivalent-misfit", Severity::Warning, message, hint);
    } else if data.deviations == Deviations::Measured && rms < ERRORS_TOO_LARGE {
        let message =
            format!("the model leaves {rms:.2} of the deviations: they are larger than the errors");
        let hint = "intervals are wider than they need to be";
        add("equivalent-deviations-large", Severity::Info, message, hint);
    }
    if let Some(arm) = &whole.arm {
        of_motor(data, whole, arm, &mut add);
        let negative: Vec<String> = named(arm)
            .into_iter()
            .filter(|(_, figure)| figure.is_negative())
            .map(|(name, _)| name)
            .collect();
        if !negative.is_empty() {
            let message = format!("{} below zero: no arm has that", negative.join(", "));
            let hint =
                "check the motor's response: its sign, the torque constant, friction taken out";
            add("equivalent-implausible", Severity::Warning, message, hint);
        }
    }
    if let Some(error) = no_torque {
        let hint = "give the motor's response at more frequencies";
        add("equivalent-without-torque", Severity::Warning, error.to_string(), hint);
    }
    if whole.strainless.is_none() && given > 0.0 {
        let message = format!(
            "a point's gains add up to one but for {given:.3}: with the motor turned slowly it does not turn with it. \
             The form for use as an arm and the state space are not given"
        );
        let hint = "check for an angle of the wrong sign or in another unit than the motor's";
        add("equivalent-no-angle", Severity::Warning, message, hint);
    } else if given > GIVEN_TO_LAST_MODE || changed(whole) > GAIN_CHANGED {
        let message = format!(
            "the points' gains add up to one but for {given:.3}: for use as an arm the last mode is given the rest, \
             so that turning as one body strains nothing. It changes a gain by up to {:.0} %, and zeros with it",
            100.0 * changed(whole)
        );
        let hint =
            "the last mode's part of the responses is then as wrong as that; the others' stay";
        add("equivalent-completed", Severity::Info, message, hint);
    }
    findings
}

/// What imaginary parts show beside the damping of poles.
fn of_phase(
    whole: &Equivalent,
    add: &mut impl FnMut(&'static str, Severity, String, &'static str),
) {
    for part in &whole.imaginary {
        let Some(late) = part.delay_s else {
            let deviations =
                part.deviations.map_or(String::new(), |d| format!(", {d:.1} deviations,"));
            let message = format!(
                "{} has {:.2} % of its size{deviations} in an imaginary part that no damping explains: frequencies \
                 and gains may be off by more than their intervals",
                part.name,
                100.0 * part.share
            );
            let hint =
                "check the phase of the channels: filters, sampling, a delay between the two";
            add("equivalent-imaginary-part", Severity::Warning, message, hint);
            continue;
        };
        let message = format!(
            "{} comes {:.4} ms ± {:.4} ms {} against the motor: the delay was taken out, and intervals count that \
             it is estimated",
            part.name,
            1e3 * late.value.abs(),
            1e3 * late.std,
            side(late.value)
        );
        let hint = "sample both channels at one time, with one filter, or correct the responses by it: damping \
                    within the beam may look like a small delay";
        add("equivalent-delay", Severity::Warning, message, hint);
    }
    if whole.fit.damping == Damping::Within {
        let shares = (0..whole.kept.poles.len()).flat_map(|k| {
            let each = whole.kept.in_s.iter().zip(&whole.kept.static_gains);
            each.map(move |(terms, gains)| terms[k].value.abs() / gains[k].abs())
        });
        let largest = shares.filter(|s| s.is_finite()).fold(0.0, f64::max);
        let outputs = 0..whole.fit.static_gains.len();
        let hidden_s = outputs.map(|i| whole.fit.hidden_delay_s(i)).fold(0.0, f64::max);
        let message = format!(
            "residues have terms in s, of up to {largest:.4} of their gains: damping within the beam, or of a shape of \
             its own. A delay of up to {:.4} ms may stand behind them: the gains' intervals count it",
            1e3 * hidden_s
        );
        let hint = "nothing: they are in the fit; `lissom identify` finds an arm with such damping from logs";
        add("equivalent-terms-in-s", Severity::Info, message, hint);
    }
}

fn named(arm: &super::EquivalentArm) -> Vec<(String, Estimate)> {
    let coupling = arm.coupling.iter().enumerate();
    let coupling = coupling.map(|(k, c)| (format!("the coupling of mode {}", k + 1), *c));
    let motor =
        [("the inertia".to_owned(), arm.inertia), ("the viscous friction".to_owned(), arm.viscous)];
    motor.into_iter().chain(coupling).collect()
}
