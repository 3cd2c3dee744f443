//! Estimates that the data do not support are taken back.

use crate::identify::drive_estimates::Method;
use crate::identify::estimate::Estimate;
use crate::identify::findings::{EstimateUnits, Finding, JudgedParameter, rows};
use crate::identify::judge::drive_table;
use crate::identify::judge::evidence::{Chosen, Evidence};
use crate::identify::judge::thresholds::UNCERTAIN_ERROR;
use crate::identify::thresholds::REFUSED_ERROR;

/// Takes back what the data do not support; the line is taken where it is known and the model of the table is not, unless that is
/// the arm of the output-error method.
pub(super) fn refuse_or_take_line(evidence: &Evidence<'_>, chosen: &mut Chosen) -> Vec<Finding> {
    let refused = refuse_the_unknown(evidence, chosen);
    let method = chosen.method.filter(|method| *method != Method::OutputError);
    let Some((method, parameter)) = method.zip(refused_parameter(chosen)) else {
        return refused;
    };
    for line in drive_table::lines(evidence, method) {
        let mut by_line = Chosen::of(evidence, line);
        let doubts = refuse_the_unknown(evidence, &mut by_line);
        if refused_parameter(&by_line).is_none() {
            *chosen = by_line;
            let taken = rows::LineTaken { parameter, refused_by: method };
            return doubts.into_iter().chain([Finding::new(taken)]).collect();
        }
    }
    refused
}

/// The first parameter of the line that a solution does not give.
fn refused_parameter(chosen: &Chosen) -> Option<JudgedParameter> {
    let Chosen { drive, .. } = chosen;
    let given = [
        (JudgedParameter::Inertia, drive.inertia),
        (JudgedParameter::Coulomb, drive.friction.coulomb),
        (JudgedParameter::Viscous, drive.friction.viscous),
    ];
    given.into_iter().find(|(_, e)| e.is_none()).map(|(parameter, _)| parameter)
}

/// Estimates that are not known to their own size are taken back.
fn refuse_the_unknown(evidence: &Evidence<'_>, chosen: &mut Chosen) -> Vec<Finding> {
    let mut findings: Vec<Finding> = Vec::new();
    let regression = evidence.methods.regression.is_some();
    let Chosen { drive, beam, .. } = chosen;
    let units = EstimateUnits::new(&evidence.campaign.channels);
    let slope = drive.friction.viscous;
    let falls = slope.is_some_and(|viscous| viscous.is_negative());
    // The logs do not separate Coulomb friction: they show it in one direction at most, and then as one number
    // with a constant load.
    let one_direction = drive.friction.coulomb.is_none();
    let told = |e: &Estimate| one_direction && e.std < UNCERTAIN_ERROR * e.value.abs();
    let forward = drive.friction.forward.filter(told);
    let backward = drive.friction.backward.filter(told);
    let sum = forward.xor(backward);
    let mut look = |parameter: JudgedParameter, given: &mut Option<Estimate>| {
        let Some(estimate) = *given else {
            // Without a regression one refusal of all of it is enough.
            if regression && !(sum.is_some() && parameter == JudgedParameter::Coulomb) {
                findings.push(rows::NotSeparable { parameter }.into());
            }
            return;
        };
        let Estimate { value, std } = estimate;
        let share = if value == 0.0 { f64::INFINITY } else { std / value.abs() };
        let refused = share > REFUSED_ERROR || share.is_nan() || value < 0.0;
        if estimate.is_negative() {
            findings.push(rows::NegativeEstimate { parameter, estimate, units }.into());
            *given = None;
        } else if refused || share > UNCERTAIN_ERROR {
            findings.push(rows::PoorExcitation { parameter, estimate, units, refused }.into());
            *given = given.filter(|_| !refused);
        }
    };
    look(JudgedParameter::Coulomb, &mut drive.friction.coulomb);
    look(JudgedParameter::Viscous, &mut drive.friction.viscous);
    look(JudgedParameter::Inertia, &mut drive.inertia);
    if !beam.coupling_by_tip.is_empty() || beam.coupling.is_some() {
        look(JudgedParameter::Coupling, &mut beam.coupling);
    }
    if findings.iter().any(Finding::is::<rows::NegativeEstimate>) {
        findings.push(rows::OthersDoubtful {}.into());
    }
    // Coulomb friction is the intercept of the slope. What the log shows is a curve that falls with speed.
    if falls {
        drive.inertia = drive.inertia.filter(|_| drive.friction.law.is_some());
        let speed = evidence.methods.friction_law.as_ref().map(|law| law.motion.mean_speed());
        let line = drive.friction.coulomb.take().zip(slope).zip(speed);
        findings.extend(line.map(|((coulomb, slope), speed)| {
            Finding::new(rows::FrictionFalls {
                speed,
                friction: coulomb.value + slope.value * speed,
                units,
            })
        }));
    }
    let friction = &mut drive.friction;
    if regression && friction.coulomb.is_some() && friction.offset.is_none() {
        findings.push(rows::NotSeparable { parameter: JudgedParameter::Offset }.into());
    }
    if friction.coulomb.is_none() {
        friction.offset = None;
        (friction.forward, friction.backward) = (forward, backward);
        if let Some(sum) = sum {
            let forward = forward.is_some();
            findings.push(rows::FrictionWithLoad { forward, sum, units }.into());
        }
    }
    findings
}
