//! From the methods' solutions to the estimates of the result and the findings about them.

use crate::identify::drive_estimates::{DriveEstimates, Method};
use crate::identify::findings::{Finding, is_cause, rank, rows};
use crate::identify::found_arm::FoundArm;
use crate::identify::judge::evidence::{Chosen, Evidence};
use crate::identify::judge::{
    beam_choice, constant_velocity_findings, drive_table, friction_law_findings,
    output_error_findings, regression_findings, remarks, unknown,
};
use crate::identify::methods::regression;
use crate::identify::separability::Separability;

/// What the result states.
pub(crate) struct Conclusion {
    pub(crate) chosen: Chosen,
    pub(crate) separability: Option<Separability>,
    pub(crate) arm: Option<FoundArm>,
    pub(crate) findings: Vec<Finding>,
}

/// Takes whole solutions by the tables, refuses what the data do not support, and says what speaks against the rest.
/// `findings` are those about the runs.
pub(crate) fn conclude(evidence: &Evidence<'_>, mut findings: Vec<Finding>) -> Conclusion {
    let reversed = reversed_command(evidence);
    findings.extend(reversed.then(|| Finding::new(rows::CommandSign {})));
    findings.extend(output_error_findings::findings(evidence));
    let mut chosen = Chosen::of(evidence, drive_table::choose(evidence));
    let refused = if reversed {
        // No torque is right, and none needs a refusal of its own.
        chosen.drive = DriveEstimates::default();
        chosen.beam.coupling = None;
        chosen.beam.coupling_by_tip.fill(None);
        Vec::new()
    } else {
        unknown::refuse_or_take_line(evidence, &mut chosen)
    };
    let alone = evidence.rests_on_constant_velocities();
    findings.extend(lag_of_response(evidence, &chosen));
    if alone {
        findings.push(constant_velocity_findings::only_constant_velocities(evidence.campaign));
    }
    findings.extend(constant_velocity_findings::taken(evidence, &chosen));
    findings.extend(beam_choice::findings(evidence, &chosen.beam));
    findings.extend(refused);
    findings.extend(remarks::of_friction(evidence, &chosen));
    findings.extend(friction_law_findings::finding(evidence));
    if !alone {
        findings.splice(0..0, regression_findings::reversed_tip(&chosen));
        findings.extend(regression_findings::findings(evidence, &chosen));
    }
    findings.extend(remarks::remarks(evidence, &chosen));
    let separability = Separability::of(evidence, &chosen, &findings);
    // Friction that varies makes runs differ, and one that differs makes it vary; so does a mode that the arm of the replay has not.
    let differ = |r: &regression::MotorRegression| {
        r.mode.is_some()
            || r.varies_by().is_some() && regression::unlike_others(&r.beside_others).is_none()
    };
    let differ = evidence.methods.regression.as_ref().is_some_and(differ);
    findings.extend(separability.as_ref().filter(|_| !differ).and_then(Separability::finding));
    let arm = FoundArm::of(evidence, &chosen);
    let left = arm.as_ref().filter(|arm| !arm.holds()).and_then(|arm| arm.torque_used);
    findings.extend(left.map(|left| {
        let residual_share = left.relative_error;
        Finding::new(rows::ArmNotGiven { residual_share })
    }));
    let arm = arm.filter(FoundArm::holds);
    // A cause comes before what follows from it.
    let order = |f: &Finding| (!is_cause(f), std::cmp::Reverse(f.severity()), rank(f));
    findings.sort_by_key(order);
    Conclusion { chosen, separability, arm, findings }
}

/// Whether the sign of the command is reversed against the motor's.
fn reversed_command(evidence: &Evidence<'_>) -> bool {
    let Some(r) = evidence.methods.regression.as_ref() else { return false };
    [r.inertia, r.coulomb].iter().all(|e| e.is_some_and(|e| e.is_negative()))
}

/// A delay that the motor's response shows, where its model is taken.
fn lag_of_response(evidence: &Evidence<'_>, chosen: &Chosen) -> Option<Finding> {
    let model = evidence.methods.motor_model.as_ref()?;
    let taken = chosen.method == Some(Method::FrequencyResponse);
    taken.then(|| Some(output_error_findings::command_lag(evidence.campaign, model.delay_s?)))?
}
