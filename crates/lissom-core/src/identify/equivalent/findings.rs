//! Findings about an equivalent arm.

use crate::identify::equivalent::data::{Equivalent, EquivalentData, StdSource};
use crate::identify::equivalent::equivalent_arm::EquivalentArm;
use crate::identify::equivalent::equivalent_error::EquivalentError;
use crate::identify::equivalent::thresholds::{
    ERRORS_TOO_LARGE, GIVEN_TO_LAST_MODE, MISFIT, MOTOR_LEFT, MOTOR_WORSE,
};
use crate::identify::estimate::Estimate;
use crate::identify::findings::{Finding, rows};
use crate::identify::responses::correct::Response;
use crate::identify::responses::rational::Damping;
use crate::identify::thresholds::CLEARLY_PRESENT;

/// Largest relative change of a gain in the form for use as an arm.
fn changed(whole: &Equivalent) -> f64 {
    let each = whole.beam.completed.iter().zip(&whole.beam.gains);
    each.map(|(used, fitted)| (used / fitted - 1.0).abs())
        .filter(|c| c.is_finite())
        .fold(0.0, f64::max)
}

/// Residual of the motor's response relative to the response, root mean square.
fn left_of_motor(data: &EquivalentData, arm: &EquivalentArm) -> f64 {
    let Some(motor) = &data.motor else { return 0.0 };
    let share = |(w, r): (&f64, &Response)| {
        (r.value - arm.motor_response(*w)).norm_sqr() / r.value.norm_sqr()
    };
    let shares = motor.omega_rad_s.iter().zip(&motor.response).map(share);
    (shares.sum::<f64>() / motor.response.len().max(1) as f64).sqrt()
}

/// Adds findings about how well the arm describes the motor's response.
fn of_motor(
    data: &EquivalentData,
    whole: &Equivalent,
    arm: &EquivalentArm,
    findings: &mut Vec<Finding>,
) {
    let (share, share_of_points) = (left_of_motor(data, arm), whole.relative_residual);
    let known = data.std_source != StdSource::FromResidual;
    let misfit = if known {
        arm.weighted_rms > MISFIT
    } else {
        share > MOTOR_LEFT && share > MOTOR_WORSE * share_of_points
    };
    if misfit && known {
        let rms_standard_errors = arm.weighted_rms;
        findings.push(rows::EquivalentMotorMisfit { rms_standard_errors }.into());
    } else if misfit {
        findings.push(rows::EquivalentMotorApart { share, share_of_points }.into());
    }
    if let Some(delay_s) = arm.delay_s {
        findings.push(rows::EquivalentMotorDelay { delay_s }.into());
    }
    if arm.friction_left.abs() > CLEARLY_PRESENT {
        let standard_errors = arm.friction_left.abs();
        findings.push(rows::EquivalentMotorFriction { standard_errors }.into());
    }
}

pub(super) fn findings(
    data: &EquivalentData,
    whole: &Equivalent,
    modes_found: usize,
    given: f64,
    no_torque: Option<EquivalentError>,
) -> Vec<Finding> {
    let mut findings: Vec<Finding> = Vec::new();
    for (pole, why) in whole.fit.poles.iter().zip(&whole.spurious) {
        let Some(reason) = *why else { continue };
        let omega_rad_s = pole.omega_rad_s;
        findings.push(rows::EquivalentSpuriousPole { omega_rad_s, reason }.into());
    }
    let modes = whole.modes.len();
    if modes < modes_found {
        let (kept, found) = (modes, modes_found);
        findings.push(rows::EquivalentModesLeftOut { kept, found }.into());
    }
    let unused = (0..data.names.len()).filter(|i| !whole.points.contains(i));
    let points: Vec<String> = unused.map(|i| data.names[i].clone()).collect();
    if !points.is_empty() {
        findings.push(rows::EquivalentPointsLeftOut { modes, points }.into());
    }
    of_phase(whole, &mut findings);
    let rms_standard_errors = whole.fit.weighted_rms;
    let known = data.std_source != StdSource::FromResidual;
    if known && rms_standard_errors > MISFIT {
        findings.push(rows::EquivalentMisfit { rms_standard_errors }.into());
    } else if data.std_source == StdSource::Measured && rms_standard_errors < ERRORS_TOO_LARGE {
        findings.push(rows::EquivalentErrorsLarge { rms_standard_errors }.into());
    }
    if let Some(arm) = &whole.arm {
        of_motor(data, whole, arm, &mut findings);
        let negative = named(arm).into_iter().filter(|(_, estimate)| estimate.is_negative());
        let parameters: Vec<String> = negative.map(|(name, _)| name).collect();
        if !parameters.is_empty() {
            findings.push(rows::EquivalentImplausible { parameters }.into());
        }
    }
    if let Some(error) = no_torque {
        findings.push(rows::EquivalentWithoutTorque { error }.into());
    }
    let (missing_gain, change_share) = (given, changed(whole));
    if whole.strainless.is_none() && given > 0.0 {
        findings.push(rows::EquivalentNoAngle { missing_gain }.into());
    } else if given > GIVEN_TO_LAST_MODE {
        findings.push(rows::EquivalentCompleted { missing_gain, change_share }.into());
    }
    findings
}

/// Adds findings about imaginary parts that the damping of the poles does not explain.
fn of_phase(whole: &Equivalent, findings: &mut Vec<Finding>) {
    for part in &whole.imaginary {
        let point = part.name.clone();
        let (share, standard_errors) = (part.share, part.standard_errors);
        findings.push(match part.delay_s {
            None => rows::EquivalentImaginaryPart { point, share, standard_errors }.into(),
            Some(delay_s) => rows::EquivalentDelay { point, delay_s }.into(),
        });
    }
    if whole.fit.damping == Damping::Within {
        let shares = (0..whole.kept.poles.len()).flat_map(|k| {
            let each = whole.kept.in_s.iter().zip(&whole.kept.static_gains);
            each.map(move |(terms, gains)| terms[k].value.abs() / gains[k].abs())
        });
        let outputs = 0..whole.fit.static_gains.len();
        findings.push(
            rows::EquivalentTermsInS {
                largest_share: shares.filter(|s| s.is_finite()).fold(0.0, f64::max),
                hidden_delay_s: outputs.map(|i| whole.fit.hidden_delay_s(i)).fold(0.0, f64::max),
            }
            .into(),
        );
    }
}

fn named(arm: &super::EquivalentArm) -> Vec<(String, Estimate)> {
    let coupling = arm.coupling.iter().enumerate();
    let coupling = coupling.map(|(k, c)| (format!("the coupling of mode {}", k + 1), *c));
    let motor =
        [("the inertia".to_owned(), arm.inertia), ("the viscous friction".to_owned(), arm.viscous)];
    motor.into_iter().chain(coupling).collect()
}
