//! Principal directions of the figures' covariance.

use nalgebra::{DMatrix, DVector};

use crate::identify::separability::judged::Judged;
use crate::identify::separability::thresholds::{
    DIRECTION_OF_ESTIMATE, ESTIMATE_OF_DIRECTION, LOST_SHARE,
};
use crate::information::Figure;

/// A change of figures together.
#[derive(Debug, Clone, PartialEq)]
pub struct Direction {
    /// Deviation along it, in shares of the figures' sizes; infinite where the logs do not show it at all.
    pub std: f64,
    /// The figures that take part, those that move most first.
    pub parts: Vec<DirectionPart>,
}

/// A figure in a direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DirectionPart {
    /// Which.
    pub figure: Figure,
    /// Its share of a change of length one along the direction; positive for the first part.
    pub weight: f64,
    /// Share of the figure's variance that lies along the direction.
    pub of_variance: f64,
}

/// The principal directions, least known first. What is not finite gives none.
pub(super) fn of(figures: &[Figure], covariance: &DMatrix<f64>) -> Vec<Direction> {
    if figures.is_empty() || covariance.iter().any(|v| !v.is_finite()) {
        return Vec::new();
    }
    let eigen = covariance.clone().symmetric_eigen();
    let direction = |(value, vector): (&f64, _)| {
        let vector: DVector<f64> = vector;
        let share = |i: usize| value * vector[i] * vector[i] / covariance[(i, i)];
        Direction { std: value.max(0.0).sqrt(), parts: parts(figures, &vector, &share) }
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
        parts: parts(&judged.figures, change, &|i| f64::from(change[i].abs() > LOST_SHARE)),
    };
    judged.lost.iter().map(direction).collect()
}

fn parts(
    figures: &[Figure],
    vector: &DVector<f64>,
    share: &dyn Fn(usize) -> f64,
) -> Vec<DirectionPart> {
    let part = |(i, figure): (usize, &Figure)| DirectionPart {
        figure: *figure,
        weight: vector[i],
        of_variance: share(i),
    };
    let takes = |p: &DirectionPart| {
        p.of_variance > DIRECTION_OF_ESTIMATE || p.weight.powi(2) > ESTIMATE_OF_DIRECTION
    };
    let mut parts: Vec<DirectionPart> =
        figures.iter().enumerate().map(part).filter(takes).collect();
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
        let figures = [Figure::Coulomb, Figure::Viscous, Figure::Inertia];
        let v = DVector::from_vec(vec![-0.8, 10.0, 0.0]);
        let own = DMatrix::from_diagonal(&DVector::from_vec(vec![1e-4, 1e-4, 1e-4]));
        let all = of(&figures, &(&v * v.transpose() + own));
        let worst = &all[0];
        assert!((worst.std / v.norm() - 1.0).abs() < 1e-3);
        let found: Vec<Figure> = worst.parts.iter().map(|p| p.figure).collect();
        assert_eq!(found, [Figure::Viscous, Figure::Coulomb]);
        assert!((worst.parts[1].weight / worst.parts[0].weight + 0.08).abs() < 1e-6);
    }
}
