//! What each run carries, and which does not fit the others.

use nalgebra::{DMatrix, DVector};

use crate::identify::methods::regression::{MotorRegression, RunLeftOut, unlike_others};
use crate::identify::output_error::ByRun;
use crate::identify::separability::judged::Judged;
use crate::identify::separability::thresholds::{RUN_CARRIES, RUN_MOVES, RUN_RESIDUAL};
use crate::identify::thresholds::PRESENT;
use crate::information::ArmParameter;
use crate::record::Campaign;

/// What a run says beside the others.
#[derive(Debug, Clone, PartialEq)]
pub struct RunShare {
    /// Its name.
    pub run: String,
    /// Root mean square of its residual over that of the others, at the parameters that these have without
    /// it.
    pub residual: f64,
    /// Whether the others' parameters do not describe it.
    pub unlike: bool,
    /// What it carries of each parameter.
    pub parameters: Vec<Carried>,
}

/// A parameter with and without a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Carried {
    /// Which.
    pub parameter: ArmParameter,
    /// Its standard error without the run over that with it; infinite where the others do not show it.
    pub growth: f64,
    /// By how much it would move without the run, to first order, in shares of its size…
    pub change: f64,
    /// …and in the standard errors that it has then.
    pub standard_errors: f64,
}

impl RunShare {
    /// Whether its residual is beyond that of the others and parameters move by it.
    pub fn spoils(&self) -> bool {
        self.unlike && self.moved().next().is_some()
    }

    /// Estimates that would be others without it.
    pub fn moved(&self) -> impl Iterator<Item = &Carried> {
        self.parameters
            .iter()
            .filter(|c| c.standard_errors.abs() > PRESENT && c.change.abs() > RUN_MOVES)
    }

    /// Estimates that are known from it above all.
    pub fn carries(&self) -> impl Iterator<Item = &Carried> {
        self.parameters.iter().filter(|c| c.growth > RUN_CARRIES)
    }
}

/// One for each run of two or more.
pub(super) fn shares(judged: &Judged, by_run: &ByRun, used: &Campaign) -> Vec<RunShare> {
    let all = by_run.covariance(&judged.slopes, None, None);
    let share = |run: usize| {
        let beside = by_run.beside_others(run)?;
        Some(RunShare {
            run: used.runs[run].name().to_owned(),
            residual: beside.residual,
            unlike: beside.residual > RUN_RESIDUAL,
            parameters: carried(judged, by_run, (run, beside.noise), &all),
        })
    };
    by_run.runs().filter_map(share).collect()
}

/// The same of a regression: each run beside the solution of the others.
pub(super) fn shares_of_regression(
    judged: &Judged,
    fit: &MotorRegression,
    used: &Campaign,
) -> Vec<RunShare> {
    // Without each run in turn the equation has no mode.
    if fit.mode.is_some() {
        return Vec::new();
    }
    let with = DVector::from_column_slice(&fit.terms.values);
    let unlike = unlike_others(&fit.beside_others).map(|found| found.run);
    let share = |left_out: &RunLeftOut| {
        let change = judged.slopes.tr_mul(&(&left_out.value - &with));
        let without = judged.slopes.tr_mul(&(&left_out.covariance * &judged.slopes));
        let of_parameter = |(i, parameter): (usize, &ArmParameter)| Carried {
            parameter: *parameter,
            growth: (without[(i, i)] / judged.covariance[(i, i)]).sqrt(),
            change: change[i],
            standard_errors: change[i] / without[(i, i)].sqrt(),
        };
        RunShare {
            run: used.runs[left_out.run].name().to_owned(),
            residual: left_out.residual,
            unlike: unlike == Some(left_out.run),
            parameters: judged.parameters.iter().enumerate().map(of_parameter).collect(),
        }
    };
    fit.left_out.iter().map(share).collect()
}

fn carried(
    judged: &Judged,
    by_run: &ByRun,
    (run, noise): (usize, f64),
    all: &DMatrix<f64>,
) -> Vec<Carried> {
    let without = by_run.covariance(&judged.slopes, Some(run), None);
    let change = by_run.change_without(&judged.slopes, run);
    let of_parameter = |(i, parameter): (usize, &ArmParameter)| Carried {
        parameter: *parameter,
        growth: (without[(i, i)] / all[(i, i)]).sqrt(),
        change: change[i],
        standard_errors: change[i] / (noise * without[(i, i)].sqrt()),
    };
    judged.parameters.iter().enumerate().map(of_parameter).collect()
}
