//! Principal directions of the parameters' covariance.

use nalgebra::{DMatrix, DVector};

use crate::identify::separability::judged::Judged;
use crate::identify::separability::thresholds::{
    DIRECTION_OF_ESTIMATE, ESTIMATE_OF_DIRECTION, LOST_SHARE,
};
use crate::information::ArmParameter;

/// A change of parameters together.
#[derive(Debug, Clone, PartialEq)]
pub struct Direction {
    /// Standard error along it, in shares of the parameters' sizes; infinite where the logs do not show it at all.
    pub std: f64,
    /// The parameters that take part, those that move most first.
    pub parts: Vec<DirectionPart>,
}

/// A parameter in a direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DirectionPart {
    /// Which.
    pub parameter: ArmParameter,
    /// Its share of a change of length one along the direction; positive for the first part.
    pub weight: f64,
    /// Share of the parameter's variance that lies along the direction.
    pub of_variance: f64,
}

/// The principal directions, least known first. What is not finite gives none.
pub(super) fn of(parameters: &[ArmParameter], covariance: &DMatrix<f64>) -> Vec<Direction> {
    if parameters.is_empty() || covariance.iter().any(|v| !v.is_finite()) {
        return Vec::new();
    }
    let eigen = covariance.clone().symmetric_eigen();
    let direction = |(value, vector): (&f64, _)| {
        let vector: DVector<f64> = vector;
        let share = |i: usize| value * vector[i] * vector[i] / covariance[(i, i)];
        Direction { std: value.max(0.0).sqrt(), parts: parts(parameters, &vector, &share) }
    };
    let vectors = eigen.eigenvectors.column_iter().map(nalgebra::Matrix::into_owned);
    let mut all: Vec<Direction> = eigen.eigenvalues.iter().zip(vectors).map(direction).collect();
    all.sort_by(|a, b| b.std.total_cmp(&a.std));
    all
}

/// Directions that the logs do not show.
pub(super) fn lost(judged: &Judged) -> Vec<Direction> {
    let direction = |change: &DVector<f64>| Direction {
        std: f64::INFINITY,
        parts: parts(&judged.parameters, change, &|i| f64::from(change[i].abs() > LOST_SHARE)),
    };
    judged.lost.iter().map(direction).collect()
}

fn parts(
    parameters: &[ArmParameter],
    vector: &DVector<f64>,
    share: &dyn Fn(usize) -> f64,
) -> Vec<DirectionPart> {
    let part = |(i, parameter): (usize, &ArmParameter)| DirectionPart {
        parameter: *parameter,
        weight: vector[i],
        of_variance: share(i),
    };
    let takes = |p: &DirectionPart| {
        p.of_variance > DIRECTION_OF_ESTIMATE || p.weight.powi(2) > ESTIMATE_OF_DIRECTION
    };
    let mut parts: Vec<DirectionPart> =
        parameters.iter().enumerate().map(part).filter(takes).collect();
    parts.sort_by(|a, b| b.weight.abs().total_cmp(&a.weight.abs()));
    if parts.first().is_some_and(|p| p.weight < 0.0) {
        for part in &mut parts {
            part.weight = -part.weight;
        }
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Viscous friction up by 10 with Coulomb friction down by 0.8, and an inertia that is known.
    #[test]
    fn the_worst_direction_names_what_goes_together() {
        let parameters = [ArmParameter::Coulomb, ArmParameter::Viscous, ArmParameter::Inertia];
        let v = DVector::from_vec(vec![-0.8, 10.0, 0.0]);
        let own = DMatrix::from_diagonal(&DVector::from_vec(vec![1e-4, 1e-4, 1e-4]));
        let all = of(&parameters, &(&v * v.transpose() + own));
        let worst = &all[0];
        assert!((worst.std / v.norm() - 1.0).abs() < 1e-3);
        let found: Vec<ArmParameter> = worst.parts.iter().map(|p| p.parameter).collect();
        assert_eq!(found, [ArmParameter::Viscous, ArmParameter::Coulomb]);
        assert!((worst.parts[1].weight / worst.parts[0].weight + 0.08).abs() < 1e-6);
    }
}
