//! What the regression's figures are worth, in findings.

use crate::identify::drive_estimates::Method;
use crate::identify::estimate::Estimate;
use crate::identify::finding::{Finding, Severity, key};
use crate::identify::judge::{Chosen, Evidence};
use crate::identify::methods::friction_law::FrictionLaw;
use crate::identify::methods::regression::missing::{MissingKind, MissingTerm};
use crate::identify::methods::regression::motor::{ByDirection, MotorRegression};
use crate::identify::prepare::run_analysis::{RunAnalysis, RunKind};
use crate::identify::thresholds::{SAME_FREQUENCY, UNEXPLAINED_TORQUE};

/// What speaks against the regression's figures.
pub(crate) fn findings(evidence: &Evidence<'_>, chosen: &Chosen) -> Vec<Finding> {
    let mut findings = Vec::new();
    let everything = [key::COULOMB, key::VISCOUS, key::INERTIA, key::COUPLING];
    // The replay explains the runs: what is left of the regression says nothing then.
    let explained = evidence.replay().is_some();
    let Some(r) = &evidence.methods.regression else {
        if chosen.method == Some(Method::LeastSquares) {
            findings.push(few_phases());
            return findings;
        }
        if explained {
            return findings;
        }
        let message = match evidence.methods.regression_residual {
            Some(residual) => format!(
                "the motor's equation leaves {:.0} % of the windowed torque: no figure of it stands",
                100.0 * residual
            ),
            None => "too few slip phases are long enough for a window".to_owned(),
        };
        let hint = "longer moves in both directions at a measured current; a flexible beam needs its tip \
                    measured; check columns, units and signs";
        findings.push(Finding::new(
            "regression-refused",
            Severity::Refusal,
            &everything,
            message,
            hint,
        ));
        return findings;
    };
    if r.relative_residual > UNEXPLAINED_TORQUE && !explained {
        findings.push(Finding::new(
            "unexplained-torque",
            Severity::Warning,
            &everything,
            format!(
                "the motor's equation leaves {:.0} % of the windowed torque",
                100.0 * r.relative_residual
            ),
            "a delay, a load, other friction or a flexible mode without a tip; check units and signs",
        ));
    }
    if !explained && is_one_sine(evidence.runs, r) {
        findings.push(one_sine());
    }
    // A law of friction that was chosen says more than the one term that was tried for it.
    let law = evidence.methods.friction_law.as_ref().filter(|law| law.chosen.departs());
    let said = |m: &MissingTerm| match m.kind {
        MissingKind::Delay => law.is_some_and(FrictionLaw::leaves_no_lag),
        MissingKind::Position
        | MissingKind::BeamDamping
        | MissingKind::CommandBySign
        | MissingKind::CoulombDrift
        | MissingKind::ViscousDrift => false,
        MissingKind::Stribeck => law.is_some(),
    };
    if let Some(m) = r.missing.filter(|m| !explained && !said(m)) {
        let (what, hint) = in_words(&m);
        findings.push(Finding::new(
            "missing-term",
            Severity::Warning,
            &everything,
            format!(
                "it looks as if {what} ({:.0} deviations; the residual falls to {:.1} % of itself): the figures take it up \
                 and are off by more than they say",
                m.deviations,
                100.0 * m.residual_ratio
            ),
            hint,
        ));
    }
    let split = r.viscous_by_direction.as_ref().filter(|_| !explained);
    findings.extend(split.and_then(|d| differs_by_direction(r, d)));
    findings
}

/// Viscous friction that differs by direction.
fn differs_by_direction(r: &MotorRegression, d: &ByDirection) -> Option<Finding> {
    let (forward, backward) = d.estimates.friction.viscous_by_direction?;
    Some(Finding::new(
        "viscous-by-direction",
        Severity::Warning,
        &[key::VISCOUS, key::OFFSET],
        format!(
            "viscous friction differs by direction: {:.4e} forward, {:.4e} backward; the \
             residual falls from {:.1} % to {:.1} %, and of the offset {:.4e} is left",
            forward.value,
            backward.value,
            100.0 * r.relative_residual,
            100.0 * d.relative_residual,
            d.estimates.friction.offset?.value
        ),
        "the scalar figure is the mean of both; the offset depends on which law is taken",
    ))
}

/// A tip whose sign looks reversed.
pub(crate) fn reversed_tip(evidence: &Evidence<'_>) -> Option<Finding> {
    let r = evidence.methods.regression.as_ref()?;
    let negative = r.coupling.iter().flatten().any(Estimate::is_negative);
    (negative && r.coupling.iter().flatten().count() == 1).then(|| {
        Finding::new(
            "coupling-sign",
            Severity::Refusal,
            &[key::COUPLING, key::MODES],
            "the beam would push the motor away from itself: the tip's sign looks reversed"
                .to_owned(),
            "give the tip a negative scale in the campaign",
        )
    })
}

/// Least squares stand in: standard errors rest on the scatter from phase to phase.
fn few_phases() -> Finding {
    Finding::new(
        "few-phases",
        Severity::Warning,
        &[key::COULOMB, key::VISCOUS, key::INERTIA, key::COUPLING],
        "the motor turns back too seldom to show how friction scatters from one stroke to the next: the estimates are \
         those of ordinary least squares, and their standard errors are rough"
            .to_owned(),
        "log four strokes or more in each direction",
    )
}

fn one_sine() -> Finding {
    Finding::new(
        "one-sine",
        Severity::Warning,
        &[key::COULOMB, key::VISCOUS, key::INERTIA, key::COUPLING, key::MODES],
        "all runs are a sine of one frequency: motor and beam then act alike but for what friction puts into the \
         harmonics, and what is off is so in every period alike: figures may be off by more than they say"
            .to_owned(),
        "leave out --quick, or add a run at another frequency",
    )
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

/// A term that is missing, and what to do about it.
fn in_words(m: &MissingTerm) -> (String, &'static str) {
    match m.kind {
        MissingKind::Delay => (
            format!(
                "the command acts {:.2} ms {} than it is logged",
                1e3 * m.value.abs(),
                if m.value < 0.0 { "earlier" } else { "later" }
            ),
            "shift the channels against each other, or log the current where it is measured",
        ),
        MissingKind::Position => (
            format!("a torque grows with position, {:.3e} per unit", m.value),
            "gravity, a spring, cogging or a wrongly scaled tip: the equation has no such term",
        ),
        MissingKind::Stribeck => (
            format!("friction changes with speed, by {:.3e} towards rest", m.value),
            "Stribeck friction or presliding: one constant and one slope do not describe it",
        ),
        MissingKind::BeamDamping => (
            format!(
                "the beam is damped within itself, by {:.2} ms times its stiffness",
                1e3 * m.value
            ),
            "slip phases know no such damping: the output error does (leave out --quick)",
        ),
        MissingKind::CommandBySign => (
            format!(
                "positive commands give {:.1} % {} torque than negative ones",
                200.0 * m.value.abs(),
                if m.value > 0.0 { "more" } else { "less" }
            ),
            "an amplifier that is stronger one way, or a current sensor of two gains: log the current itself, and \
             calibrate it in both directions",
        ),
        MissingKind::CoulombDrift => (
            format!(
                "Coulomb friction changes by {:.3e} from the campaign's beginning to its end",
                m.value
            ),
            "a joint that warms, wears or is lubricated anew: let it run warm first, or identify runs apart",
        ),
        MissingKind::ViscousDrift => (
            format!(
                "viscous friction changes by {:.3e} from the campaign's beginning to its end",
                m.value
            ),
            "a joint that warms: let it run warm first, or identify runs apart",
        ),
    }
}
