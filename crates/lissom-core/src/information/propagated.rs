//! Deviations of figures from the covariance of the parameters (delta method).

use nalgebra::{DMatrix, DVector};

use crate::replay::{ModalArm, Parameter};

/// A parameter of an arm moved by `step` to either side, by less where it would not stay positive though
/// it is by nature; and the step.
pub fn beside(arm: &ModalArm, parameter: Parameter, step: f64) -> (f64, [ModalArm; 2]) {
    let value = parameter.of(arm);
    let step = if parameter.is_scale() { step.min(0.5 * value.abs()) } else { step };
    let moved = |change: f64| {
        let mut moved = arm.clone();
        parameter.set(&mut moved, value + change);
        moved
    };
    (step, [moved(step), moved(-step)])
}

/// ∂figure/∂parameter of an arm, by differences over `share` of each parameter's deviation to either
/// side; zero by a parameter without deviation.
pub fn slopes(
    arm: &ModalArm,
    parameters: &[Parameter],
    covariance: &DMatrix<f64>,
    share: f64,
    figure: impl Fn(&ModalArm) -> f64,
) -> DVector<f64> {
    let slope = |(i, p): (usize, &Parameter)| {
        let (step, [above, below]) = beside(arm, *p, share * covariance[(i, i)].max(0.0).sqrt());
        if step > 0.0 { (figure(&above) - figure(&below)) / (2.0 * step) } else { 0.0 }
    };
    DVector::from_iterator(parameters.len(), parameters.iter().enumerate().map(slope))
}

/// √(gᵀ·C·g) of a figure with [`slopes`] g.
pub fn propagated(
    arm: &ModalArm,
    parameters: &[Parameter],
    covariance: &DMatrix<f64>,
    share: f64,
    figure: impl Fn(&ModalArm) -> f64,
) -> f64 {
    along(&slopes(arm, parameters, covariance, share, figure), covariance)
}

/// √(gᵀ·C·g): the deviation of what has the slopes g.
pub fn along(slopes: &DVector<f64>, covariance: &DMatrix<f64>) -> f64 {
    slopes.dot(&(covariance * slopes)).max(0.0).sqrt()
}
