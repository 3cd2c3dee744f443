//! Which parameters the logs separate, by the covariance: the direction that they tell least about, what each
//! run carries, which run spoils what, and which to add.

mod direction;
mod judged;
mod run_to_add;
mod runs;
pub(crate) mod thresholds;
mod words;

use nalgebra::DMatrix;

pub use direction::{Direction, DirectionPart};
use judged::Judged;
pub use run_to_add::RunToAdd;
pub use runs::{Carried, RunShare};

use crate::identify::findings::{Finding, MovedParameter, rows};
use crate::identify::found_arm::ArmSource;
use crate::identify::judge::{Chosen, Evidence, Methods, slip_phase_terms};
use crate::identify::separability::thresholds::ALL_SHARP;
use crate::information::ArmParameter;
use crate::record::Campaign;

/// A parameter beside the others. Standard errors are shares of its [size](ArmParameter::size).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ParameterCertainty {
    /// Which.
    pub parameter: ArmParameter,
    /// Whether its estimate is given; the standard error of a refused one is that of the rejected value.
    pub given: bool,
    /// Its standard error; infinite where the logs do not tell it from others.
    pub std: f64,
    /// The standard error that it would have if the other parameters were known.
    pub alone: f64,
}

/// What the logs separate.
///
/// The covariance is the one that the parameters' standard errors are from, each parameter in shares of its own
/// size: F = S⁻¹·G·C·Gᵀ·S⁻¹ with C the parameters' covariance, G the parameters' slopes, S the sizes. The
/// standard error of `alone` is 1/√(F⁻¹)_ii.
#[derive(Debug, Clone, PartialEq)]
pub struct Separability {
    /// The method whose covariance it is.
    pub source: ArmSource,
    /// Every parameter; empty where no method has a covariance of those that stand.
    pub parameters: Vec<ParameterCertainty>,
    /// Correlation of the estimates of the parameters, of a damping as damping ratio; NaN where a parameter cannot be told
    /// from others. The covariance of two estimates is this times their standard errors.
    pub correlation: DMatrix<f64>,
    /// Condition of the parameters' correlation matrix; infinite where some cannot be told apart.
    pub condition: f64,
    /// The principal directions of F, least known first.
    pub directions: Vec<Direction>,
    /// What each run carries, of an output error that stands on two runs or more, else of a regression on three or more.
    pub runs: Vec<RunShare>,
    /// The further run that would say most about the parameter that leads the first direction; `None` where
    /// all are sharp, without an output error that stands, or where no run tried would help.
    pub run_to_add: Option<RunToAdd>,
    /// Codes of the findings that say that the arm is not all there is: standard errors do not count what is missing.
    pub doubted_by: Vec<&'static str>,
}

/// Whether a finding says so.
fn doubts(finding: &Finding) -> bool {
    let doubting = [
        rows::ReplayDeparts::CODE,
        rows::MoreThanNoise::CODE,
        rows::ModesMissing::CODE,
        rows::DamperDrives::CODE,
        rows::MissingTerm::CODE,
        rows::UnexplainedTorque::CODE,
        rows::OthersDoubtful::CODE,
    ];
    doubting.contains(&finding.code())
}

impl Separability {
    /// Of the solution that was taken.
    pub(super) fn of(
        evidence: &Evidence<'_>,
        chosen: &Chosen,
        findings: &[Finding],
    ) -> Option<Self> {
        // No estimate is given then: there is nothing to judge.
        if findings.iter().any(Finding::is::<rows::CommandSign>) {
            return None;
        }
        let (methods, used) = (evidence.methods, evidence.used);
        let replay = methods.output_error.as_ref().filter(|oe| oe.stands());
        let by_replay = methods.output_error.as_ref().map(|oe| {
            let judged = Judged::of_replay(oe, used);
            let runs = runs::shares(&judged, &oe.by_run, used);
            (judged, runs)
        });
        let (source, judged, runs) = match by_replay {
            Some((judged, runs)) if replay.is_some() => (ArmSource::OutputError, judged, runs),
            by_replay => {
                let judged = of_regression(methods, chosen);
                let runs = by_regression(methods, used);
                // Tips that the motor's equation does not see are seen by a replay that does not stand, too.
                let clear = runs.iter().any(RunShare::spoils);
                let replayed = by_replay.map(|(_, runs)| runs).filter(|_| !clear);
                (ArmSource::Regression, judged, replayed.unwrap_or(runs))
            }
        };
        let covariance = &judged.covariance;
        let mut directions = direction::lost(&judged);
        directions.extend(direction::of(&judged.parameters, covariance));
        let found = Self {
            source,
            parameters: judged.known(),
            correlation: judged.correlation(),
            condition: judged.condition(),
            run_to_add: replay.and_then(|oe| {
                RunToAdd::of(oe, used, &judged, directions.first().filter(|d| d.std > ALL_SHARP)?)
            }),
            directions,
            runs,
            doubted_by: findings.iter().filter(|f| doubts(f)).map(Finding::code).collect(),
        };
        (!found.parameters.is_empty() || !found.runs.is_empty()).then_some(found)
    }

    /// Whether every parameter is known to 1 % or better.
    pub fn is_sharp(&self) -> bool {
        self.parameters.iter().all(|f| f.std <= ALL_SHARP)
    }

    /// The run that fits the others least, where it does not fit. One at a time: it is in the parameters that
    /// all others are compared with.
    pub fn stands_out(&self) -> Option<&RunShare> {
        let spoil = self.runs.iter().filter(|run| run.spoils());
        spoil.max_by(|a, b| a.residual.total_cmp(&b.residual))
    }

    /// The run that does not fit the others, as a finding.
    pub(super) fn finding(&self) -> Option<Finding> {
        let run = self.stands_out()?;
        let moved = run.moved().map(|c| MovedParameter {
            parameter: c.parameter,
            change_share: c.change,
            change_standard_errors: c.standard_errors,
        });
        let found = rows::RunStandsOut {
            residual_ratio: run.residual,
            moved: moved.collect(),
            others_described: self.source == ArmSource::OutputError,
        };
        Some(Finding::of_run(&run.run, found))
    }
}

/// Of the regression that was taken; empty where another method was, which has no covariance of its own.
fn of_regression(methods: &Methods, chosen: &Chosen) -> Judged {
    let regression = methods.regression.as_ref();
    let law = methods.friction_law.as_ref();
    let terms = chosen.method.and_then(|method| slip_phase_terms(method, regression, law));
    terms.map_or_else(Judged::none, |terms| Judged::of_regression(terms, &chosen.drive))
}

/// What each run carries of the regression with one viscous coefficient, whichever fit was taken.
fn by_regression(methods: &Methods, used: &Campaign) -> Vec<RunShare> {
    let Some(fit) = methods.regression.as_ref() else { return Vec::new() };
    let judged = Judged::of_regression(&fit.terms, &fit.estimates());
    runs::shares_of_regression(&judged, fit, used)
}
