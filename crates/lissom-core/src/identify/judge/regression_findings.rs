//! What speaks against the regression's estimates, in findings.

use crate::identify::drive_estimates::Method;
use crate::identify::estimate::Estimate;
use crate::identify::findings::{EstimateUnits, Finding, rows};
use crate::identify::gravity_estimate::{Gravity, torque_constant};
use crate::identify::judge::{Chosen, Evidence};
use crate::identify::methods::friction_law::{MissingKind, MissingTerm, ModelTerm, MovingTerm};
use crate::identify::methods::regression::MotorRegression;
use crate::identify::methods::regression::thresholds::{
    CONSTANT_DOUBTED, FEW_PHASES, GRAVITY_KNOWN, INERTIA_SHORT, USUAL_VARIATION,
};
use crate::identify::prepare::run_analysis::{RunAnalysis, RunKind};
use crate::identify::thresholds::{CLEARLY_PRESENT, SAME_FREQUENCY, UNEXPLAINED_TORQUE};
use crate::record::Run;

/// What speaks against the regression's estimates.
pub(crate) fn findings(evidence: &Evidence<'_>, chosen: &Chosen) -> Vec<Finding> {
    let units = EstimateUnits::new(&evidence.campaign.channels);
    let mut findings: Vec<Finding> =
        contradicted_constant(evidence, chosen, units).into_iter().collect();
    // The output-error method describes the runs: the residual of the regression does not count then.
    let explained = evidence.replay().is_some();
    let Some(r) = &evidence.methods.regression else {
        if explained {
            return findings;
        }
        // A load may be most of the torque.
        let gravity = |m: &MissingTerm| m.kind == MissingKind::Gravity;
        let missing = evidence.methods.missing.iter().copied().find(gravity);
        let term = |term| Finding::new(rows::MissingTerm { term, units });
        findings.extend(missing.map(term));
        let residual_share = evidence.methods.regression_residual;
        let explained = missing.is_some();
        let by_least_squares = chosen.method == Some(Method::LeastSquares);
        let refused = rows::RegressionRefused { residual_share, explained, by_least_squares };
        findings.push(Finding::new(refused));
        return findings;
    };
    if r.phases < FEW_PHASES && !explained {
        let variation = (chosen.method == Some(Method::Regression)).then_some(USUAL_VARIATION);
        findings.push(Finding::new(rows::FewPhases { phases: r.phases, variation }));
    }
    let residual_share = left_by_chosen(evidence, chosen).unwrap_or(r.relative_residual);
    if residual_share > UNEXPLAINED_TORQUE && !explained {
        findings.push(Finding::new(rows::UnexplainedTorque { residual_share }));
    }
    let given = !explained && chosen.drive.inertia.is_some();
    if let Some(short_by) = r.inertia_short_by.filter(|share| given && *share > INERTIA_SHORT) {
        findings.push(Finding::new(rows::InertiaShort { short_by }));
    }
    findings.extend(gravity_pairs(evidence, r, chosen));
    if !explained && is_one_sine(evidence.runs, r) {
        findings.push(Finding::new(rows::OneSine {}));
    }
    let law = evidence.methods.friction_law.as_ref();
    let departs = law.is_some_and(|law| law.chosen.departs());
    if let Some(lag) = law.and_then(|law| law.lag).filter(|_| !explained) {
        findings.push(Finding::new(rows::AngleLag { lag }));
    }
    if let Some(mode) = r.mode.filter(|_| !explained) {
        findings.push(Finding::new(rows::HiddenMode { mode }));
    }
    for term in evidence.methods.missing.iter().filter(|_| !explained) {
        findings.push(Finding::new(rows::MissingTerm { term: *term, units }));
    }
    if chosen.method == Some(Method::Regression) {
        let told = |m: &MovingTerm| {
            !evidence
                .methods
                .missing
                .iter()
                .any(|missing| ModelTerm::Missing(missing.kind) == m.term)
        };
        let possible = |term| Finding::new(rows::PossibleTerm { term });
        findings.extend(r.moving().filter(told).map(possible));
    }
    let simple = !explained && !departs && evidence.methods.missing.is_empty();
    if let Some(by) = r.varies_by().filter(|_| simple) {
        findings.push(Finding::new(rows::FrictionVaries { by }));
    }
    findings
}

/// Share of the torque that the fit which was taken leaves, in its own windows.
fn left_by_chosen(evidence: &Evidence<'_>, chosen: &Chosen) -> Option<f64> {
    let methods = evidence.methods;
    let regression = methods.regression.as_ref();
    Some(match chosen.method? {
        Method::FrictionLaw => methods.friction_law.as_ref()?.relative_residual[1],
        Method::LeastSquares => methods.least_squares.as_ref()?.relative_residual,
        _ => regression?.relative_residual,
    })
}

/// A torque constant that the load's known m·g·l contradicts.
fn contradicted_constant(
    evidence: &Evidence<'_>,
    chosen: &Chosen,
    units: EstimateUnits,
) -> Option<Finding> {
    let campaign = evidence.campaign;
    let given = campaign.channels.command.torque_per_command?;
    let by_gravity = torque_constant(campaign, chosen.drive.gravity)?;
    let apart = (by_gravity.value - given).abs();
    let contradicts = apart > CLEARLY_PRESENT * by_gravity.std && apart > CONSTANT_DOUBTED * given;
    contradicts.then(|| Finding::new(rows::TorqueConstant { by_gravity, given, units }))
}

/// What gravity can hardly be told from.
fn gravity_pairs(evidence: &Evidence<'_>, r: &MotorRegression, chosen: &Chosen) -> Vec<Finding> {
    let Some(gravity) = r.gravity else { return Vec::new() };
    let known = |g: Gravity| {
        let (amplitude, phase) = (g.amplitude(), g.phase_rad());
        amplitude.std < GRAVITY_KNOWN * amplitude.value && phase.std < GRAVITY_KNOWN
    };
    if chosen.drive.gravity.is_some_and(known) {
        return Vec::new();
    }
    let angles = evidence.used.runs.iter().flat_map(Run::motor);
    let (sum, count) = angles.fold((0.0, 0.0), |(sum, count), q| (sum + q, count + 1.0));
    let pairs = r.terms.pairs_with_gravity(sum / count, gravity.amplitude().value);
    let finding =
        |(with, correlation)| Finding::new(rows::GravityUnseparated { with, correlation });
    pairs.into_iter().map(finding).collect()
}

/// A tip whose sign looks reversed, by the solution that is given.
pub(crate) fn reversed_tip(chosen: &Chosen) -> Option<Finding> {
    let coupling = || chosen.solution.coupling_by_tip.iter().flatten();
    let negative = coupling().any(Estimate::is_negative);
    let alone = coupling().count() == 1;
    (negative && alone).then(|| Finding::new(rows::CouplingSign {}))
}

/// Whether there is a beam, and all runs that are used are a sine of one frequency.
fn is_one_sine(runs: &[RunAnalysis], regression: &MotorRegression) -> bool {
    let omega = |run: &RunAnalysis| match &run.kind {
        RunKind::Sinusoidal(sine) => Some(sine.omega_rad_s),
        RunKind::ConstantVelocity | RunKind::General => None,
    };
    let used = || runs.iter().filter(|run| run.usable).map(omega);
    let Some(Some(first)) = used().next() else { return false };
    let alike =
        |omega: Option<f64>| omega.is_some_and(|w| (w / first - 1.0).abs() < SAME_FREQUENCY);
    regression.coupling.iter().any(Option::is_some) && used().all(alike)
}
