//! Standard errors of functions of the parameters, from their covariance (delta method).

use nalgebra::{DMatrix, DVector};

use crate::replay::{ModalArm, Parameter};

/// Two arms with a parameter changed by `step` in either direction, and the step. The step is smaller if a parameter
/// that must be positive would otherwise not remain so.
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

/// Derivatives ∂parameter/∂parameter at an arm, by central differences over `share` of the standard error of each
/// parameter in either direction; zero for a parameter with zero standard error.
pub fn slopes(
    arm: &ModalArm,
    parameters: &[Parameter],
    covariance: &DMatrix<f64>,
    share: f64,
    parameter: impl Fn(&ModalArm) -> f64,
) -> DVector<f64> {
    let slope = |(i, p): (usize, &Parameter)| {
        let (step, [above, below]) = beside(arm, *p, share * covariance[(i, i)].max(0.0).sqrt());
        if step > 0.0 { (parameter(&above) - parameter(&below)) / (2.0 * step) } else { 0.0 }
    };
    DVector::from_iterator(parameters.len(), parameters.iter().enumerate().map(slope))
}

/// Standard error √(gᵀ·C·g) of a function `parameter` of the arm, with its [`slopes`] g and the covariance C.
pub fn propagated(
    arm: &ModalArm,
    parameters: &[Parameter],
    covariance: &DMatrix<f64>,
    share: f64,
    parameter: impl Fn(&ModalArm) -> f64,
) -> f64 {
    along(&slopes(arm, parameters, covariance, share, parameter), covariance)
}

/// Standard error √(gᵀ·C·g) of a quantity with the slopes g and the covariance C.
pub fn along(slopes: &DVector<f64>, covariance: &DMatrix<f64>) -> f64 {
    slopes.dot(&(covariance * slopes)).max(0.0).sqrt()
}
