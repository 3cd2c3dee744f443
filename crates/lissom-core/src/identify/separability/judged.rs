//! Estimates with their covariance in shares of their sizes, from either method.

use nalgebra::{DMatrix, DVector};

use crate::identify::drive_estimates::DriveEstimates;
use crate::identify::estimate::Estimate;
use crate::identify::methods::regression::Terms;
use crate::identify::output_error::OutputError;
use crate::identify::separability::ParameterCertainty;
use crate::identify::separability::thresholds::LOST_SHARE;
use crate::information::{ArmParameter, correlation, inverse, slopes};
use crate::record::Campaign;
use crate::replay::ModalArm;

/// Differences for the slopes of parameters are taken over this many standard errors of a parameter.
const HALF: f64 = 0.5;

/// Estimates and their covariance.
pub(super) struct Judged {
    pub(super) parameters: Vec<ArmParameter>,
    /// Whether the estimate of each is given.
    given: Vec<bool>,
    /// ∂(parameter/size)/∂parameter, a column a parameter.
    pub(super) slopes: DMatrix<f64>,
    /// In shares of the sizes.
    pub(super) covariance: DMatrix<f64>,
    /// Correlation of the estimates as a result has them: a damping as a damping ratio.
    correlation: DMatrix<f64>,
    /// Changes of the parameters that the logs do not show, in shares of the sizes, of length one.
    pub(super) lost: Vec<DVector<f64>>,
}

impl Judged {
    /// The parameters that the output error moved.
    pub(super) fn of_replay(oe: &OutputError, used: &Campaign) -> Self {
        let back_emf = used.channels.command.back_emf_viscous;
        let arm = &oe.arm;
        // Modes that only the tips show are not given.
        let light = |p: &ArmParameter| match p {
            ArmParameter::Frequency(j) | ArmParameter::Damping(j) => {
                arm.modes[*j].stiffness_nm_per_rad == 0.0
            }
            _ => false,
        };
        let all = ArmParameter::of(arm).into_iter().filter(|p| !light(p));
        let all = all.chain([ArmParameter::Offset]);
        let (mut parameters, mut columns) = (Vec::new(), Vec::new());
        let mut of_estimates = Vec::new();
        for parameter in all {
            let size = match parameter {
                ArmParameter::Viscous => (parameter.value(arm) - back_emf).abs(),
                _ => parameter.size(arm),
            };
            let of = |a: &_| parameter.value(a) / size;
            let column = slopes(arm, &oe.parameters, &oe.covariance, HALF, of);
            let moved = column.iter().any(|s| *s != 0.0);
            if moved && column.iter().all(|s| s.is_finite()) {
                of_estimates.push(match parameter {
                    ArmParameter::Damping(j) => {
                        let ratio = |a: &ModalArm| a.damping_ratios()[j];
                        slopes(arm, &oe.parameters, &oe.covariance, HALF, ratio)
                    }
                    _ => column.clone(),
                });
                parameters.push(parameter);
                columns.push(column);
            }
        }
        let of = |columns: &[DVector<f64>]| {
            let slopes = matrix(oe.parameters.len(), columns);
            let covariance = slopes.tr_mul(&(&oe.covariance * &slopes));
            (slopes, covariance)
        };
        let (slopes, covariance) = of(&columns);
        let correlation = correlation(&of(&of_estimates).1);
        let given = vec![true; parameters.len()];
        Self { parameters, given, slopes, covariance, correlation, lost: Vec::new() }
    }

    /// Those of a regression in slip phases, with the standard errors that it states.
    pub(super) fn of_regression(terms: &Terms, drive: &DriveEstimates) -> Self {
        let values = &terms.values;
        let n = values.len();
        let couplings = terms.columns.couplings();
        let coupling: f64 = values[couplings.clone()].iter().sum();
        let friction = &drive.friction;
        let coulomb = values[2].abs();
        let all: [(ArmParameter, &[usize], f64, Option<Estimate>); 5] = [
            (ArmParameter::Coulomb, &[2], coulomb, friction.coulomb),
            (
                ArmParameter::Viscous,
                &[1],
                friction.viscous.map_or(values[1], |v| v.value).abs(),
                friction.viscous,
            ),
            (ArmParameter::Inertia, &[0], values[0].abs(), drive.inertia),
            (
                ArmParameter::Coupling,
                &couplings.collect::<Vec<_>>(),
                coupling.abs(),
                drive.coupling,
            ),
            (ArmParameter::Offset, &[3], coulomb, friction.offset),
        ];
        let all = all.iter().filter(|(_, places, size, _)| !places.is_empty() && *size > 0.0);
        let (mut parameters, mut columns, mut stated) = (Vec::new(), Vec::new(), Vec::new());
        for (parameter, places, size, estimate) in all {
            parameters.push(*parameter);
            columns.push(DVector::from_fn(
                n,
                |i, _| {
                    if places.contains(&i) { 1.0 / size } else { 0.0 }
                },
            ));
            stated.push(estimate.map(|e| e.std / size));
        }
        let slopes = matrix(n, &columns);
        let plain = slopes.tr_mul(&(&terms.covariance * &slopes));
        // What the choice of the window adds is in the stated standard errors alone.
        let stretch = |i: usize| stated[i].map_or(1.0, |s| s / plain[(i, i)].sqrt());
        let covariance = DMatrix::from_fn(plain.nrows(), plain.ncols(), |i, j| {
            plain[(i, j)] * stretch(i) * stretch(j)
        });
        let of_estimates = |change: &DVector<f64>| {
            let found = slopes.tr_mul(change);
            (found.norm() > 0.0).then(|| found.normalize())
        };
        let lost = terms.lost.iter().filter_map(of_estimates).collect();
        let correlation = correlation(&covariance);
        let given = stated.iter().map(Option::is_some).collect();
        Self { parameters, given, slopes, covariance, correlation, lost }
    }

    pub(super) fn none() -> Self {
        let none = || DMatrix::zeros(0, 0);
        Self {
            parameters: Vec::new(),
            given: Vec::new(),
            slopes: none(),
            covariance: none(),
            correlation: none(),
            lost: Vec::new(),
        }
    }

    /// Correlation of the estimates; NaN where the logs do not tell a parameter from others.
    pub(super) fn correlation(&self) -> DMatrix<f64> {
        let n = self.parameters.len();
        DMatrix::from_fn(n, n, |i, j| {
            if self.is_lost(i) || self.is_lost(j) { f64::NAN } else { self.correlation[(i, j)] }
        })
    }

    /// Whether a parameter takes part in a change that the logs do not show.
    fn is_lost(&self, parameter: usize) -> bool {
        self.lost.iter().any(|change| change[parameter].abs() > LOST_SHARE)
    }

    pub(super) fn known(&self) -> Vec<ParameterCertainty> {
        let information = inverse(&self.covariance);
        let known = |(i, parameter): (usize, &ArmParameter)| ParameterCertainty {
            parameter: *parameter,
            given: self.given[i],
            std: if self.is_lost(i) { f64::INFINITY } else { self.covariance[(i, i)].sqrt() },
            alone: 1.0 / information[(i, i)].sqrt(),
        };
        self.parameters.iter().enumerate().map(known).collect()
    }

    /// Largest eigenvalue of the correlation matrix over the least.
    pub(super) fn condition(&self) -> f64 {
        if self.parameters.is_empty() || !self.lost.is_empty() {
            return f64::INFINITY;
        }
        let values = correlation(&self.covariance).symmetric_eigenvalues();
        let least = values.min();
        if least > 0.0 { values.max() / least } else { f64::INFINITY }
    }
}

fn matrix(rows: usize, columns: &[DVector<f64>]) -> DMatrix<f64> {
    DMatrix::from_fn(rows, columns.len(), |i, j| columns[j][i])
}
