//! An estimate with its standard error.

use std::fmt;

use statrs::distribution::{ContinuousCDF as _, StudentsT};

use crate::identify::thresholds;

/// Half width of a 95 % interval \[standard errors\]: the two-sided 95 % point of the normal distribution.
pub const NORMAL_95: f64 = thresholds::NORMAL_95;

/// Ratio of the length of a 95 % interval with Student's t distribution, for so many degrees of freedom of the standard
/// error, to the length with the normal distribution.
pub(crate) fn wider_by_student(freedom: f64) -> f64 {
    StudentsT::new(0.0, 1.0, freedom).map_or(1.0, |t| t.inverse_cdf(0.975) / NORMAL_95)
}

/// An estimate of a parameter, with its standard error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Value, in the unit that the name of the field or function states.
    pub value: f64,
    /// Standard error of the value, in the same unit.
    pub std: f64,
}

/// Value and standard error in two digits of the error: `0.13201(12)` is 0.13201 ± 0.00012.
impl fmt::Display for Estimate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&lissom_text::with_uncertainty(self.value, self.std))
    }
}

impl Estimate {
    /// 95 % interval, `value ± NORMAL_95·std`.
    pub fn ci95(&self) -> [f64; 2] {
        [self.value - NORMAL_95 * self.std, self.value + NORMAL_95 * self.std]
    }

    /// Whether it is below zero by more than two deviations.
    pub(crate) fn is_negative(&self) -> bool {
        self.value < -thresholds::SIGN_SHOWN * self.std
    }

    /// Converts to another unit: value and standard error are multiplied by `factor`.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        Self { value: self.value * factor, std: self.std * factor.abs() }
    }
}

/// A mode of the beam with the motor clamped.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModeEstimate {
    /// Undamped natural frequency \[rad/s\].
    pub natural_frequency_rad_s: Estimate,
    /// Damping ratio ζ \[1\].
    pub damping_ratio: Estimate,
}

impl ModeEstimate {
    /// Damping ratio, no less than zero, which is possible; `None` if it is significantly below zero.
    pub fn given_damping_ratio(&self) -> Option<Estimate> {
        let ratio = self.damping_ratio;
        (!ratio.is_negative()).then(|| Estimate { value: ratio.value.max(0.0), ..ratio })
    }
}
