//! Compares the result of a drive with the truth.

use lissom::identify::findings::{Finding, Severity, rows};
use lissom::identify::{Estimate, Identified, Method};

use super::drive_campaign::DriveCampaign;
use super::drive_parameter::DriveParameter;
use super::friction_line::{FrictionLine, LineOf};
use super::torque_bound::TorqueBound;

/// Error, in standard errors, above which a parameter is wrong.
pub(crate) const WRONG: f64 = 5.0;
/// Loads below this share of Coulomb friction are not compared, because they are negligible.
const LOAD_LEAST: f64 = 0.05;
/// The finding that friction has a law with further terms.
pub(crate) const FRICTION_LAW: &str = "friction-law";

/// One parameter of one campaign.
#[derive(Debug, Clone, PartialEq)]
pub struct ParameterScore {
    /// The parameter.
    pub parameter: DriveParameter,
    /// Its true value.
    pub truth: f64,
    /// The same with the wander of friction in these runs.
    pub truth_as_fell: f64,
    /// The estimate; `None`: refused.
    pub estimate: Option<Estimate>,
    /// Codes of the warnings and refusals that affect it.
    pub warned_by: Vec<&'static str>,
    /// The smallest possible standard error; `None` if the motion does not determine the parameter.
    pub bound: Option<f64>,
}

impl ParameterScore {
    /// The bound relative to the true value \[1\].
    pub fn bound_share(&self) -> Option<f64> {
        self.bound.map(|bound| bound / self.truth.abs())
    }

    /// Given without a warning.
    pub fn vouched(&self) -> bool {
        self.estimate.is_some() && self.warned_by.is_empty()
    }

    /// The same, but `friction-law` does not count as a warning: it reports that the friction law has further terms.
    pub fn vouched_but_for_law(&self) -> bool {
        self.estimate.is_some() && self.warned_by.iter().all(|code| *code == FRICTION_LAW)
    }

    /// Its standard error divided by the bound.
    pub fn over_bound(&self) -> Option<f64> {
        Some(self.estimate?.std / self.bound?)
    }

    /// More than five standard errors off.
    pub fn is_wrong(&self) -> bool {
        // An error that is NaN is as wrong as a large one.
        self.standard_errors().is_some_and(|d| d.is_nan() || d.abs() > WRONG)
    }

    /// Signed error in standard errors.
    pub fn standard_errors(&self) -> Option<f64> {
        self.estimate.map(|e| (e.value - self.truth) / e.std)
    }

    /// Signed relative error.
    pub fn error(&self) -> Option<f64> {
        self.estimate.map(|e| (e.value - self.truth) / self.truth.abs())
    }

    /// Whether the 95 % interval contains the true value.
    pub fn covers(&self) -> Option<bool> {
        self.estimate.map(|e| {
            let [low, high] = e.ci95();
            (low..=high).contains(&self.truth)
        })
    }

    /// Whether the 95 % interval contains the true value with the wander of friction in these runs.
    pub fn covers_as_fell(&self) -> Option<bool> {
        self.estimate.map(|e| {
            let [low, high] = e.ci95();
            (low..=high).contains(&self.truth_as_fell)
        })
    }

    /// More than five standard errors off, without a warning.
    pub fn silently_wrong(&self) -> bool {
        self.vouched() && self.is_wrong()
    }
}

/// The parts of a finding that are used here.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FoundCode {
    /// Its code.
    pub code: &'static str,
    /// Its severity.
    pub severity: Severity,
    /// The difference between findings with the same code: the missing term, or the terms of the law; empty for others.
    pub detail: String,
    /// Its message.
    pub message: String,
}

impl FoundCode {
    /// Code and detail.
    pub fn label(&self) -> String {
        if self.detail.is_empty() {
            return self.code.to_owned();
        }
        format!("{} ({})", self.code, self.detail)
    }

    /// Whether it is a warning or a refusal.
    pub fn warns(&self) -> bool {
        self.severity >= Severity::Warning
    }
}

/// All scores of one campaign.
#[derive(Debug, Clone, PartialEq)]
pub struct DriveScore {
    /// The parameters that the campaign has.
    pub parameters: Vec<ParameterScore>,
    /// All findings, in the result's order.
    pub findings: Vec<FoundCode>,
    /// The method that gave the parameters.
    pub method: Option<&'static str>,
}

impl DriveScore {
    /// The finding that a user reads first: causes come before their consequences.
    pub fn first(&self) -> Option<&FoundCode> {
        self.findings.first()
    }

    /// Whether there is a warning or a refusal.
    pub fn warns(&self) -> bool {
        self.findings.iter().any(FoundCode::warns)
    }
}

/// Compares a result with the truth of its campaign.
///
/// Coulomb and viscous friction of a result are a straight line over the speeds of the logs; they are compared with the
/// least-squares line of the true friction, without ripple where the result has ripple as a term.
///
/// Inertia is that of all rotating parts. If the result has a mode that was found in the motion of the motor
/// (`hidden-mode`), its inertia is that of the motor alone, and is compared with that.
pub fn score_drive(campaign: &DriveCampaign, id: &Identified) -> DriveScore {
    let bound = TorqueBound::of(campaign);
    let ripple = id.friction.law.as_ref().is_none_or(|law| law.ripples.is_empty());
    let [law, fell] =
        [false, true].map(|wander| FrictionLine::of(campaign, LineOf { ripple, wander }));
    let one = |parameter: DriveParameter, [truth, truth_as_fell]: [f64; 2], estimate| {
        let names = |f: &&Finding| {
            f.severity() >= Severity::Warning && f.affects().contains(&parameter.key())
        };
        ParameterScore {
            parameter,
            truth,
            truth_as_fell,
            estimate,
            warned_by: id.findings.iter().filter(names).map(Finding::code).collect(),
            bound: bound.as_ref().and_then(|b| b.std(parameter)),
        }
    };
    let friction = &id.friction;
    let numbers = &campaign.numbers;
    let fixed = |value: f64| [value, value];
    let of_motor = campaign.effects.unseen_mode.filter(|_| !id.beam.modes.is_empty());
    let inertia = numbers.inertia_kg_m2 / (1.0 + of_motor.map_or(0.0, |m| m.inertia_ratio));
    let mut parameters = vec![
        one(DriveParameter::Coulomb, [law.coulomb_nm, fell.coulomb_nm], friction.coulomb),
        one(
            DriveParameter::Viscous,
            [law.viscous_nm_s_per_rad, fell.viscous_nm_s_per_rad],
            friction.viscous,
        ),
        one(DriveParameter::Inertia, fixed(inertia), id.inertia),
    ];
    if campaign.declares_gravity() {
        let amplitude = id.gravity.map(|g| g.amplitude());
        parameters.push(one(DriveParameter::Gravity, fixed(numbers.gravity_nm), amplitude));
    }
    if numbers.load_nm.abs() >= LOAD_LEAST * numbers.coulomb_nm {
        parameters.push(one(DriveParameter::Load, fixed(numbers.load_nm), friction.offset));
    }
    let found = |f: &Finding| FoundCode {
        code: f.code(),
        severity: f.severity(),
        detail: detail(f),
        message: f.message(),
    };
    DriveScore {
        parameters,
        findings: id.findings.iter().map(found).collect(),
        method: id.method.map(Method::name),
    }
}

/// The difference between findings with the same code.
fn detail(finding: &Finding) -> String {
    // The name of a variant, without its numbers.
    let name = |text: String| text.split([' ', '{', '(']).next().unwrap_or_default().to_owned();
    if let Some(rows::MissingTerm { term, .. }) = finding.get() {
        return name(format!("{:?}", term.kind));
    }
    if let Some(rows::AngleLag { lag }) = finding.get() {
        return name(format!("{:?}", lag.shape));
    }
    let law = finding.get::<rows::FrictionLaw>().map_or(&[][..], |law| &law.terms);
    law.iter().map(|(term, _)| name(format!("{term:?}"))).collect::<Vec<_>>().join(" + ")
}
