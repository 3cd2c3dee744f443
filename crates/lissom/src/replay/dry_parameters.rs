//! Numbers of the terms of dry friction as parameters of a replay.

use super::parameter::Parameter;
use crate::friction::{DryTerms, Place};

impl DryTerms {
    /// All numbers in them.
    pub(super) fn parameters(&self) -> Vec<Parameter> {
        let mut found = Vec::new();
        if self.near_rest.is_some() {
            found.extend([Parameter::NearRest, Parameter::NearRestSpeed]);
        }
        for i in 0..self.ripples.len() {
            found.extend([
                Parameter::RippleCosine(i),
                Parameter::RippleSine(i),
                Parameter::RippleRate(i),
            ]);
        }
        found
    }

    /// Derivative of the torque by one of the terms' own numbers.
    pub(super) fn by(&self, parameter: Parameter, at: Place) -> f64 {
        let ripple = |i: usize| self.ripples[i].per_rad * at.angle;
        at.sign
            * match (parameter, self.near_rest) {
                (Parameter::NearRest, Some(n)) => n.share(at.speed),
                (Parameter::NearRestSpeed, Some(n)) => {
                    n.torque_nm * n.falls(at.speed) * at.speed / n.speed_rad_s.powi(2)
                }
                (Parameter::RippleCosine(i), _) => ripple(i).cos(),
                (Parameter::RippleSine(i), _) => ripple(i).sin(),
                (Parameter::RippleRate(i), _) => {
                    let (r, (sine, cosine)) = (&self.ripples[i], ripple(i).sin_cos());
                    at.angle * (r.sine_nm * cosine - r.cosine_nm * sine)
                }
                _ => 0.0,
            }
    }
}
